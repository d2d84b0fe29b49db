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

  /// Sets rate_q(), rate_p() and control() to the values at this stage.
  void evaluate(const Trajectory& trajectory, Eigen::Index stage) {
    function_.evaluate(trajectory.stage(stage), trajectory.stage_times[stage], values_);
    const Eigen::VectorXd psi_q = trajectory.stage_psi_q.row(stage).transpose();
    const Eigen::VectorXd psi_p = trajectory.stage_psi_p.row(stage).transpose();
    const std::optional<Eigen::VectorXd> rate_p =
        solve_if_invertible(square(2), -(values_.segment(n_, n_) + psi_q + square(1).transpose() * psi_p));
    if (!rate_p) throw Error("the Lagrangian is not regular: L_vv is singular on the motion");
    rate_p_ = *rate_p;
    rate_q_ = -(values_.head(n_) + square(0).transpose() * psi_p + square(3).transpose() * rate_p_);
    cost_by_control_ = values_.segment(2 * n_, m_);
    control_ = cost_by_control_ + values_.tail(n_ * m_).reshaped(n_, m_).transpose() * psi_p;
  }

  [[nodiscard]] const Eigen::VectorXd& rate_q() const { return rate_q_; }                    ///< φ^q
  [[nodiscard]] const Eigen::VectorXd& rate_p() const { return rate_p_; }                    ///< φ^p
  [[nodiscard]] const Eigen::VectorXd& control() const { return control_; }                  ///< H_u
  [[nodiscard]] const Eigen::VectorXd& cost_by_control() const { return cost_by_control_; }  ///< C_u

 private:
  /// F_q, F_v, L_vv or L_vq.
  [[nodiscard]] Eigen::MatrixXd square(Eigen::Index which) const {
    return values_.segment(2 * n_ + m_ + which * n_ * n_, n_ * n_).reshaped(n_, n_);
  }

  Eigen::Index n_;
  Eigen::Index m_;
  PointFunction function_;
  Eigen::VectorXd values_;
  Eigen::VectorXd rate_q_;
  Eigen::VectorXd rate_p_;
  Eigen::VectorXd control_;
  Eigen::VectorXd cost_by_control_;
};

void raise(double& largest, double value) { largest = std::max(largest, value); }

/// The residuals of one interval for one half of the scheme. `stages` and `rates` are n × s, `left` and `right` the
/// costates at the nodes.
void raise_half(const Eigen::VectorXd& left, const Eigen::VectorXd& right, const Eigen::MatrixXd& stages,
                const Eigen::MatrixXd& rates, const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double& step,
                double& stage) {
  raise(step, (right - left - rates * b).lpNorm<Eigen::Infinity>());
  // lazyProduct: the blocked product costs seconds of compile time and pays off only for large matrices.
  raise(stage, ((stages - rates.lazyProduct(a.transpose())).colwise() - left).lpNorm<Eigen::Infinity>());
}

double size_of(const Eigen::MatrixXd& values) {
  return std::max(values.lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::min());
}

}  // namespace

AdjointCoefficients adjoint_coefficients(const Tableau& tableau) {
  return {.a_q = conjugate_coefficients(tableau.a, tableau.b),
          .a_p = conjugate_coefficients(tableau.a_conjugate, tableau.b)};
}

double AdjointResidual::largest() const { return std::max({step_q, step_p, stage_q, stage_p, control.value_or(0.0)}); }

AdjointResidual adjoint_residual(const Problem& problem, const Trajectory& trajectory,
                                 const AdjointCoefficients& coefficients) {
  if (!trajectory.has_costates()) {
    throw Error("the adjoint scheme needs costates: give it a solution of a solver that has multipliers");
  }
  AdjointEquations equations{TracedProblem(problem)};
  const Tableau& tableau = trajectory.tableau;
  const Eigen::Index s = tableau.stages();
  const Eigen::Index n = trajectory.q.cols();
  AdjointResidual residual;
  double control = 0.0;
  double cost_by_control = 0.0;
  Eigen::MatrixXd rates_q(n, s);
  Eigen::MatrixXd rates_p(n, s);
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    const double h = trajectory.step(k);
    for (Eigen::Index i = 0; i < s; ++i) {
      equations.evaluate(trajectory, k * s + i);
      rates_q.col(i) = h * equations.rate_q();
      rates_p.col(i) = h * equations.rate_p();
      raise(control, equations.control().lpNorm<Eigen::Infinity>());
      raise(cost_by_control, equations.cost_by_control().lpNorm<Eigen::Infinity>());
    }
    raise_half(trajectory.psi_q.row(k).transpose(), trajectory.psi_q.row(k + 1).transpose(),
               trajectory.stage_psi_q.middleRows(k * s, s).transpose(), rates_q, coefficients.a_q, tableau.b,
               residual.step_q, residual.stage_q);
    raise_half(trajectory.psi_p.row(k).transpose(), trajectory.psi_p.row(k + 1).transpose(),
               trajectory.stage_psi_p.middleRows(k * s, s).transpose(), rates_p, coefficients.a_p, tableau.b,
               residual.step_p, residual.stage_p);
  }
  const double size_q = size_of(trajectory.psi_q);
  const double size_p = size_of(trajectory.psi_p);
  residual.step_q /= size_q;
  residual.stage_q /= size_q;
  residual.step_p /= size_p;
  residual.stage_p /= size_p;
  if (!tableau.shares_controls) {
    residual.control = control / std::max(cost_by_control, std::numeric_limits<double>::min());
  }
  return residual;
}

}  // namespace dmocbench
