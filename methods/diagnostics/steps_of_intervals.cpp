#include "methods/diagnostics/steps_of_intervals.hpp"

#include <limits>
#include <vector>

#include "methods/expression/vectors.hpp"
#include "methods/numerics/adaptive_integration.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/motions/points_along.hpp"

namespace dmocbench {

namespace {

Schedule equations_times_step(const TracedProblem& traced) {
  InputCounter inputs;
  const Eigen::Index n = traced.configuration_size();
  ControlledState x{inputs.take(n), inputs.take(n), inputs.take(traced.control_size()), {}};
  x.y = inputs.take(traced.first_order_size());
  x.t = inputs.take();
  const Expression h = inputs.take();
  const TracedProblem::Values values = traced.at(x);
  ExpressionVector force = values.generalised_force - values.momentum_by_time;
  force -= values.momentum_by_configuration * x.v;
  if (x.y.size() > 0) force -= values.momentum_by_first_order * values.first_order_rates;
  return Schedule(h *
                  stacked({x.v, solve_symmetric(values.mass, force, "L_vv has no pivot"), values.first_order_rates}));
}

}  // namespace

StepsOfIntervals::StepsOfIntervals(const TracedProblem& traced) : tape_(equations_times_step(traced)) {}

Eigen::MatrixXd StepsOfIntervals::ends(const Trajectory& trajectory, Eigen::Index first, Eigen::Index count,
                                       double tolerance) const {
  const Eigen::Index n = trajectory.q.cols();
  const Eigen::Index l = trajectory.y.cols();
  const Eigen::VectorXd begin = trajectory.node_times.segment(first, count);
  const Eigen::VectorXd steps = trajectory.node_times.segment(first + 1, count) - begin;
  Tape::Workspace workspace(tape_);
  const auto rate = [&](const std::vector<double>& x, std::vector<double>& rates, double tau) {
    const Eigen::MatrixXd u =
        weighted_stages(trajectory.stage_u, lagrange_basis(trajectory.tableau.c, tau), first, count);
    const Eigen::VectorXd times = begin + tau * steps;
    std::vector<Tape::Input> inputs;
    std::vector<double*> outputs;
    for (Eigen::Index i = 0; i < 2 * n; ++i) inputs.push_back({x.data() + i * count, false});
    for (const auto& column : u.colwise()) inputs.push_back({column.data(), false});
    for (Eigen::Index i = 2 * n; i < 2 * n + l; ++i) inputs.push_back({x.data() + i * count, false});
    inputs.push_back({times.data(), false});
    inputs.push_back({steps.data(), false});
    for (Eigen::Index i = 0; i < 2 * n + l; ++i) outputs.push_back(rates.data() + i * count);
    tape_.evaluate(static_cast<std::size_t>(count), inputs, outputs, workspace);
  };
  std::vector<double> x(static_cast<std::size_t>((2 * n + l) * count));
  Eigen::Map<Eigen::MatrixXd> states(x.data(), count, 2 * n + l);
  states << trajectory.q.middleRows(first, count), trajectory.v.middleRows(first, count),
      trajectory.y.middleRows(l > 0 ? first : 0, l > 0 ? count : 0);
  const std::vector<double> errors = step_once(rate, x, tolerance);
  const Eigen::Map<const Eigen::MatrixXd> shares(errors.data(), count, 2 * n + l);
  Eigen::MatrixXd ends = states.transpose();
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!(shares.row(k).array() <= 1.0).all()) ends.col(k).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return ends;
}

}  // namespace dmocbench
