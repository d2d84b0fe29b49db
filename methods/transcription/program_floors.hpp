#pragma once

#include <Eigen/Core>

#include "methods/program/interval_structure.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/motions/guess_check.hpp"

namespace dmocbench {

/// The floors of a program (`Transcription::rounding_floors`) from max|q| and max|L_vv| over the ends and the guess,
/// and the steps of the intervals.
[[nodiscard]] RoundingFloors rounding_floors_of(const GuessMagnitudes& survey, const Eigen::VectorXd& steps,
                                                const IntervalStructure& structure);

}  // namespace dmocbench
