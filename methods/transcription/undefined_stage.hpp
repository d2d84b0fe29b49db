#pragma once

#include <string>

#include <Eigen/Core>

#include "methods/mechanics/formula_check.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// Which formula cannot be evaluated at a point of a program, and where first: "a derivative of force[1] is not a
/// number in interval 3 (t = 0.41)". L, f, C, h and their derivatives up to an order are looked at in all stages.
/// Empty if all are numbers. `problem` is the one that was transcribed, `x` has variable_count() entries.
[[nodiscard]] std::string undefined_stage(const Problem& problem, Transcription& transcription,
                                          const Eigen::VectorXd& x,
                                          FormulaCheck::Derivatives up_to = FormulaCheck::Derivatives::second);

}  // namespace dmocbench
