#include "methods/diagnostics/consistency_order.hpp"

#include <algorithm>
#include <utility>

#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/elements/dmoc_element.hpp"

namespace dmocbench {

namespace {

void raise(double& largest, long double error) { largest = std::max(largest, static_cast<double>(error)); }

LongMatrix stage_controls(const ExactDiscreteLagrangian& exact, const Tableau& tableau, long double h) {
  LongMatrix controls(tableau.stages(), exact.control(0.0L).size());
  for (Eigen::Index i = 0; i < tableau.stages(); ++i) controls.row(i) = exact.control(tableau.c[i] * h).transpose();
  return controls;
}

void compare(const DiscreteObjects& discrete, const DiscreteObjects& exact, ConsistencyErrors& errors) {
  raise(errors.lagrangian, std::abs(discrete.lagrangian - exact.lagrangian));
  raise(errors.left_force, (discrete.left_force - exact.left_force).norm());
  raise(errors.right_force, (discrete.right_force - exact.right_force).norm());
  raise(errors.left_legendre, (discrete.left_momentum - exact.left_momentum).norm());
  raise(errors.right_legendre, (discrete.right_momentum - exact.right_momentum).norm());
}

}  // namespace

ConsistencyOrder::ConsistencyOrder(const Problem& problem, const ControlFormula& control,
                                   std::vector<BoundaryState> starts)
    : problem_(problem), exact_(problem, control), starts_(std::move(starts)) {}

std::vector<ConsistencyErrors> ConsistencyOrder::errors(const std::vector<Tableau>& tableaus, double h) const {
  std::vector<ExactInterval> motions;
  motions.reserve(starts_.size());
  for (const BoundaryState& start : starts_) {
    motions.push_back(exact_.along(start.q.cast<long double>(), start.v.cast<long double>(), h));
  }
  const TracedProblem traced(problem_);
  std::vector<ConsistencyErrors> result;
  for (const Tableau& tableau : tableaus) {
    const DiscreteLagrangian discrete(problem_, tableau);
    const OneStepMap<long double> map(traced, DmocElement(), tableau);
    const LongMatrix controls = stage_controls(exact_, tableau, h);
    ConsistencyErrors errors;
    for (const ExactInterval& motion : motions) {
      compare(discrete.at(motion.q_0, motion.q_1, controls, h, 0.0L), motion.objects, errors);
      const auto step = map.advance(motion.q_0, motion.objects.left_momentum, motion.v_0, controls, h, 0.0L);
      raise(errors.map, std::hypot((step.q - motion.q_1).norm(), (step.p - motion.objects.right_momentum).norm()));
    }
    result.push_back(errors);
  }
  return result;
}

}  // namespace dmocbench
