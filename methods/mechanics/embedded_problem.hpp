#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "methods/expression/schedule.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A problem with constraints g(q) = 0 in the n - c coordinates θ of its embedding q = Φ(θ) (`Problem::embedding`), or
/// Φ(θ, t) (`Problem::moving_embedding`).
///
/// Its formulas describe a problem without constraints: L(Φ, Φ_θ θ̇ + Φ_t), the force Φ_θᵀ f and so on, with ends
/// and a guess in θ. An element that takes an embedding (`Element::takes_embedding`) has θ at the nodes only: its
/// stages are stages of the redundant statement, between Φ(θ_k, t_k) and Φ(θ_{k+1}, t_{k+1}) (the discrete null space
/// method with nodal reparametrisation). Its answers then equal the answers by multipliers. Parameters keep the values
/// that they have when this is made.
class EmbeddedProblem final : public Problem {
 public:
  /// The redundant problem is shared and not modified. Throws `Error` if it states no constraints or no embedding, the
  /// embedding has not n entries, leaves g(q) = 0 or misses an end; if an end is given in part; if there are bounds
  /// between the ends on q̇, or on a q_i that is not an entry of θ; or a parameter is an unknown.
  explicit EmbeddedProblem(std::shared_ptr<const Problem> redundant);

  /// The statement with constraints.
  [[nodiscard]] const Problem* redundant() const override { return redundant_.get(); }
  /// (Φ, Φ_θ θ̇ + Φ_t) at time t.
  [[nodiscard]] BoundaryState lifted(const BoundaryState& state, double t) const;

  /// The redundant statement's with "_embedded" after it.
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override;
  /// theta_1 to theta_{n-c}.
  [[nodiscard]] std::vector<std::string> configuration_names() const override;
  [[nodiscard]] std::vector<std::string> control_names() const override { return redundant_->control_names(); }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return redundant_->first_order_names(); }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override;
  [[nodiscard]] Expression lagrangian(const State& x) const override;
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override;
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override;
  [[nodiscard]] BoundaryState initial_state() const override { return first_; }
  [[nodiscard]] BoundaryState final_state() const override { return last_; }
  [[nodiscard]] double horizon() const override { return redundant_->horizon(); }
  [[nodiscard]] ProblemBounds bounds() const override;
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override;
  [[nodiscard]] ExpressionVector integrands(const ControlledState& x) const override;
  [[nodiscard]] ExpressionVector boundary_conditions(const State& first, const State& last) const override;
  [[nodiscard]] Expression final_cost(const State& last) const override;
  [[nodiscard]] double cost_scale() const override { return redundant_->cost_scale(); }
  /// The redundant statement's, at the nearest points of the manifold.
  [[nodiscard]] MotionPoint guess(double t) const override;
  [[nodiscard]] std::string settings() const override { return redundant_->settings(); }

 private:
  /// Φ and its derivatives in numbers.
  struct Chart {
    Eigen::VectorXd q;         // n entries
    Eigen::MatrixXd jacobian;  // Φ_θ, n × (n - c)
    Eigen::VectorXd rate;      // Φ_t, n entries
  };
  [[nodiscard]] Chart chart_at(const Eigen::VectorXd& theta, double t) const;
  [[nodiscard]] State lifted(const State& x) const;
  [[nodiscard]] ControlledState lifted(const ControlledState& x) const;
  void trace_embedding();
  /// The bounds between the ends in θ.
  [[nodiscard]] Bounds bounds_on_theta(const ProblemBounds& bounds) const;
  /// Throws `Error` if g(Φ) is not 0 at some θ and t.
  void require_on_manifold() const;
  /// The θ for which Φ(θ, t) is nearest to q, by Gauss's and Newton's method from `theta`.
  [[nodiscard]] Eigen::VectorXd nearest(const Eigen::VectorXd& q, Eigen::VectorXd theta, double t) const;
  /// The same at t = 0 from several θ, if one leads there.
  [[nodiscard]] Eigen::VectorXd nearest_of_all(const Eigen::VectorXd& q) const;
  /// θ̇ with Φ_θ θ̇ + Φ_t nearest to v.
  [[nodiscard]] Eigen::VectorXd rate_of(const Eigen::VectorXd& v, const Eigen::VectorXd& theta, double t) const;
  /// An end in θ, at time t. Throws `Error` if it is given and missed.
  [[nodiscard]] BoundaryState end_of(const BoundaryState& state, const Eigen::VectorXd& theta, double t,
                                     const EndBounds& bounds, const char* end) const;

  std::shared_ptr<const Problem> redundant_;
  Eigen::Index freedoms_ = 0;  // n - c
  Schedule embedding_;         // of (θ, t)
  Schedule chart_;             // Φ, Φ_θ column by column, Φ_t, of (θ, t)
  Schedule velocity_;          // Φ_θ θ̇ + Φ_t, of (θ, t, θ̇)
  BoundaryState first_;
  BoundaryState last_;
  Eigen::MatrixXd guessed_;  // θ along the guess, a row per time: where `guess` starts
};

}  // namespace dmocbench
