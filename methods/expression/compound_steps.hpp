#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "methods/expression/schedule.hpp"
#include "methods/expression/tape_kernel.hpp"

namespace dmocbench {

/// The steps of a schedule that one instruction carries out.
struct CompoundStep {
  std::size_t code = 0;                                 ///< the `instruction_code`
  std::uint32_t step = 0;                               ///< the step whose value is the result
  std::optional<std::uint32_t> cosine;                  ///< the cosine of the same number, if `step` is a sine
  std::array<std::uint32_t, most_operands> operands{};  ///< steps whose values are read
  std::size_t operand_count = 0;                        ///< how many of them there are
};

/// The computing steps, grouped into as few compounds as possible, in an order in which they can be carried out: a sum,
/// difference or product whose only reader is of the same kind is carried out together with it. Values stay the same
/// bit by bit, except that sine and cosine of one number are computed together.
[[nodiscard]] std::vector<CompoundStep> compound_steps(const Schedule& schedule);

}  // namespace dmocbench
