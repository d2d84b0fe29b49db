#include "methods/diagnostics/control_lagrangian.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/vectors.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/elements/polynomial_rates.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

/// F and P of a form at a point.
std::pair<ExpressionVector, ExpressionVector> terms(const TracedProblem::Values& values, const ControlledState& x,
                                                    ControlLagrangianForm form) {
  if (form == ControlLagrangianForm::forced_euler_lagrange) return {values.generalised_force, values.momentum};
  const ExpressionVector inertial = values.momentum_by_configuration * x.v + values.momentum_by_time;
  return {solve_symmetric(values.mass, values.generalised_force - inertial), x.v};
}

/// The derivatives of Λ at the midpoints of intervals.
class ControlLagrangian {
 public:
  ControlLagrangian(const TracedProblem& problem, ControlLagrangianForm form)
      : n_(problem.configuration_size()),
        m_(problem.control_size()),
        function_(n_, m_,
                  [&](const ControlledState& x) {
                    const TracedProblem::Values values = problem.at(x);
                    const auto [force, momentum] = terms(values, x, form);
                    const Expression& cost = values.running_cost;
                    ExpressionVector outputs(4 * n_ + m_ + 4 * n_ * n_ + n_ * m_);
                    outputs << force, momentum, gradient(cost, x.q), gradient(cost, x.v), gradient(cost, x.u),
                        jacobian(force, x.q).reshaped(), jacobian(force, x.v).reshaped(),
                        jacobian(momentum, x.q).reshaped(), jacobian(momentum, x.v).reshaped(),
                        jacobian(force, x.u).reshaped();
                    return outputs;
                  }),
        values_(function_.output_count()) {}

  struct Derivatives {
    Eigen::VectorXd q;                ///< Λ_q
    Eigen::VectorXd v;                ///< Λ_q̇
    Eigen::VectorXd u;                ///< Λ_u
    Eigen::VectorXd xi;               ///< Λ_ξ = F
    Eigen::VectorXd xi_rate;          ///< Λ_ξ̇ = P
    Eigen::VectorXd cost_by_control;  ///< C_u
  };
  [[nodiscard]] Derivatives at(const MotionPoint& point, double t, const Eigen::VectorXd& xi,
                               const Eigen::VectorXd& xi_rate) {
    function_.evaluate(point, t, values_);
    const Eigen::VectorXd cost_by_control = values_.segment(4 * n_, m_);
    const auto of_force = values_.tail(n_ * m_).reshaped(n_, m_);
    return {.q = part(2) + square(0).transpose() * xi + square(2).transpose() * xi_rate,
            .v = part(3) + square(1).transpose() * xi + square(3).transpose() * xi_rate,
            .u = cost_by_control + of_force.transpose() * xi,
            .xi = part(0),
            .xi_rate = part(1),
            .cost_by_control = cost_by_control};
  }

 private:
  [[nodiscard]] Eigen::VectorXd part(Eigen::Index which) const { return values_.segment(which * n_, n_); }
  [[nodiscard]] Eigen::MatrixXd square(Eigen::Index which) const {
    return values_.segment(4 * n_ + m_ + which * n_ * n_, n_ * n_).reshaped(n_, n_);
  }

  Eigen::Index n_;
  Eigen::Index m_;
  PointFunction function_;
  Eigen::VectorXd values_;
};

/// ξ at the nodes, a row each.
Eigen::MatrixXd multipliers_at_nodes(const TracedProblem& problem, const Trajectory& trajectory,
                                     ControlLagrangianForm form) {
  if (form == ControlLagrangianForm::forced_euler_lagrange) return trajectory.psi_p;
  const Eigen::Index n = problem.configuration_size();
  PointFunction mass(n, problem.control_size(),
                     [&](const ControlledState& x) { return ExpressionVector(problem.at(x).mass.reshaped()); });
  Eigen::VectorXd entries(n * n);
  Eigen::MatrixXd xi(trajectory.psi_p.rows(), n);
  for (Eigen::Index k = 0; k < xi.rows(); ++k) {
    const MotionPoint node{trajectory.q.row(k).transpose(), trajectory.v.row(k).transpose(), {}};
    mass.evaluate(node, trajectory.node_times[k], entries);
    xi.row(k) = (entries.reshaped(n, n) * trajectory.psi_p.row(k).transpose()).transpose();
  }
  return xi;
}

double relative(double residual, double scale) { return scale > 0.0 ? residual / scale : residual; }

}  // namespace

double ControlLagrangianResidual::largest() const { return std::max({adjoint, motion, control}); }

ControlLagrangianResidual control_lagrangian_residual(const Problem& problem, const Trajectory& trajectory,
                                                      ControlLagrangianForm form) {
  if (!trajectory.has_costates()) throw Error("the control Lagrangian needs costates: use a solver with multipliers");
  if (trajectory.stages() != 1 || trajectory.intervals() < 2) {
    throw Error("the control Lagrangian is defined only for one stage and at least two intervals");
  }
  const TracedProblem traced(problem);
  ControlLagrangian lagrangian(traced, form);
  const Eigen::MatrixXd xi = multipliers_at_nodes(traced, trajectory, form);
  const auto mean = [](const Eigen::MatrixXd& rows, Eigen::Index k) {
    return Eigen::VectorXd(0.5 * (rows.row(k) + rows.row(k + 1)).transpose());
  };
  ControlLagrangianResidual largest;
  double size_of_v = 0.0;
  double size_of_rate = 0.0;
  double size_of_cost = 0.0;
  ControlLagrangian::Derivatives before;
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    const double h = trajectory.step(k);
    const auto rate = [&](const Eigen::MatrixXd& rows) {
      return Eigen::VectorXd((rows.row(k + 1) - rows.row(k)).transpose() / h);
    };
    const MotionPoint middle{mean(trajectory.q, k), rate(trajectory.q), trajectory.stage_u.row(k).transpose()};
    ControlLagrangian::Derivatives here = lagrangian.at(middle, trajectory.stage_times[k], mean(xi, k), rate(xi));
    size_of_v = std::max(size_of_v, here.v.norm());
    size_of_rate = std::max(size_of_rate, here.xi_rate.norm());
    size_of_cost = std::max(size_of_cost, here.cost_by_control.norm());
    largest.control = std::max(largest.control, here.u.norm());
    if (k > 0) {
      const double left = 0.5 * trajectory.step(k - 1);
      const double right = 0.5 * h;
      const auto defect = [&](const Eigen::VectorXd& force_before, const Eigen::VectorXd& force,
                              const Eigen::VectorXd& momentum_before, const Eigen::VectorXd& momentum) {
        return (left * force_before + right * force + momentum_before - momentum).norm() / (left + right);
      };
      largest.adjoint = std::max(largest.adjoint, defect(before.q, here.q, before.v, here.v));
      largest.motion = std::max(largest.motion, defect(before.xi, here.xi, before.xi_rate, here.xi_rate));
    }
    before = std::move(here);
  }
  const double horizon = trajectory.node_times[trajectory.intervals()] - trajectory.node_times[0];
  return {.adjoint = relative(horizon * largest.adjoint, size_of_v),
          .motion = relative(horizon * largest.motion, size_of_rate),
          .control = relative(largest.control, size_of_cost)};
}

double GalerkinForm::difference() const { return std::abs(program - action) / size; }

bool has_galerkin_form(const Transcription& program) {
  const ProgramBlocks& blocks = program.blocks();
  const auto has_velocity = [&](std::size_t node) { return blocks.unknown_at(Quantity::velocity, node).width > 0; };
  return program.node_state() == NodeState::configuration && !has_velocity(0) && !has_velocity(blocks.intervals()) &&
         std::ranges::all_of(blocks.rows(), [](const RowBlock& block) {
           return block.width == 0 || block.kind == Equation::euler_lagrange;
         });
}

GalerkinForm galerkin_form(Transcription& program, const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers,
                           MultiplierPath path) {
  const ProgramBlocks& blocks = program.blocks();
  const Tableau& rates = program.functions().rates;
  const Tableau& quadrature = program.tableau();
  if (!has_galerkin_form(program)) {
    throw Error(
        "the Galerkin form needs dmoc or galerkin, fixed ends, and Euler-Lagrange equations as the only constraints");
  }
  const TracedProblem& traced = program.traced_problem();
  const Eigen::Index n = traced.configuration_size();
  PointFunction formulas(n, traced.control_size(), [&](const ControlledState& point) {
    const TracedProblem::Values values = traced.at(point);
    ExpressionVector outputs(2 * n + 1);
    outputs << values.generalised_force, values.momentum, values.running_cost;
    return outputs;
  });
  const Trajectory trajectory = read_trajectory(program, x, {});
  const Eigen::MatrixXd at_nodes =
      blocks.row(Equation::euler_lagrange).columns(multipliers, trajectory.intervals() + 1);
  const Eigen::MatrixXd integrals = integrals_to(quadrature.c, rates);
  Eigen::VectorXd residual(static_cast<Eigen::Index>(program.constraint_count()));
  program.constraints(x, residual);
  GalerkinForm form{.program = program.objective(x) + multipliers.dot(residual)};
  Eigen::VectorXd values(2 * n + 1);
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    const double h = trajectory.step(k);
    const Eigen::VectorXd straight = (at_nodes.row(k + 1) - at_nodes.row(k)).transpose() / h;
    Eigen::MatrixXd rates_of_xi = straight.replicate(1, rates.stages());
    if (path == MultiplierPath::polynomial) {
      Eigen::VectorXd last = straight;
      for (Eigen::Index j = 0; j + 1 < rates.stages(); ++j) {
        const Eigen::MatrixXd own =
            blocks.row(Equation::euler_lagrange, j).columns(multipliers, trajectory.intervals());
        rates_of_xi.col(j) = own.row(k).transpose() / (h * rates.b[j]);
        last -= rates.b[j] * rates_of_xi.col(j);
      }
      rates_of_xi.rightCols(1) = last / rates.b[rates.stages() - 1];
    }
    for (Eigen::Index i = 0; i < quadrature.stages(); ++i) {
      const Eigen::Index row = k * quadrature.stages() + i;
      formulas.evaluate(trajectory.stage(row), trajectory.stage_times[row], values);
      const Eigen::VectorXd xi = at_nodes.row(k).transpose() + h * rates_of_xi * integrals.row(i).transpose();
      const Eigen::VectorXd xi_rate = rates_of_xi * lagrange_basis(rates.c, quadrature.c[i]);
      const double weight = h * quadrature.b[i];
      for (const double term :
           {program.cost_scale() * values[2 * n], xi.dot(values.head(n)), xi_rate.dot(values.segment(n, n))}) {
        form.action += weight * term;
        form.size += std::abs(weight * term);
      }
    }
  }
  return form;
}

}  // namespace dmocbench
