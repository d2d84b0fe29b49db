#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "methods/expression/native/native_plan.hpp"

namespace dmocbench {

/// The place of a vector of numbers while machine code runs.
struct OperandPlace {
  /// A register; or memory: a series at the present intervals, a constant of the plan, a place on the stack.
  enum class Kind : std::uint8_t { in_register, series, constant, stack };
  Kind kind = Kind::in_register;  ///< meaning of `number`
  std::uint32_t number = 0;       ///< of a constant: the value of the plan
};

/// An instruction of the processor. Results and left operands of arithmetic are in registers, right ones (and the
/// operand of a square root) may be in memory; a copy has a register on one side at least.
struct MachineStep {
  VectorOperation operation = VectorOperation::copy;  ///< the operation
  OperandPlace result;                                ///< where the result goes
  OperandPlace left;                                  ///< the first operand
  OperandPlace right;                                 ///< the second operand, where there is one
};

/// Straight-line code for the present intervals, and its use of the stack.
struct MachineSteps {
  std::vector<MachineStep> once;   ///< before the first intervals: loads of constants
  std::vector<MachineStep> steps;  ///< in their order
  std::size_t stack_places = 0;    ///< vectors on the stack
};

/// The arithmetic of a stage with a given number of registers, at least three. If they do not suffice, the value leaves
/// them that is needed last (Belady's rule), which for straight-line code loads as few values as possible. Registers
/// that are left hold constants.
[[nodiscard]] MachineSteps allocate_registers(const NativeStage& stage, const std::vector<NativePlan::Home>& homes,
                                              std::size_t registers);

}  // namespace dmocbench
