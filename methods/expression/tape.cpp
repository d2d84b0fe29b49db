#include "methods/expression/tape.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <string>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/expression/compound_steps.hpp"
#include "methods/expression/instruction_code.hpp"
#include "methods/expression/slot_plan.hpp"
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
  const SlotPlan plan(schedule, compounds);
  slot_count_ = plan.slot_count();
  constants_ = plan.constants();
  for (std::uint32_t i = 0; i < plan.inputs().size(); ++i) {
    read_inputs_.push_back({plan.first_input() + i, plan.inputs()[i]});
  }
  instructions_.reserve(compounds.size());
  for (const CompoundStep& compound : compounds) {
    const std::uint32_t result = plan.of(compound.step);
    TapeInstruction instruction{.code = static_cast<std::uint32_t>(compound.code),
                                .result = result,
                                .second_result = compound.cosine ? plan.of(*compound.cosine) : result,
                                .operands = {},
                                .exponent = schedule.steps()[compound.step].value};
    std::transform(compound.operands.begin(), compound.operands.begin() + compound.operand_count,
                   instruction.operands.begin(), [&](std::uint32_t operand) { return plan.of(operand); });
    instructions_.push_back(instruction);
  }
  // A value that is an output twice, and an input or a constant that is an output, is copied.
  for (std::uint32_t j = 0; j < output_count_; ++j) {
    const std::uint32_t source = plan.of(schedule.outputs()[j]);
    if (source == plan.output(j)) continue;
    instructions_.push_back({.code = static_cast<std::uint32_t>(instruction_code::of(Operation::input)),
                             .result = plan.output(j),
                             .second_result = plan.output(j),
                             .operands = {source},
                             .exponent = 0.0});
  }
}

Tape::Workspace::Workspace(const Tape& tape)
    : serial_(tape.serial_),
      slots_(tape.slot_count_ + tape.constants_.size() + tape.read_inputs_.size()),
      series_(tape.slot_count_ + tape.constants_.size() + tape.read_inputs_.size() + tape.output_count_) {
  for (std::size_t i = 0; i < tape.slot_count_ + tape.constants_.size(); ++i) {
    series_[i] = slots_[i].numbers.data();
  }
  for (std::size_t i = 0; i < tape.constants_.size(); ++i) {
    std::fill_n(series_[tape.slot_count_ + i], block_width, tape.constants_[i]);
  }
}

void Tape::evaluate(std::size_t begin, std::size_t end, std::span<const Input> inputs, std::span<double* const> outputs,
                    Workspace& workspace) const {
  if (inputs.size() < input_count_ || outputs.size() < output_count_) {
    throw Error(fmt::format("a tape with {} inputs and {} outputs got {} and {}", input_count_, output_count_,
                            inputs.size(), outputs.size()));
  }
  if (workspace.serial_ != serial_) {
    throw Error("this workspace was made for another tape");
  }
  if (begin >= end) return;
  // An input that is the same for all intervals fills a series of the workspace once.
  for (const ReadInput& input : read_inputs_) {
    if (!inputs[input.index].same_for_all) continue;
    double* spread = workspace.slots_[input.position].numbers.data();
    std::fill_n(spread, block_width, *inputs[input.index].data);
    workspace.series_[input.position] = spread;
  }
  const TapeKernel kernel = compiled_for(set_, kernels);
  for (std::size_t first = begin; first < end; first += block_width) {
    point_to_block(first, inputs, outputs, workspace);
    kernel(instructions_.data(), instructions_.size(), workspace.series_.data(), std::min(block_width, end - first));
  }
}

void Tape::point_to_block(std::size_t first, std::span<const Input> inputs, std::span<double* const> outputs,
                          Workspace& workspace) const {
  for (const ReadInput& input : read_inputs_) {
    if (inputs[input.index].same_for_all) continue;
    // The table holds results too, hence the cast; an input's series is only ever read.
    workspace.series_[input.position] = const_cast<double*>(inputs[input.index].data) + first;  // NOLINT
  }
  double** output_series = workspace.series_.data() + workspace.series_.size() - output_count_;
  for (std::size_t j = 0; j < output_count_; ++j) output_series[j] = outputs[j] + first;
}

}  // namespace dmocbench
