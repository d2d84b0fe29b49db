#include "methods/expression/tape.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <string>
#include <unordered_map>

#include "methods/error.hpp"
#include "methods/expression/tape_kernel.hpp"

namespace dmocbench {

namespace {

/// The combination that an operation is; nothing for other operations.
std::optional<Combination> combination_of(Operation operation) {
  switch (operation) {
    case Operation::add:
      return Combination::add;
    case Operation::subtract:
      return Combination::subtract;
    case Operation::multiply:
      return Combination::multiply;
    default:
      return std::nullopt;
  }
}

/// The same combination with its operands swapped.
Combination swapped(Combination combination) {
  return combination == Combination::subtract ? Combination::subtract_from : combination;
}

/// The number of readers of each step; outputs count as readers.
std::vector<std::size_t> count_readers(const Schedule& schedule) {
  std::vector<std::size_t> readers(schedule.steps().size());
  for (const Schedule::Step& step : schedule.steps()) {
    const std::size_t operands = operand_count(step.operation);
    if (operands > 0) ++readers[step.left];
    if (operands > 1) ++readers[step.right];
  }
  for (const std::uint32_t output : schedule.outputs()) ++readers[output];
  return readers;
}

/// Combinations carried out one after the other, starting with the first two operands; or a tree.
struct Draft {
  std::array<Combination, most_operands - 1> combinations{};
  std::array<std::uint32_t, most_operands> operands{};
  std::size_t operand_count = 0;  // the number of combinations plus one; 0 for other steps
  bool is_tree = false;

  void append(Combination combination, std::uint32_t operand) {
    combinations[operand_count - 1] = combination;
    operands[operand_count++] = operand;
  }

  [[nodiscard]] std::size_t code() const {
    const auto& c = combinations;
    if (is_tree) return instruction_code::tree(c[0], c[1], c[2]);
    return operand_count == 3 ? instruction_code::pair(c[0], c[1]) : instruction_code::chain(c[0], c[1], c[2]);
  }
};

class Compounder {
 public:
  explicit Compounder(const Schedule& schedule)
      : steps_(schedule.steps()), readers_(count_readers(schedule)), drafts_(steps_.size()), absorbed_(steps_.size()) {
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      if (const auto combination = combination_of(steps_[i].operation)) drafts_[i] = draft(steps_[i], *combination);
      if (steps_[i].operation == Operation::sine) sine_of_[steps_[i].left] = i;
      if (steps_[i].operation == Operation::cosine) cosine_of_[steps_[i].left] = i;
    }
  }

  std::vector<CompoundStep> compounds() {
    std::vector<CompoundStep> result;
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      if (operand_count(steps_[i].operation) > 0 && !absorbed_[i]) result.push_back(compound(i));
    }
    return result;
  }

 private:
  /// The step combined with those operands that have no other reader, if the kernel has an instruction for it.
  Draft draft(const Schedule::Step& step, Combination combination) {
    const std::size_t left = absorbable_size(step.left);
    const std::size_t right = absorbable_size(step.right);
    if (left == 2 && right == 2) return tree(drafts_[take(step.left)], drafts_[take(step.right)], combination);
    if (left == 0 && right == 0) return {{combination}, {step.left, step.right}, 2};
    const bool extends_left = left >= right;
    Draft result = drafts_[take(extends_left ? step.left : step.right)];
    result.append(extends_left ? combination : swapped(combination), extends_left ? step.right : step.left);
    return result;
  }

  static Draft tree(const Draft& left, const Draft& right, Combination combination) {
    return {{left.combinations[0], right.combinations[0], combination},
            {left.operands[0], left.operands[1], right.operands[0], right.operands[1]},
            most_operands,
            true};
  }

  /// The number of operands of a step that its only reader may absorb; 0 for other steps.
  [[nodiscard]] std::size_t absorbable_size(std::uint32_t step) const {
    const std::size_t size = drafts_[step].operand_count;
    return readers_[step] == 1 && size < most_operands ? size : 0;
  }

  std::uint32_t take(std::uint32_t step) {
    absorbed_[step] = true;
    return step;
  }

  CompoundStep compound(std::uint32_t i) {
    const Schedule::Step& step = steps_[i];
    const Draft& draft = drafts_[i];
    if (draft.operand_count > 2) return {draft.code(), i, std::nullopt, draft.operands, draft.operand_count};
    if (step.operation == Operation::sine && cosine_of_.contains(step.left)) {
      return {instruction_code::sine_and_cosine, i, take(cosine_of_[step.left]), {step.left}, 1};
    }
    if (step.operation == Operation::cosine && sine_of_.contains(step.left)) {
      return {instruction_code::sine_and_cosine, take(sine_of_[step.left]), i, {step.left}, 1};
    }
    return {
        instruction_code::of(step.operation), i, std::nullopt, {step.left, step.right}, operand_count(step.operation)};
  }

  const std::vector<Schedule::Step>& steps_;
  std::vector<std::size_t> readers_;
  std::vector<Draft> drafts_;
  std::vector<bool> absorbed_;
  std::unordered_map<std::uint32_t, std::uint32_t> sine_of_;  // by the step of its argument
  std::unordered_map<std::uint32_t, std::uint32_t> cosine_of_;
};

}  // namespace

std::vector<CompoundStep> compound_steps(const Schedule& schedule) { return Compounder(schedule).compounds(); }

namespace {

constexpr std::array kernels{DMOCBENCH_VERSIONS(run_tape)};

std::uint64_t next_serial() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

/// The last compound that reads each step.
std::vector<std::size_t> last_readers(const std::vector<CompoundStep>& compounds, std::size_t steps) {
  std::vector<std::size_t> last(steps, compounds.size());
  for (std::size_t c = 0; c < compounds.size(); ++c) {
    for (std::size_t i = 0; i < compounds[c].operand_count; ++i) last[compounds[c].operands[i]] = c;
  }
  return last;
}

/// Gives the values of compounds that have no place yet a slot each, numbered from `first_slot` on; a slot is used
/// again once its value is dead. Returns the number of slots.
std::uint32_t place_in_slots(const std::vector<CompoundStep>& compounds, std::uint32_t first_slot,
                             std::vector<std::uint32_t>& places) {
  const std::vector<std::size_t> last = last_readers(compounds, places.size());
  std::vector<std::uint32_t> free;
  std::uint32_t end = first_slot;
  const auto place = [&](std::uint32_t step) {
    if (places[step] != nowhere) return;
    places[step] = free.empty() ? end++ : free.back();
    if (!free.empty()) free.pop_back();
  };
  for (std::size_t c = 0; c < compounds.size(); ++c) {
    const CompoundStep& compound = compounds[c];
    // The slots of operands that die here are free for the result: an instruction may write where it reads.
    const auto* begin = compound.operands.begin();
    for (const auto* operand = begin; operand != begin + compound.operand_count; ++operand) {
      const bool is_first = std::find(begin, operand, *operand) == operand;
      if (is_first && last[*operand] == c && places[*operand] >= first_slot) free.push_back(places[*operand]);
    }
    place(compound.step);
    if (compound.cosine) place(*compound.cosine);
  }
  return end - first_slot;
}

}  // namespace

Tape::Tape(const Schedule& schedule, InstructionSet set)
    : input_count_(schedule.input_count()),
      output_count_(schedule.outputs().size()),
      operation_count_(schedule.operation_count()),
      serial_(next_serial()),
      set_(set) {
  const auto available = available_instruction_sets();
  if (std::find(available.begin(), available.end(), set) == available.end()) {
    throw Error("this processor does not support the instruction set " + std::string(name_of(set)));
  }
  const std::vector<CompoundStep> compounds = compound_steps(schedule);
  const std::vector<std::uint32_t> places = place_values(schedule, compounds);
  instructions_.reserve(compounds.size());
  for (const CompoundStep& compound : compounds) {
    const std::uint32_t result = places[compound.step];
    TapeInstruction instruction{.code = static_cast<std::uint32_t>(compound.code),
                                .result = result,
                                .second_result = compound.cosine ? places[*compound.cosine] : result,
                                .operands = {},
                                .exponent = schedule.steps()[compound.step].value};
    std::transform(compound.operands.begin(), compound.operands.begin() + compound.operand_count,
                   instruction.operands.begin(), [&](std::uint32_t operand) { return places[operand]; });
    instructions_.push_back(instruction);
  }
  // A value that is an output twice, and an input or a constant that is an output, is copied.
  for (std::uint32_t j = 0; j < output_count_; ++j) {
    const std::uint32_t source = places[schedule.outputs()[j]];
    const std::uint32_t output = first_output() + j;
    if (source != output) instructions_.push_back(copy_instruction(source, output));
  }
}

std::vector<std::uint32_t> Tape::place_values(const Schedule& schedule, const std::vector<CompoundStep>& compounds) {
  const std::vector<Schedule::Step>& steps = schedule.steps();
  std::vector<std::uint32_t> places(steps.size(), nowhere);
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].operation != Operation::constant) continue;
    places[i] = next++;
    constants_.push_back(steps[i].value);
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].operation != Operation::input) continue;
    places[i] = next++;
    read_inputs_.push_back({places[i], steps[i].input_index});
  }
  // The value of an output is written to the output at once, and later readers read it there.
  for (const std::uint32_t output : schedule.outputs()) {
    if (places[output] == nowhere) places[output] = next;
    ++next;
  }
  slot_count_ = place_in_slots(compounds, next, places);
  return places;
}

Tape::Workspace::Workspace(const Tape& tape)
    : serial_(tape.serial_),
      // NOLINTNEXTLINE(*-avoid-c-arrays)
      memory_(std::make_unique_for_overwrite<Series[]>(tape.first_output() + tape.slot_count_)),
      series_(tape.series_count()) {
  Series* next = memory_.get();
  for (std::size_t i = 0; i < series_.size(); ++i) {
    const bool is_output = i >= tape.first_output() && i < tape.first_output() + tape.output_count_;
    if (!is_output) series_[i] = (next++)->numbers.data();
  }
  for (std::size_t i = 0; i < tape.constants_.size(); ++i) std::fill_n(series_[i], block_width, tape.constants_[i]);
}

void Tape::evaluate(std::size_t begin, std::size_t end, std::span<const Input> inputs, std::span<double* const> outputs,
                    Workspace& workspace) const {
  if (inputs.size() < input_count_ || outputs.size() < output_count_) {
    throw Error("a tape with {} inputs and {} outputs got {} inputs and {} outputs", input_count_, output_count_,
                inputs.size(), outputs.size());
  }
  if (workspace.serial_ != serial_) throw Error("this workspace was created for another tape");
  if (begin >= end) return;
  // An input that is the same for all intervals fills a series of the workspace once.
  for (const ReadInput& input : read_inputs_) {
    if (!inputs[input.index].same_for_all) continue;
    double* spread = workspace.memory_[input.position].numbers.data();
    std::fill_n(spread, block_width, *inputs[input.index].data);
    workspace.series_[input.position] = spread;
  }
  const TapeKernel kernel = compiled_for(set_, kernels);
  for (std::size_t first = begin; first < end; first += block_width) {
    point_to_block(first, inputs, outputs, workspace);
    const std::size_t width = std::min(block_width, end - first);
    kernel(instructions_.data(), instructions_.size(), workspace.series_.data(), width);
  }
}

Eigen::MatrixXd Tape::table(Eigen::Index count, std::span<const Input> inputs) const {
  Eigen::MatrixXd values(count, static_cast<Eigen::Index>(output_count_));
  std::vector<double*> outputs;
  for (auto column : values.colwise()) outputs.push_back(column.data());
  Workspace workspace(*this);
  evaluate(static_cast<std::size_t>(count), inputs, outputs, workspace);
  return values;
}

void Tape::point_to_block(std::size_t first, std::span<const Input> inputs, std::span<double* const> outputs,
                          Workspace& workspace) const {
  for (const ReadInput& input : read_inputs_) {
    if (inputs[input.index].same_for_all) continue;
    // The table holds results too, hence the cast; an input's series is only ever read.
    workspace.series_[input.position] = const_cast<double*>(inputs[input.index].data) + first;  // NOLINT
  }
  double** output_series = workspace.series_.data() + first_output();
  for (std::size_t j = 0; j < output_count_; ++j) output_series[j] = outputs[j] + first;
}

}  // namespace dmocbench
