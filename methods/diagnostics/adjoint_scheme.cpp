#include "methods/diagnostics/adjoint_scheme.hpp"

#include <algorithm>
#include <limits>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

namespace {

/// The adjoint equations at a stage, with F = L_q + f, G = C + ψ^q·v + ψ^p·F + ψ^y·g at fixed v, and v = v(q, p, y):
/// ∂v/∂p = L_vv⁻¹, ∂v/∂q = -L_vv⁻¹ L_vq and ∂v/∂y = -L_vv⁻¹ L_vy give φ^p = -L_vv⁻¹ G_v, φ^q = -G_q - L_vqᵀ φ^p and
/// φ^y = -G_y - L_vyᵀ φ^p. C is less the integrals at their prices.
class AdjointEquations {
 public:
  AdjointEquations(const TracedProblem& problem, const Eigen::VectorXd& prices)
      : n_(problem.configuration_size()),
        m_(problem.control_size()),
        l_(problem.first_order_size()),
        function_(problem,
                  [&](const ControlledState& x) {
                    const TracedProblem::Values values = problem.at(x);
                    Expression cost = values.running_cost;
                    for (Eigen::Index i = 0; i < prices.size(); ++i)
                      cost -= Expression(prices[i]) * values.integrands[i];
                    ExpressionVector all(1 + n_ + l_);  // what ψ is multiplied by in G, after C
                    all << cost, values.generalised_force, values.first_order_rates;
                    ExpressionVector point(2 * n_ + m_ + l_);
                    point << x.q, x.v, x.u, x.y;
                    ExpressionVector outputs(all.size() * point.size() + n_ * (2 * n_ + l_));
                    outputs << jacobian(all, point).reshaped(), values.mass.reshaped(),
                        values.momentum_by_configuration.reshaped(), values.momentum_by_first_order.reshaped();
                    return outputs;
                  }),
        values_(function_.output_count()) {}

  struct Values {
    Eigen::VectorXd rate_q;           ///< φ^q
    Eigen::VectorXd rate_p;           ///< φ^p
    Eigen::VectorXd rate_y;           ///< φ^y
    Eigen::VectorXd control;          ///< H_u
    Eigen::VectorXd cost_by_control;  ///< C_u
  };
  [[nodiscard]] Values at(const Trajectory& trajectory, Eigen::Index stage) {
    function_.evaluate(trajectory.stage(stage), trajectory.stage_times[stage], values_);
    const Eigen::VectorXd psi_q = trajectory.stage_psi_q.row(stage).transpose();
    Eigen::VectorXd factors(1 + n_ + l_);
    factors << 1.0, trajectory.stage_psi_p.row(stage).transpose(), Trajectory::row_of(trajectory.stage_psi_y, stage);
    const Eigen::Index size = 2 * n_ + m_ + l_;
    const Eigen::MatrixXd derivatives = values_.head(factors.size() * size).reshaped(factors.size(), size);
    const Eigen::VectorXd by_point = derivatives.transpose() * factors;  // of C + ψ^p·F + ψ^y·g
    const Eigen::MatrixXd of_momentum = values_.tail(n_ * size_of_momentum()).reshaped(n_, size_of_momentum());
    const std::optional<Eigen::VectorXd> rate_p =
        solve_if_invertible(of_momentum.leftCols(n_), -(by_point.segment(n_, n_) + psi_q));
    if (!rate_p) throw Error("the Lagrangian is not regular: L_vv is singular on the trajectory");
    return {.rate_q = -(by_point.head(n_) + of_momentum.middleCols(n_, n_).transpose() * *rate_p),
            .rate_p = *rate_p,
            .rate_y = -(by_point.tail(l_) + of_momentum.rightCols(l_).transpose() * *rate_p),
            .control = by_point.segment(2 * n_, m_),
            .cost_by_control = derivatives.row(0).segment(2 * n_, m_).transpose()};
  }

 private:
  /// The columns of (L_vv, L_vq, L_vy).
  [[nodiscard]] Eigen::Index size_of_momentum() const { return 2 * n_ + l_; }

  Eigen::Index n_;
  Eigen::Index m_;
  Eigen::Index l_;
  PointFunction function_;
  Eigen::VectorXd values_;
};

void raise(double& largest, const Eigen::MatrixXd& values) {
  largest = std::max(largest, values.lpNorm<Eigen::Infinity>());
}

/// The residuals of one half of the scheme, relative to the largest costate of the nodes.
struct HalfResidual {
  double step = 0.0;
  double stage = 0.0;
};

/// `nodes` and `stages` are tables of costates, a row per node and per stage; `rates` has a column h φ_i per stage.
HalfResidual half_residual(const Eigen::MatrixXd& nodes, const Eigen::MatrixXd& stages, const Eigen::MatrixXd& rates,
                           const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  HalfResidual residual;
  const Eigen::Index s = b.size();
  for (Eigen::Index k = 0; k + 1 < nodes.rows(); ++k) {
    const Eigen::VectorXd left = nodes.row(k).transpose();
    const Eigen::MatrixXd own_rates = rates.middleCols(k * s, s);
    raise(residual.step, nodes.row(k + 1).transpose() - left - own_rates * b);
    // lazyProduct: the blocked product costs seconds of compile time and pays off only for large matrices.
    raise(residual.stage,
          (stages.middleRows(k * s, s).transpose() - own_rates.lazyProduct(a.transpose())).colwise() - left);
  }
  const double size = std::max(nodes.lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::min());
  return {residual.step / size, residual.stage / size};
}

}  // namespace

AdjointCoefficients adjoint_coefficients(const Tableau& tableau) {
  return {.a_q = conjugate_coefficients(tableau.a, tableau.b),
          .a_p = conjugate_coefficients(tableau.a_conjugate, tableau.b)};
}

double AdjointResidual::largest() const {
  return std::max({step_q, step_p, step_y, stage_q, stage_p, stage_y, control.value_or(0.0)});
}

AdjointResidual adjoint_residual(const Problem& problem, const Trajectory& trajectory,
                                 const AdjointCoefficients& coefficients) {
  if (!trajectory.has_costates() || !trajectory.has_stage_costates()) {
    throw Error(
        "the adjoint scheme needs costates at the stages: use a solution with multipliers; the problem cannot have "
        "path constraints or bounds on velocities");
  }
  const ParameterScope scope = with_unknowns(problem, trajectory.unknowns);
  AdjointEquations equations{TracedProblem(problem), trajectory.integral_prices};
  const Tableau& tableau = trajectory.tableau;
  double control = 0.0;
  double cost_by_control = 0.0;
  Eigen::MatrixXd rates_q(trajectory.q.cols(), trajectory.stage_q.rows());
  Eigen::MatrixXd rates_p(rates_q.rows(), rates_q.cols());
  Eigen::MatrixXd rates_y(trajectory.y.cols(), rates_q.cols());
  for (Eigen::Index stage = 0; stage < rates_q.cols(); ++stage) {
    const double h = trajectory.step(stage / tableau.stages());
    const AdjointEquations::Values values = equations.at(trajectory, stage);
    rates_q.col(stage) = h * values.rate_q;
    rates_p.col(stage) = h * values.rate_p;
    rates_y.col(stage) = h * values.rate_y;
    raise(control, values.control);
    raise(cost_by_control, values.cost_by_control);
  }
  const HalfResidual q = half_residual(trajectory.psi_q, trajectory.stage_psi_q, rates_q, coefficients.a_q, tableau.b);
  const HalfResidual p = half_residual(trajectory.psi_p, trajectory.stage_psi_p, rates_p, coefficients.a_p, tableau.b);
  AdjointResidual residual{.step_q = q.step, .step_p = p.step, .stage_q = q.stage, .stage_p = p.stage};
  if (rates_y.size() > 0) {
    const HalfResidual y =
        half_residual(trajectory.psi_y, trajectory.stage_psi_y, rates_y, coefficients.a_q, tableau.b);
    residual.step_y = y.step;
    residual.stage_y = y.stage;
  }
  if (!tableau.shares_controls) {
    residual.control = control / (cost_by_control > 0.0 ? cost_by_control : trajectory.psi_p.lpNorm<Eigen::Infinity>());
  }
  return residual;
}

}  // namespace dmocbench
