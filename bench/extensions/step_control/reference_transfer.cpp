#include "bench/extensions/step_control/reference_transfer.hpp"

#include <algorithm>
#include <cmath>

#include "bench/run/solve_case.hpp"
#include "methods/diagnostics/trajectory_error.hpp"
#include "methods/error.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

namespace {

std::shared_ptr<const Problem> transfer_with(const std::string& name, int revolutions) {
  std::shared_ptr<Problem> problem = make_problem(name);
  problem->set_parameter("revolutions", revolutions);
  return problem;
}

/// The answer of a method with given numbers of Gauss stages and of intervals per revolution.
Trajectory solved_transfer(const std::shared_ptr<const Problem>& problem, const char* method, int stages,
                           long long intervals, const Motion& start, const Solver& solver) {
  const Case the_case{.problem = problem,
                      .method = method,
                      .stages = stages,
                      .solver = "interior_point",
                      .grid = Grid::uniform(intervals)};
  SolvedCase solved = solve_case(the_case, Start{start}, solver, solver.options().tolerance, 1, true);
  if (!solved.trajectory || !is_usable(solved)) {
    throw Error("{} is not solved and cannot be a reference: {}", the_case.label(), solved.solution.message);
  }
  return *std::move(solved.trajectory);
}

}  // namespace

ReferenceTransfer::ReferenceTransfer(const std::string& problem, int revolutions, const SolverOptions& options)
    : problem_(transfer_with(problem, revolutions)) {
  const std::unique_ptr<Solver> solver = make_solver("interior_point", options);
  const Trajectory anchor =
      solved_transfer(problem_, "dmoc", 3, 16LL * revolutions, guessed_motion(*problem_), *solver);
  motion_ = smooth_motion(anchor);
  certify(anchor, revolutions);
  if (!indirect_) let_two_methods_agree(revolutions, *solver);
}

void ReferenceTransfer::certify(const Trajectory& anchor, int revolutions) {
  const Eigen::Index fewest = std::max(16, 2 * revolutions);
  try {
    IndirectSolution solution = solve_indirect(
        *problem_, anchor, {.tolerance = 1e-11, .fewest_intervals = fewest, .most_intervals = 4 * fewest});
    digits_ = solution.certified_digits();
    if (digits_ >= wanted_digits) indirect_ = std::move(solution);
  } catch (const Stopped&) {
    throw;
  } catch (const Error&) {
    digits_ = 0.0;  // its equations have no solution from here: two methods have to agree
  }
}

void ReferenceTransfer::let_two_methods_agree(int revolutions, const Solver& solver) {
  fine_ = solved_transfer(problem_, "dmoc", 4, 32LL * revolutions, motion_, solver);
  const Trajectory other = solved_transfer(problem_, "tangent", 3, 48LL * revolutions, motion_, solver);
  const TrajectoryError difference = trajectory_error(fine_, other);
  const double worst = std::max(difference.objective / fine_.cost, difference.state / fine_.q.cwiseAbs().maxCoeff());
  digits_ = std::min(16.0, -std::log10(worst));
}

Trajectory ReferenceTransfer::like(const Trajectory& trajectory) const {
  return indirect_ ? indirect_->sampled_like(trajectory) : fine_;
}

}  // namespace dmocbench
