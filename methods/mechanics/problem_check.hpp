#pragma once

#include <string>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Throws `Error` unless the statement of a problem makes sense, as far as this can be checked before it is
/// solved: names of q, u, parameters and pictured quantities (`require_names`), sizes and order of bounds and ends
/// (`problem_bounds`), formulas (`TracedProblem`), the guess, the scale of the cost, and the words and the certified
/// optimum of its card, which go to terminals and pages. The sentence names the problem and the function, also where
/// the function throws (`asked`).
///
/// `Registry::make`, which makes problems by their names, calls it, so that programs only see valid problems.
void check_problem(const Problem& problem);

/// `Problem::cost_scale`. Throws `Error` unless it is a positive number.
[[nodiscard]] double positive_cost_scale(const Problem& problem);

/// The fault in the sizes of a point of the guess for n configurations and m controls; empty if they are right.
[[nodiscard]] std::string flaw_of_sizes(const MotionPoint& point, Eigen::Index n, Eigen::Index m, Eigen::Index l);

}  // namespace dmocbench
