#include "methods/mechanics/legendre_transform.hpp"

#include <limits>

#include "methods/error.hpp"
#include "methods/mechanics/motion_constraints.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

LegendreTransform::LegendreTransform(const TracedProblem& problem)
    : n_(problem.configuration_size()),
      c_(problem.constraint_count()),
      function_(problem,
                [&](const ControlledState& x) {
                  const TracedProblem::Values values = problem.at(x);
                  ExpressionVector outputs(n_ + 2 * n_ * n_ + values.momentum_by_first_order.size());
                  outputs << values.momentum, values.mass.reshaped(), values.momentum_by_configuration.reshaped(),
                      values.momentum_by_first_order.reshaped();
                  if (c_ == 0) return outputs;
                  return stacked({outputs, problem.constraints_at(x.q, x.v).jacobian.reshaped()});
                }),
      values_(function_.output_count()) {}

LegendreTransform::Values LegendreTransform::at(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                                const Eigen::VectorXd& y) {
  function_.evaluate(q, v, Eigen::VectorXd(), t, values_, y);
  const Eigen::Index squared = n_ * n_;
  return {.momentum = values_.head(n_),
          .mass = values_.segment(n_, squared).reshaped(n_, n_),
          .by_configuration = values_.segment(n_ + squared, squared).reshaped(n_, n_),
          .by_first_order = values_.segment(n_ + 2 * squared, n_ * y.size()).reshaped(n_, y.size())};
}

Eigen::VectorXd LegendreTransform::momentum(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                            const Eigen::VectorXd& y) {
  return at(q, v, t, y).momentum;
}

std::optional<Eigen::VectorXd> LegendreTransform::velocity_correction(const Eigen::MatrixXd& mass,
                                                                      const Eigen::VectorXd& residual,
                                                                      const Eigen::VectorXd& v) const {
  if (c_ == 0) return solve_if_invertible(mass, residual);
  const Eigen::MatrixXd jacobian = values_.tail(c_ * n_).reshaped(c_, n_);
  Eigen::VectorXd right(n_ + c_);
  right << residual, -(jacobian * v);
  std::optional<Eigen::VectorXd> correction = solve_if_invertible(saddle_matrix(mass, jacobian), right);
  if (correction) correction->conservativeResize(n_);
  return correction;
}

Eigen::VectorXd LegendreTransform::velocity(const Eigen::VectorXd& q, const Eigen::VectorXd& p, double t,
                                            const Eigen::VectorXd& start, const Eigen::VectorXd& y) {
  constexpr int most_steps = 50;
  constexpr double tolerance = 1e-14;
  constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
  Eigen::VectorXd v = start;
  for (int step = 0; step < most_steps; ++step) {
    const Values values = at(q, v, t, y);
    const Eigen::VectorXd residual = p - values.momentum;
    const Eigen::MatrixXd& mass = values.mass;
    const std::optional<Eigen::VectorXd> correction = velocity_correction(mass, residual, v);
    if (!correction) throw Error("the Lagrangian is not regular: L_vv is singular on the trajectory");
    // A residual of rounding size counts as zero, however large a correction an ill-conditioned L_vv makes of it.
    const Eigen::VectorXd smallest = rounding * (p.cwiseAbs() + mass.cwiseAbs() * v.cwiseAbs());
    const bool is_rounding = c_ == 0 && (residual.array().abs() <= smallest.array()).all();
    v += *correction;
    if (is_rounding || correction->norm() <= tolerance * (1.0 + v.norm())) return v;
  }
  throw Error("the inverse Legendre transform did not converge; the Lagrangian must be convex in the velocity");
}

}  // namespace dmocbench
