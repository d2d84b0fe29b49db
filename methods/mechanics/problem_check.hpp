#pragma once

#include <string>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Throws `Error` unless everything that a problem says of itself makes sense, as far as that shows before it is
/// solved: names of q, u, parameters and pictured quantities (`require_names`), sizes and order of bounds and ends
/// (`problem_bounds`), formulas (`TracedProblem`), the guess, the scale of the cost, and the words and the certified
/// optimum of its card, which go to terminals and pages. The sentence names the problem and the function, also where
/// the function throws (`asked`).
///
/// What makes problems by their names calls it (`Registry::make`), so that no program meets one that has not passed.
void check_problem(const Problem& problem);

/// `Problem::cost_scale`. Throws `Error` unless it is a positive number.
[[nodiscard]] double positive_cost_scale(const Problem& problem);

/// What is wrong with the sizes of a point of the guess for n configurations and m controls; empty if nothing is.
[[nodiscard]] std::string flaw_of_sizes(const MotionPoint& point, Eigen::Index n, Eigen::Index m, Eigen::Index l);

}  // namespace dmocbench
