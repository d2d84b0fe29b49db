#pragma once

#include <optional>

#include "methods/program/solution.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// Solves from a point, with the multipliers that belong to a trajectory's costates (`sample_multipliers`) where there
/// is one and the solver can use them; where that fails from the point alone, which the message then says.
[[nodiscard]] Solution solve_from(Transcription& program, const Eigen::VectorXd& start,
                                  const std::optional<Trajectory>& with_costates, const Solver& solver);

}  // namespace dmocbench
