#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "methods/program/lane_program.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/batch/lane_bounds.hpp"
#include "methods/solvers/batch/lane_vector.hpp"

namespace dmocbench::batch {

/// Whether something holds, lane by lane.
using LaneMask = std::array<bool, instance_lanes>;

/// The values of eight instances, each at a point of its own: `interior_point::Evaluation` in lanes.
struct LaneValues {
  LaneVector constraints;  ///< residuals c
  OfLanes objective;       ///< f
  OfLanes theta;           ///< θ = Σ |c_i|
  OfLanes violation;       ///< max |c_i|
  OfLanes barrier;         ///< -Σ ln d
};

/// Eight barrier problems side by side: `interior_point::BarrierProgram` in lanes. A point is primal: the unknowns, and
/// after them the slacks of inequalities.
///
/// The program's bounds are read when it is made only: while threads work, single solves give the program the values of
/// their own instance.
class LaneProblem {
 public:
  /// `program` has an interval structure and must outlive this.
  LaneProblem(const NonlinearProgram& program, std::unique_ptr<LaneProgram> lanes);

  [[nodiscard]] LaneProgram& program() noexcept { return *lanes_; }
  [[nodiscard]] const LaneBounds& bounds() const noexcept { return bounds_; }
  [[nodiscard]] bool has_bounds() const noexcept { return bounds_.count() > 0; }
  [[nodiscard]] const std::vector<Eigen::Index>& inequalities() const noexcept { return inequalities_; }
  [[nodiscard]] Eigen::Index variable_count() const noexcept { return variables_; }
  [[nodiscard]] Eigen::Index constraint_count() const noexcept { return constraints_; }
  /// The variables whose bounds are equal, in ascending order.
  [[nodiscard]] const std::vector<Eigen::Index>& fixed() const noexcept { return fixed_; }
  [[nodiscard]] Eigen::Index primal_count() const noexcept {
    return variables_ + static_cast<Eigen::Index>(inequalities_.size());
  }

  /// The values that the equalities of the instance in a lane have, constraint_count() entries; none for the values of
  /// the program.
  void set_equality_values(std::size_t lane, const Eigen::VectorXd& values);

  /// The values at a point. In the `fresh` lanes the slacks are first set to a(x), inside their bounds by the share
  /// `push`.
  void evaluate(const LaneMask& fresh, const OfLanes& push, LaneVector& primal, LaneValues& values);
  /// Gradient and Jacobian at a point.
  void differentiate(const LaneVector& primal);
  void evaluate_hessian(const LaneVector& primal, const LaneVector& multipliers);
  /// The gradient of f + λᵀc with respect to the unknowns and slacks, zero for fixed unknowns.
  void find_gradient_of_lagrangian(const LaneVector& multipliers);

  [[nodiscard]] const LaneVector& gradient() const noexcept { return gradient_; }
  [[nodiscard]] const LaneVector& jacobian() const noexcept { return jacobian_; }
  [[nodiscard]] LaneVector& hessian() noexcept { return hessian_; }
  [[nodiscard]] const LaneVector& gradient_of_lagrangian() const noexcept { return of_lagrangian_; }

  /// The lengths of steps, as `NewtonCorrections` measures them: by the runs of the interval structure.
  [[nodiscard]] OfLanes length_of(const LaneVector& step, const LaneVector& primal, const OfLanes& change_of_objective,
                                  const OfLanes& objective) const;

 private:
  const NonlinearProgram& program_;
  std::unique_ptr<LaneProgram> lanes_;
  std::vector<Eigen::Index> inequalities_;
  std::vector<Eigen::Index> fixed_;
  Eigen::VectorXd usual_rows_;  // the values of equalities that an instance without values of its own has
  LaneBounds bounds_;
  Eigen::Index variables_;
  Eigen::Index constraints_;
  LaneVector rows_;  // the values of equalities; 0 of inequalities
  LaneVector gradient_;
  LaneVector jacobian_;
  LaneVector hessian_;
  LaneVector of_lagrangian_;
};

}  // namespace dmocbench::batch
