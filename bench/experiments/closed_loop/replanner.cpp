#include "bench/experiments/closed_loop/replanner.hpp"

#include <utility>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

/// What is left of a plan after some of its time.
Motion rest_of(const Trajectory& plan, double elapsed) {
  const Motion motion = smooth_motion(plan);
  return {[motion, elapsed](double t) { return motion.at(t + elapsed); }, motion.horizon - elapsed};
}

/// The nearest values that the bounds of the motion allow; without bounds the values.
Eigen::VectorXd within(const Bounds& bounds, const Eigen::VectorXd& values) {
  return bounds.empty() ? values : Eigen::VectorXd(values.cwiseMax(bounds.lower).cwiseMin(bounds.upper));
}

}  // namespace

Replanner::Replanner(const Case& the_case, const Motion& start, const SolverOptions& options)
    : problem_(*the_case.problem),
      bounds_(problem_.bounds()),
      program_(problem_, *make_element(the_case.method), make_tableau(the_case.tableau, the_case.stages),
               the_case.grid),
      prepared_(program_, "interior_point", options) {
  std::optional<Plan> first = solved(start, Plan());
  if (!first) {
    throw Error(
        fmt::format("{} is not solved, so no loop can begin: {}", the_case.label(), prepared_.solution().message));
  }
  first_ = std::move(*first);
  begin();
}

void Replanner::begin() {
  plan_ = first_;
  plans_ = 1;
  iterations_ = first_.iterations;
  failed_ = 0;
}

void Replanner::plan(const BoundaryState& measured, double t) {
  program_.set_horizon(problem_.horizon() - t);
  program_.set_initial_state({.q = within(bounds_.q, measured.q), .v = within(bounds_.v, measured.v)});
  std::optional<Plan> next =
      solved(moved_to_ends(rest_of(plan_.trajectory, t - plan_.made_at), program_.bounds()), plan_);
  iterations_ += prepared_.solution().major_iterations.value_or(0);
  ++plans_;
  if (!next) {
    ++failed_;
    return;
  }
  next->made_at = t;
  plan_ = std::move(*next);
}

std::size_t Replanner::free_variables() const { return free_variable_count(program_); }

std::optional<Replanner::Plan> Replanner::solved(const Motion& start, const Plan& before) {
  const Solution& solution = prepared_.solve(sample(program_, start), before.multipliers, before.barrier_parameter);
  if (!is_solved(solution.status)) return std::nullopt;
  return Plan{.trajectory = read_trajectory(program_, solution.primal, solution.multipliers),
              .multipliers = solution.multipliers,
              .barrier_parameter = solution.barrier_parameter,
              .iterations = solution.major_iterations.value_or(0)};
}

}  // namespace dmocbench
