#include "methods/diagnostics/momentum_consistency.hpp"

#include <algorithm>
#include <cmath>

#include "methods/error.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

MomentumConsistency momentum_consistency(const Problem& problem, const Trajectory& trajectory) {
  const TracedProblem traced(problem);
  if (!traced.has_symmetry()) {
    throw Error(problem.name() + " states no symmetry, so there is no momentum to watch");
  }
  const Eigen::Index n = traced.configuration_size();
  PointFunction generator(n, traced.control_size(), [&](const ControlledState& x) { return traced.at(x).symmetry; });
  PointFunction force_along(n, traced.control_size(), [&](const ControlledState& x) {
    const TracedProblem::Values values = traced.at(x);
    const ExpressionVector transport = values.symmetry_jacobian * x.v;
    return ExpressionVector::Constant(1,
                                      values.generalised_force.dot(values.symmetry) + values.momentum.dot(transport));
  });

  Eigen::VectorXd momentum(trajectory.q.rows());
  Eigen::VectorXd direction(n);
  for (Eigen::Index k = 0; k < momentum.size(); ++k) {
    generator.evaluate(trajectory.node(k), trajectory.node_times[k], direction);
    momentum[k] = trajectory.p.row(k).dot(direction);
  }
  MomentumConsistency result;
  result.defects.resize(trajectory.intervals());
  Eigen::VectorXd force(1);
  const Eigen::Index s = trajectory.stages();
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    const double h = trajectory.step(k);
    double work = 0.0;
    for (Eigen::Index i = 0; i < s; ++i) {
      const Eigen::Index stage = k * s + i;
      force_along.evaluate(trajectory.stage(stage), trajectory.stage_times[stage], force);
      work += h * trajectory.tableau.b[i] * force[0];
      result.largest_force = std::max(result.largest_force, std::abs(force[0]));
    }
    result.defects[k] = momentum[k + 1] - momentum[k] - work;
  }
  result.largest = result.defects.lpNorm<Eigen::Infinity>();
  result.mean = result.defects.lpNorm<1>() / static_cast<double>(result.defects.size());
  result.total = std::abs(result.defects.sum());
  return result;
}

}  // namespace dmocbench
