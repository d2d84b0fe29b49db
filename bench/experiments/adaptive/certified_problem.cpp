#include "bench/experiments/adaptive/certified_problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bench/run/solve_case.hpp"
#include "methods/adaptive/error_estimate.hpp"
#include "methods/error.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/transcription/start.hpp"

namespace dmocbench {

namespace {

/// DMOC with three stages from the guess: any extremal serves.
Trajectory direct_motion(const std::shared_ptr<const Problem>& problem, const SolverOptions& options) {
  const Case the_case{.problem = problem, .method = "dmoc", .stages = 3, .solver = "auto", .grid = Grid::uniform(96)};
  const SolvedCase solved =
      solve_case(the_case, Start{guessed_motion(*problem)}, *make_solver("auto", options), options.tolerance, 1);
  if (solved.trajectory && is_usable(solved)) return *solved.trajectory;
  throw Error("{} has no usable solution ({}): {}", the_case.label(), name_of(solved.solution.status),
              solved.solution.message);
}

/// Bounds that a parameter can switch off are switched off: the indirect method does not support bounds.
std::shared_ptr<const Problem> without_bounds(std::shared_ptr<const Problem> problem) {
  const auto is_switch = [](const Parameter& parameter) { return parameter.name == "bounded"; };
  const std::vector<Parameter>& parameters = problem->parameters();
  if (std::ranges::none_of(parameters, is_switch)) return problem;
  std::shared_ptr<Problem> free = problem->clone();
  free->set_parameter("bounded", 0.0);
  return free;
}

double largest_row_of(const Eigen::MatrixXd& rows) { return rows.rowwise().norm().maxCoeff(); }

}  // namespace

CertifiedProblem::CertifiedProblem(std::shared_ptr<const Problem> problem, const SolverOptions& options)
    : problem_(without_bounds(std::move(problem))),
      optimum_(solve_indirect(*problem_, direct_motion(problem_, options))),
      motion_(optimum_.trajectory()) {}

std::unique_ptr<Transcription> CertifiedProblem::transcribe(const Scheme& scheme, long long intervals) const {
  return Case{.problem = problem_,
              .method = scheme.method,
              .tableau = scheme.tableau,
              .stages = static_cast<int>(scheme.stages),
              .grid = Grid::uniform(intervals)}
      .transcribe();
}

TrueError true_error(const CertifiedProblem& certified, const Trajectory& answer) {
  // At the nodes alone: every point takes Newton's method.
  Eigen::MatrixXd q = -answer.q;
  Eigen::MatrixXd p = -answer.p;
  Eigen::MatrixXd psi_q = -answer.psi_q;
  Eigen::MatrixXd psi_p = -answer.psi_p;
  for (Eigen::Index k = 0; k < answer.node_times.size(); ++k) {
    const IndirectPoint optimum = certified.optimum().at(answer.node_times[k]);
    q.row(k) += optimum.q.transpose();
    p.row(k) += optimum.p.transpose();
    psi_q.row(k) += optimum.psi_q.transpose();
    psi_p.row(k) += optimum.psi_p.transpose();
  }
  const double objective = certified.optimum().cost() - answer.cost;
  return {.state = largest_row_of(q),
          .momentum = largest_row_of(p),
          .costate = std::sqrt((psi_q.rowwise().squaredNorm() + psi_p.rowwise().squaredNorm()).maxCoeff()),
          .objective = std::abs(objective),
          .relative = relative_size(answer, q, p, objective, certified.problem().cost_scale())};
}

}  // namespace dmocbench
