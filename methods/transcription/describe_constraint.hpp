#pragma once

#include <cstddef>
#include <string>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// What a row, or an unknown, of a transcribed problem stands for: the functions of the problem that it is made of, the
/// quantity, and where, "lagrangian and force: the Euler-Lagrange equation of q[1] (theta) in interval 17 (t = 0.53 to
/// 0.5625)". Indices count from 0; times are those of the point `x` (variable_count() entries), in the units of the
/// problem as solved. `problem` is the one that was transcribed.
[[nodiscard]] std::string describe_constraint(const Problem& problem, const Transcription& transcription,
                                              const Eigen::VectorXd& x, std::size_t row);
[[nodiscard]] std::string unknown_in_words(const Problem& problem, const Transcription& transcription,
                                           const Eigen::VectorXd& x, std::size_t unknown);

}  // namespace dmocbench
