#include "methods/diagnostics/leading_errors.hpp"

#include "methods/diagnostics/one_step_map.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/mechanics/legendre_transform.hpp"

namespace dmocbench {

namespace {

/// The cost of an interval, as a formula of the inputs of a step (`OneStepMap::Step`).
Schedule cost_of_step(const TracedProblem& problem, const Element& element, const Tableau& tableau) {
  InputCounter counter;
  IntervalUnknowns unknowns = take_unknowns(counter, problem, element, tableau);
  unknowns.h = counter.take();
  unknowns.t = counter.take();
  return Schedule(ExpressionVector::Constant(1, element.trace(problem, tableau, unknowns).cost));
}

}  // namespace

LeadingErrors leading_errors(const Problem& problem, const Element& element, const Trajectory& optimum) {
  using Map = OneStepMap<long double>;  // DMOC's momenta are differences of positions, divided by the step
  const TracedProblem traced(problem);
  const Map map(traced, element, optimum.tableau);
  const Schedule cost = cost_of_step(traced, element, optimum.tableau);
  const Eigen::Index s = optimum.stages();
  const auto at_node = [](const Eigen::MatrixXd& table, Eigen::Index k) -> Map::Vector {
    return table.row(k).transpose().cast<long double>();
  };
  Map::Vector q = at_node(optimum.q, 0);
  Map::Vector p = at_node(optimum.p, 0);
  long double error_of_cost = -optimum.cost;
  for (Eigen::Index k = 0; k < optimum.intervals(); ++k) {
    const double t = optimum.node_times[k];
    const double h = optimum.node_times[k + 1] - t;
    const Map::Matrix controls = optimum.stage_u.middleRows(k * s, s).cast<long double>();
    const Map::Vector velocity = at_node(optimum.stage_v, k * s);
    const Map::Step flowed = map.advance(q, p, velocity, controls, h, t);
    q = flowed.q;
    p = flowed.p;
    const Map::Step step = map.advance(at_node(optimum.q, k), at_node(optimum.p, k), velocity, controls, h, t);
    error_of_cost += OutputBlocks<long double>(cost, step.inputs).take(1)(0) +
                     at_node(optimum.psi_q, k + 1).dot(step.q - at_node(optimum.q, k + 1)) +
                     at_node(optimum.psi_p, k + 1).dot(step.p - at_node(optimum.p, k + 1));
  }
  const double horizon = optimum.node_times[optimum.intervals()];
  const BoundaryState last = problem.final_state();
  const Eigen::VectorXd last_q = q.cast<double>();
  const Eigen::VectorXd last_v = LegendreTransform(traced).velocity(last_q, p.cast<double>(), horizon, last.v);
  const ReplayError exact = replay_error(problem, optimum);
  LeadingErrors errors{Eigen::VectorXd(2 * last_q.size()), static_cast<double>(error_of_cost)};
  errors.replay << last.q + exact.q - last_q, last.v + exact.v - last_v;
  return errors;
}

}  // namespace dmocbench
