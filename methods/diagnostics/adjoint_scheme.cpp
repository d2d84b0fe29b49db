#include "methods/diagnostics/adjoint_scheme.hpp"

#include <algorithm>
#include <limits>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

namespace {

/// The adjoint equations at a stage, with F = L_q + f, G = C + ψ^q·v + ψ^p·F at fixed v, and v = v(q, p):
/// ∂v/∂p = L_vv⁻¹ and ∂v/∂q = -L_vv⁻¹ L_vq give φ^p = -L_vv⁻¹ G_v, φ^q = -G_q - L_vqᵀ φ^p.
class AdjointEquations {
 public:
  explicit AdjointEquations(const TracedProblem& problem)
      : n_(problem.configuration_size()),
        m_(problem.control_size()),
        function_(n_, m_,
                  [&](const ControlledState& x) {
                    const TracedProblem::Values values = problem.at(x);
                    const ExpressionVector& force = values.generalised_force;
                    ExpressionVector outputs(2 * n_ + m_ + 4 * n_ * n_ + n_ * m_);
                    outputs << gradient(values.running_cost, x.q), gradient(values.running_cost, x.v),
                        gradient(values.running_cost, x.u), jacobian(force, x.q).reshaped(),
                        jacobian(force, x.v).reshaped(), values.mass.reshaped(),
                        values.momentum_by_configuration.reshaped(), jacobian(force, x.u).reshaped();
                    return outputs;
                  }),
        values_(function_.output_count()) {}

  struct Values {
    Eigen::VectorXd rate_q;           ///< φ^q
    Eigen::VectorXd rate_p;           ///< φ^p
    Eigen::VectorXd control;          ///< H_u
    Eigen::VectorXd cost_by_control;  ///< C_u
  };
  [[nodiscard]] Values at(const Trajectory& trajectory, Eigen::Index stage) {
    function_.evaluate(trajectory.stage(stage), trajectory.stage_times[stage], values_);
    const Eigen::VectorXd psi_q = trajectory.stage_psi_q.row(stage).transpose();
    const Eigen::VectorXd psi_p = trajectory.stage_psi_p.row(stage).transpose();
    const std::optional<Eigen::VectorXd> rate_p =
        solve_if_invertible(square(2), -(values_.segment(n_, n_) + psi_q + square(1).transpose() * psi_p));
    if (!rate_p) throw Error("the Lagrangian is not regular: L_vv is singular on the motion");
    const Eigen::VectorXd cost_by_control = values_.segment(2 * n_, m_);
    return {.rate_q = -(values_.head(n_) + square(0).transpose() * psi_p + square(3).transpose() * *rate_p),
            .rate_p = *rate_p,
            .control = cost_by_control + values_.tail(n_ * m_).reshaped(n_, m_).transpose() * psi_p,
            .cost_by_control = cost_by_control};
  }

 private:
  /// F_q, F_v, L_vv or L_vq.
  [[nodiscard]] Eigen::MatrixXd square(Eigen::Index which) const {
    return values_.segment(2 * n_ + m_ + which * n_ * n_, n_ * n_).reshaped(n_, n_);
  }

  Eigen::Index n_;
  Eigen::Index m_;
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

double AdjointResidual::largest() const { return std::max({step_q, step_p, stage_q, stage_p, control.value_or(0.0)}); }

AdjointResidual adjoint_residual(const Problem& problem, const Trajectory& trajectory,
                                 const AdjointCoefficients& coefficients) {
  if (!trajectory.has_costates() || !trajectory.has_stage_costates()) {
    throw Error(
        "the adjoint scheme needs costates at the stages: give it a solution with multipliers of a problem without "
        "path constraints and bounds on velocities");
  }
  AdjointEquations equations{TracedProblem(problem)};
  const Tableau& tableau = trajectory.tableau;
  double control = 0.0;
  double cost_by_control = 0.0;
  Eigen::MatrixXd rates_q(trajectory.q.cols(), trajectory.stage_q.rows());
  Eigen::MatrixXd rates_p(rates_q.rows(), rates_q.cols());
  for (Eigen::Index stage = 0; stage < rates_q.cols(); ++stage) {
    const double h = trajectory.step(stage / tableau.stages());
    const AdjointEquations::Values values = equations.at(trajectory, stage);
    rates_q.col(stage) = h * values.rate_q;
    rates_p.col(stage) = h * values.rate_p;
    raise(control, values.control);
    raise(cost_by_control, values.cost_by_control);
  }
  const HalfResidual q = half_residual(trajectory.psi_q, trajectory.stage_psi_q, rates_q, coefficients.a_q, tableau.b);
  const HalfResidual p = half_residual(trajectory.psi_p, trajectory.stage_psi_p, rates_p, coefficients.a_p, tableau.b);
  AdjointResidual residual{
      .step_q = q.step, .step_p = p.step, .stage_q = q.stage, .stage_p = p.stage, .control = std::nullopt};
  if (!tableau.shares_controls) {
    residual.control = control / (cost_by_control > 0.0 ? cost_by_control : trajectory.psi_p.lpNorm<Eigen::Infinity>());
  }
  return residual;
}

}  // namespace dmocbench
