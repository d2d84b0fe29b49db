#pragma once

#include <string>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// The statement of a problem, as HTML with MathML: cost, Lagrangian, forces, constraints and conditions as they were
/// traced, ends, duration and bounds, and the parameters that formulas read. Numbers are in the units in which the
/// problem is solved. Throws `Error` as `TracedProblem`.
[[nodiscard]] std::string statement_html(const Problem& problem);

}  // namespace dmocbench
