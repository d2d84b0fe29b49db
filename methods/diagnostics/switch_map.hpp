#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "methods/expression/schedule.hpp"
#include "methods/mechanics/phased_problem.hpp"

namespace dmocbench {

/// The state after a switch of a phased problem, as a function of the state before it.
class SwitchMap {
 public:
  /// Of switch i, with the unknown parameters as solved, in the order of `Problem::unknowns`. Where it has more
  /// conditions than the state after has components, unknowns such as impulses follow from the state before too; more
  /// conditions than these are met in the least-squares sense.
  SwitchMap(const PhasedProblem& problem, std::size_t i, const Eigen::VectorXd& unknowns);

  /// The state after the switch in the velocities of its phase, by Newton's method from `start`. `before`: in the
  /// velocities of its own phase, whose time is `time`. The guard need not hold there. Throws `Error` if it is not
  /// found.
  [[nodiscard]] BoundaryState after(const BoundaryState& before, double time, const BoundaryState& start) const;

 private:
  Schedule conditions_;  // r, then ∂r/∂(q, v, y after, unknowns), column by column; of (unknowns, before, t, after)
  Eigen::VectorXd unknowns_;  // as solved
  Eigen::Index rows_ = 0;
  Eigen::Index solved_ = 0;  // components that are solved for: those after the switch, or the unknowns too
};

}  // namespace dmocbench
