#include "methods/expression/tape.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <string>

#include "methods/error.hpp"
#include "methods/expression/column_plan.hpp"
#include "methods/expression/compound_steps.hpp"
#include "methods/expression/instruction_code.hpp"
#include "methods/expression/tape_kernel.hpp"

namespace dmocbench {

namespace {

#ifdef DMOCBENCH_X86_KERNELS
constexpr std::array kernels{run_tape_baseline, run_tape_avx2, run_tape_avx512};
#else
constexpr std::array kernels{run_tape_baseline};
#endif

std::uint64_t next_serial() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
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
    throw Error("this processor lacks the instruction set " + std::string(name_of(set)));
  }
  const std::vector<CompoundStep> compounds = compound_steps(schedule);
  const ColumnPlan columns(schedule, compounds);
  slot_count_ = columns.slot_count();
  constants_ = columns.constants();
  for (std::uint32_t i = 0; i < columns.inputs().size(); ++i) {
    read_inputs_.push_back({columns.first_input() + i, columns.inputs()[i]});
  }
  instructions_.reserve(compounds.size());
  for (const CompoundStep& compound : compounds) {
    const std::uint32_t result = columns.of(compound.step);
    TapeInstruction instruction{.code = static_cast<std::uint32_t>(compound.code),
                                .result = result,
                                .second_result = compound.cosine ? columns.of(*compound.cosine) : result,
                                .operands = {},
                                .exponent = schedule.steps()[compound.step].value};
    std::transform(compound.operands.begin(), compound.operands.begin() + compound.operand_count,
                   instruction.operands.begin(), [&](std::uint32_t operand) { return columns.of(operand); });
    instructions_.push_back(instruction);
  }
  // What is an output twice, or as it stands among inputs and constants, is copied.
  for (std::uint32_t j = 0; j < output_count_; ++j) {
    const std::uint32_t source = columns.of(schedule.outputs()[j]);
    if (source == columns.output(j)) continue;
    instructions_.push_back({.code = static_cast<std::uint32_t>(instruction_code::of(Operation::input)),
                             .result = columns.output(j),
                             .second_result = columns.output(j),
                             .operands = {source},
                             .exponent = 0.0});
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
  const TapeKernel kernel = compiled_for(set_, kernels);
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
