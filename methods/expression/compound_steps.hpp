#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "methods/expression/schedule.hpp"
#include "methods/expression/tape_kernel.hpp"

namespace dmocbench {

/// Steps of a schedule that one instruction carries out.
struct CompoundStep {
  std::size_t code = 0;                                 ///< of the instruction, see `instruction_code`
  std::uint32_t step = 0;                               ///< whose value is the result
  std::optional<std::uint32_t> cosine;                  ///< of the sine `step`, where one instruction computes both
  std::array<std::uint32_t, most_operands> operands{};  ///< the steps whose values are read,
  std::size_t operand_count = 0;                        ///< so many
};

/// The steps that compute, as few compounds in an order in which they can be carried out: a sum, difference or product
/// that has one reader of the same kind is carried out with it. Values are the same bit by bit, but for those of a sine
/// and a cosine of one number, which are found together.
[[nodiscard]] std::vector<CompoundStep> compound_steps(const Schedule& schedule);

}  // namespace dmocbench
