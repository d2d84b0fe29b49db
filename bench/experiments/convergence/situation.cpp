#include "bench/experiments/convergence/situation.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "bench/run/restated_problem.hpp"
#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/point_of_inputs.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

namespace {

std::shared_ptr<Problem> with_parameter(const char* name, const char* parameter, double value) {
  std::shared_ptr<Problem> problem = make_problem(name);
  problem->set_parameter(parameter, value);
  return problem;
}

/// True if a column of `values` comes as near to one of its bounds as a solve can resolve.
bool meets(const Bounds& bounds, const Eigen::MatrixXd& values) {
  constexpr double near = 1e-6;
  if (bounds.empty()) return false;
  for (Eigen::Index i = 0; i < values.cols(); ++i) {
    if (bounds.lower[i] == bounds.upper[i]) continue;  // equations do not count
    const double least = values.col(i).minCoeff();
    const double largest = values.col(i).maxCoeff();
    const double margin = near * std::max(largest - least, std::numeric_limits<double>::min());
    if (least - bounds.lower[i] <= margin || bounds.upper[i] - largest <= margin) return true;
  }
  return false;
}

/// h at all stages, N s rows.
Eigen::MatrixXd path_constraints_along(const Problem& problem, const Trajectory& motion) {
  PointFunction constraints(
      problem.configuration_size(), problem.control_size(),
      [&](const ControlledState& x) { return problem.path_constraints(x); }, problem.first_order_size());
  Eigen::MatrixXd values(motion.stage_q.rows(), constraints.output_count());
  Eigen::VectorXd at_stage(constraints.output_count());
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    constraints.evaluate(motion.stage(row), motion.stage_times[row], at_stage);
    values.row(row) = at_stage.transpose();
  }
  return values;
}

/// Whether each path constraint reads a control, and whether it reads the state.
struct ReadBy {
  std::vector<bool> control;
  std::vector<bool> state;
};

ReadBy what_path_constraints_read(const Problem& problem) {
  const ControlledState x = point_of_inputs(problem);
  const ExpressionVector constraints = problem.path_constraints(x);
  const auto depends = [](const Expression& constraint, const ExpressionVector& inputs) {
    return std::ranges::any_of(gradient(constraint, inputs), [](const Expression& entry) { return !entry.is_zero(); });
  };
  ReadBy read;
  for (const Expression& constraint : constraints) {
    read.control.push_back(depends(constraint, x.u));
    read.state.push_back(depends(constraint, x.q) || depends(constraint, x.v) || depends(constraint, x.y));
  }
  return read;
}

}  // namespace

/// Bounds of the force are about two thirds of the largest one without them. The kinks of the closed forms are at 1/6
/// and 5/6 (force), 1/3 and 2/3 (beam) of the horizon.
std::vector<Situation> example_situations() {
  const std::shared_ptr<const Problem> integrator = make_problem("double_integrator");
  const std::shared_ptr<const Problem> beam = with_parameter("beam", "bound", 1.0 / 9.0);
  const std::shared_ptr<const Problem> links = make_problem("two_link_manipulator");
  const std::shared_ptr<const Problem> quadrotor = make_problem("planar_quadrotor");
  const std::shared_ptr<const Problem> bounded = with_parameter("double_integrator", "largest_force", 108.0 / 23.0);
  const std::shared_ptr<const Problem> touching = with_parameter("beam", "bound", 0.2);
  const auto restated = [](const auto& base, RestatedProblem::Changes changes) {
    return std::make_shared<RestatedProblem>(base, std::move(changes));
  };
  return {
      {"double_integrator", "nothing", "fixed", integrator, integrator, true},
      {"double_integrator_bounded", "control", "fixed", bounded, bounded, true},
      {"beam_touching", "state", "fixed", touching, touching, true},
      {"beam", "state", "fixed", beam, beam, true},
      {"two_link", "nothing", "fixed", links, links, false},
      {"two_link_free_end", "nothing", "free", links, restated(links, {.final_weight = 100.0}), false},
      {"two_link_bounded", "control", "fixed", links, restated(links, {.control = Bounds::all(2, -13.0, 13.0)}), false},
      {"two_link_bounded_free_end", "control", "free", links,
       restated(links, {.control = Bounds::all(2, -13.0, 13.0), .final_weight = 100.0}), false},
      {"quadrotor_bounded", "control", "fixed", quadrotor, restated(quadrotor, {.control = Bounds::all(2, 1.6, 3.2)}),
       false},
  };
}

Situation situation_of(const std::shared_ptr<const Problem>& problem) {
  const ProblemBounds bounds = problem->bounds();
  if (bounds.horizon.is_free()) {
    throw Error("smoothness compares trajectories at equal times, but " + problem->name() +
                " has a free horizon; use `convergence`");
  }
  return {.name = problem->name(),
          .active = {},
          .end = bounds.last.all_fixed() ? "fixed" : "free",
          .base = problem,
          .problem = problem,
          .has_closed_form = problem->optimum(0.0) && problem->card().reference};
}

std::string active_bounds(const Problem& problem, const Trajectory& motion) {
  const ProblemBounds bounds = problem.bounds();
  const Eigen::MatrixXd inner_q = motion.q.middleRows(1, motion.intervals() - 1);
  bool control = meets(bounds.u, motion.stage_u);
  bool state = meets(bounds.q, inner_q) || meets(bounds.v, motion.stage_v);
  const Eigen::MatrixXd values = path_constraints_along(problem, motion);
  const ReadBy read = what_path_constraints_read(problem);
  const Bounds path = bounds.of_path(values.cols());
  for (Eigen::Index i = 0; i < values.cols(); ++i) {
    const Bounds own{path.lower.segment(i, 1), path.upper.segment(i, 1)};
    if (!meets(own, values.col(i))) continue;
    control = control || read.control[static_cast<std::size_t>(i)];
    state = state || read.state[static_cast<std::size_t>(i)];
  }
  if (control && state) return "control and state";
  if (control) return "control";
  return state ? "state" : "nothing";
}

}  // namespace dmocbench
