#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "methods/expression/schedule.hpp"
#include "methods/expression/tape_kernel.hpp"

namespace dmocbench {

/// Operations of machine code on vectors: arithmetic, and copying a value to a series.
enum class VectorOperation : std::uint8_t { add, subtract, multiply, divide, square_root, exclusive_or, copy };

/// One of them. Operands are values of a `NativePlan`; a square root or a copy does not use the second one.
struct VectorStep {
  VectorOperation operation = VectorOperation::add;  ///< how the result is computed
  std::uint32_t result = 0;                          ///< the new value; of a copy the series that gets it
  std::uint32_t left = 0;                            ///< the first operand
  std::uint32_t right = 0;                           ///< the second operand
};

/// Number of operands: 1 or 2.
[[nodiscard]] constexpr std::size_t operand_count(VectorOperation operation) noexcept {
  return operation == VectorOperation::square_root || operation == VectorOperation::copy ? 1 : 2;
}

/// Arithmetic, and the functions that read its results.
struct NativeStage {
  std::vector<VectorStep> arithmetic;      ///< becomes machine code, which keeps values in registers
  std::vector<TapeInstruction> functions;  ///< sin, exp, ...: left to the kernel of the tape, series by series
};

/// The parts of a tape's table of series.
struct TapeSeries {
  std::vector<std::uint32_t> of_steps;  ///< for constants and inputs, by their steps; nothing for other steps
  std::uint32_t first_output = 0;       ///< the first output's, before the other outputs'
  std::uint32_t first_slot = 0;         ///< the first one that a plan may use for its own values
};

/// A schedule as stages: a function is carried out as soon as its operands can be known, everything else as late as
/// possible, so that few values pass from stage to stage. Those that do have a series of their own.
struct NativePlan {
  /// The place of a value outside registers.
  struct Home {
    std::optional<double> constant;       ///< its value, if it is a constant
    std::optional<std::uint32_t> series;  ///< of inputs, of results of functions and of stored values
  };
  std::vector<Home> homes;          ///< by values: the steps of the schedule, and constants that operations need
  std::vector<NativeStage> stages;  ///< one after the other
  std::size_t slots = 0;            ///< series from `first_slot` on that pass from stage to stage
};

/// The plan for a schedule and the table of series of its tape.
[[nodiscard]] NativePlan native_plan(const Schedule& schedule, const TapeSeries& table);

}  // namespace dmocbench
