#pragma once

#include <span>
#include <vector>

#include "bench/experiment/solve_case.hpp"

namespace dmocbench {

/// Cases in a row that differ in their grid only, together.
[[nodiscard]] std::vector<std::vector<Case>> curves_of(std::span<const Case> cases);

/// The cases once for each tolerance that is compared, curve after curve; as they are if none is.
[[nodiscard]] std::vector<Case> with_tolerances(const std::vector<Case>& cases, const std::vector<double>& tolerances);

}  // namespace dmocbench
