#pragma once

#include <vector>

#include "methods/mechanics/phased_problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The part of one phase in a motion of phases side by side.
struct PhaseTrajectory {
  double start = 0.0;  ///< the time of the whole motion at which the phase begins
  /// In the phase's own time, which begins at 0, its own velocities, and with its own unknowns. Costates and prices are
  /// the whole's; the price of T is the price of the duration. Cost and integrals are missing.
  Trajectory motion;
};

/// The parts of all phases in their order.
[[nodiscard]] std::vector<PhaseTrajectory> phase_trajectories(const PhasedProblem& problem, const Trajectory& all);

}  // namespace dmocbench
