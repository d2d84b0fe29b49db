#include "methods/expression/tape.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>

#include "methods/error.hpp"
#include "methods/expression/tape_kernel.hpp"

namespace dmocbench {

namespace {

TapeKernel kernel_of(InstructionSet set) {
#ifdef DMOCBENCH_X86_KERNELS
  if (set == InstructionSet::avx512) return run_tape_avx512;
  if (set == InstructionSet::avx2) return run_tape_avx2;
#endif
  static_cast<void>(set);
  return run_tape_baseline;
}

/// For every step the last step that reads it (its own position if none does).
std::vector<std::size_t> last_readers(const Schedule& schedule) {
  const auto& steps = schedule.steps();
  std::vector<std::size_t> last(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    last[i] = i;
    const std::size_t operands = operand_count(steps[i].operation);
    if (operands > 0) last[steps[i].left] = i;
    if (operands > 1) last[steps[i].right] = i;
  }
  return last;
}

bool computes(const Schedule::Step& step) { return operand_count(step.operation) > 0; }

/// Hands out slots and takes them back when a value is dead.
class SlotPool {
 public:
  std::uint32_t take() {
    if (free_.empty()) return count_++;
    const std::uint32_t slot = free_.back();
    free_.pop_back();
    return slot;
  }
  void give_back(std::uint32_t slot) { free_.push_back(slot); }
  [[nodiscard]] std::uint32_t count() const { return count_; }

 private:
  std::vector<std::uint32_t> free_;
  std::uint32_t count_ = 0;
};

std::uint64_t next_serial() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

Tape::Tape(const Schedule& schedule, InstructionSet set)
    : input_count_(schedule.input_count()),
      output_count_(schedule.outputs().size()),
      serial_(next_serial()),
      set_(set) {
  const auto& available = available_instruction_sets();
  if (std::find(available.begin(), available.end(), set) == available.end()) {
    throw Error("this processor lacks the instruction set " + std::string(name_of(set)));
  }
  const auto& steps = schedule.steps();
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  // The first output that a computed step is: its result goes there directly, and later readers read it there.
  std::vector<std::uint32_t> output_of(steps.size(), none);
  for (std::uint32_t j = 0; j < output_count_; ++j) {
    const std::uint32_t position = schedule.outputs()[j];
    if (computes(steps[position]) && output_of[position] == none) output_of[position] = j;
  }

  // Slots, one step after the other; kind and number of every step's column.
  enum class Kind : std::uint8_t { slot, constant, input, output };
  struct Column {
    Kind kind;
    std::uint32_t number;
  };
  const std::vector<std::size_t> last = last_readers(schedule);
  std::vector<Column> columns;
  columns.reserve(steps.size());
  SlotPool pool;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Schedule::Step& step = steps[i];
    if (step.operation == Operation::constant) {
      columns.push_back({Kind::constant, static_cast<std::uint32_t>(constants_.size())});
      constants_.push_back(step.value);
      continue;
    }
    if (step.operation == Operation::input) {
      columns.push_back({Kind::input, static_cast<std::uint32_t>(read_inputs_.size())});
      read_inputs_.push_back({0, step.input_index});
      continue;
    }
    // Operands that die here give their slots back first: an instruction may write where it reads.
    const std::size_t operands = operand_count(step.operation);
    for (std::size_t which = 0; which < operands; ++which) {
      const std::uint32_t operand = which == 0 ? step.left : step.right;
      if (which == 1 && step.left == step.right) continue;
      if (last[operand] == i && columns[operand].kind == Kind::slot) pool.give_back(columns[operand].number);
    }
    columns.push_back(output_of[i] == none ? Column{Kind::slot, pool.take()} : Column{Kind::output, output_of[i]});
    ++operation_count_;
  }
  slot_count_ = pool.count();

  const auto first_constant = static_cast<std::uint32_t>(slot_count_);
  const auto first_input = static_cast<std::uint32_t>(first_constant + constants_.size());
  const auto first_output = static_cast<std::uint32_t>(first_input + read_inputs_.size());
  const auto place = [&](const Column& column) {
    switch (column.kind) {
      case Kind::slot:
        return column.number;
      case Kind::constant:
        return first_constant + column.number;
      case Kind::input:
        return first_input + column.number;
      case Kind::output:
        return first_output + column.number;
    }
    return none;
  };
  for (std::uint32_t i = 0; i < read_inputs_.size(); ++i) read_inputs_[i].column = first_input + i;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Schedule::Step& step = steps[i];
    if (!computes(step)) continue;
    const std::uint32_t left = place(columns[step.left]);
    const std::uint32_t right = operand_count(step.operation) > 1 ? place(columns[step.right]) : left;
    instructions_.push_back({step.operation, place(columns[i]), left, right, step.value});
  }
  for (std::uint32_t j = 0; j < output_count_; ++j) {
    const std::uint32_t position = schedule.outputs()[j];
    if (output_of[position] == j) continue;
    const std::uint32_t source = place(columns[position]);
    instructions_.push_back({Operation::input, first_output + j, source, source, 0.0});
  }
}

Tape::Workspace::Workspace(const Tape& tape)
    : serial_(tape.serial_),
      slots_(tape.slot_count_ + tape.constants_.size() + tape.read_inputs_.size()),
      columns_(tape.slot_count_ + tape.constants_.size() + tape.read_inputs_.size() + tape.output_count_) {
  for (std::size_t i = 0; i < tape.slot_count_ + tape.constants_.size(); ++i) {
    columns_[i] = slots_[i].numbers.data();
  }
  for (std::size_t i = 0; i < tape.constants_.size(); ++i) {
    std::fill_n(columns_[tape.slot_count_ + i], block_width, tape.constants_[i]);
  }
}

void Tape::evaluate(std::size_t begin, std::size_t end, std::span<const Input> inputs, std::span<double* const> outputs,
                    Workspace& workspace) const {
  if (inputs.size() < input_count_ || outputs.size() < output_count_) {
    throw Error("a tape with " + std::to_string(input_count_) + " inputs and " + std::to_string(output_count_) +
                " outputs got " + std::to_string(inputs.size()) + " and " + std::to_string(outputs.size()));
  }
  if (workspace.serial_ != serial_) {
    throw Error("this workspace was made for another tape");
  }
  if (begin >= end) return;
  // Inputs that are the same for all intervals are spread over a column of the workspace once.
  for (const ReadInput& input : read_inputs_) {
    if (!inputs[input.index].same_for_all) continue;
    double* spread = workspace.slots_[input.column].numbers.data();
    std::fill_n(spread, block_width, *inputs[input.index].data);
    workspace.columns_[input.column] = spread;
  }
  const TapeKernel kernel = kernel_of(set_);
  for (std::size_t first = begin; first < end; first += block_width) {
    point_to_block(first, inputs, outputs, workspace);
    kernel(instructions_.data(), instructions_.size(), workspace.columns_.data(), std::min(block_width, end - first));
  }
}

void Tape::point_to_block(std::size_t first, std::span<const Input> inputs, std::span<double* const> outputs,
                          Workspace& workspace) const {
  for (const ReadInput& input : read_inputs_) {
    if (inputs[input.index].same_for_all) continue;
    // The table holds results too, hence the cast; an input's column is only ever read.
    workspace.columns_[input.column] = const_cast<double*>(inputs[input.index].data) + first;  // NOLINT
  }
  double** output_columns = workspace.columns_.data() + workspace.columns_.size() - output_count_;
  for (std::size_t j = 0; j < output_count_; ++j) output_columns[j] = outputs[j] + first;
}

}  // namespace dmocbench
