#pragma once

#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

/// The constraints g(q) = 0 and A(q) q̇ = 0 of a problem, in numbers.
class MotionConstraints {
 public:
  /// Traces them for the problem.
  explicit MotionConstraints(const TracedProblem& problem);

  /// Moves to a configuration, n entries.
  void evaluate(const Eigen::VectorXd& q);

  /// Moves q to where g vanishes to rounding, by Newton steps of least length, and v to where G v does, A among the
  /// rows of G: n entries each.
  void project(Eigen::Ref<Eigen::VectorXd> q, Eigen::Ref<Eigen::VectorXd> v);

  /// c.
  [[nodiscard]] Eigen::Index count() const noexcept { return c_; }
  /// How many of them are g(q) = 0.
  [[nodiscard]] Eigen::Index holonomic_count() const noexcept { return holonomic_; }
  /// g, as many entries.
  [[nodiscard]] Eigen::VectorXd residual() const { return values_.head(holonomic_); }
  /// G = ∂g/∂q, then A, c × n.
  [[nodiscard]] Eigen::MatrixXd jacobian() const { return values_.segment(holonomic_, c_ * n_).reshaped(c_, n_); }
  /// ∂(Gᵀμ)/∂q, n × n, for c numbers μ; symmetric without velocity constraints.
  [[nodiscard]] Eigen::MatrixXd force_by_configuration(const Eigen::VectorXd& mu) const;

 private:
  Eigen::Index n_;
  Eigen::Index c_;
  Eigen::Index holonomic_;
  PointFunction function_;  // outputs: g, G and ∂G/∂q, column by column
  Eigen::VectorXd values_;
};

/// λ of the constraints of a problem at a point, as formulas: c entries, first of g(q) = 0. They solve
/// L_vv q̈ + Gᵀλ = L_q + f - ..., G q̈ = -Ġ q̇ (`EquationsOfMotion`), so that path constraints which call this bound
/// forces of constraint in the same way for every method.
///
/// -Gᵀλ is the force on the motion. With g = -(the height above a floor) the floor presses upwards with λ >= 0; with g
/// = the height the pressure is -λ. Throws `Error` if L_vv, or G L_vv⁻¹ Gᵀ, has a pivot that is a structural zero.
[[nodiscard]] ExpressionVector constraint_multipliers(const Problem& problem, const ControlledState& x);

/// Columns of G, c × n, that are independent, c of them: those with `is_preferred` first, and the largest pivots. Fewer
/// where G has less than full rank.
[[nodiscard]] std::vector<Eigen::Index> independent_columns(Eigen::MatrixXd jacobian,
                                                            const std::vector<bool>& is_preferred);

/// (A, Gᵀ; G, 0), n + c square.
[[nodiscard]] Eigen::MatrixXd saddle_matrix(const Eigen::MatrixXd& a, const Eigen::MatrixXd& jacobian);

}  // namespace dmocbench
