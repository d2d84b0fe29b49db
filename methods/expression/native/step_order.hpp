#pragma once

#include <cstddef>
#include <vector>

#include "methods/expression/native/native_plan.hpp"

namespace dmocbench {

/// The steps of a stage in an order in which few of them wait for results (list scheduling).
///
/// A processor carries out instructions as soon as their operands are known, but looks only so far ahead. In a
/// schedule, which goes depth first, nearly every step waits for the one before it. Here a step comes when its operands
/// are expected to be known, the one on the longest way to the end first. While nearly all registers are in use, the
/// next step of the schedule comes, which needs few; stages of more than a thousand steps keep the order of the
/// schedule. Copies of a value stay after the step that computes it. `values` is the number of values of the plan.
[[nodiscard]] std::vector<VectorStep> overlapping_order(const std::vector<VectorStep>& steps, std::size_t values,
                                                        std::size_t registers);

}  // namespace dmocbench
