#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/motion_constraints.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

/// A motion of the continuous system, the forced Euler-Lagrange equations (eq:varmech_FEL), integrated along with its
/// cost by an adaptive Runge-Kutta method of order 7(8). It is independent of every discretisation.
class DrivenMotion {
 public:
  /// The control at time t, m entries.
  using Control = std::function<Eigen::VectorXd(double t)>;

  /// Traces the equations of motion. The tolerance of the integration is absolute and relative.
  DrivenMotion(const Problem& problem, double tolerance);

  /// Begins at a state, with a cost of 0.
  void begin_at(const BoundaryState& start);
  /// Moves on from time `from` to `to` under a control without jumps between them: a step across a jump has order 1.
  /// Throws `Error` if the integration fails: the motion leaves the domain of the equations, or the steps vanish.
  void carry(const Control& control, double from, double to);

  /// (q, v, y) now.
  [[nodiscard]] BoundaryState state() const;
  /// The integral of the running cost so far.
  [[nodiscard]] double running_cost() const noexcept { return state_.back(); }
  /// Φ now, if the motion ends at time t.
  [[nodiscard]] double final_cost(double t);

 private:
  double tolerance_;
  Eigen::Index n_;
  Eigen::Index l_;
  TracedProblem traced_;
  EquationsOfMotion motion_;
  std::optional<MotionConstraints> constraints_;  // of reduced index, the equations of motion drift away from them
  PointFunction running_cost_;
  PointFunction final_cost_;
  Eigen::VectorXd cost_ = Eigen::VectorXd(1);
  std::vector<double> state_;  // q, v, y, then the cost so far
};

}  // namespace dmocbench
