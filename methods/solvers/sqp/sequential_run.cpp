#include "methods/solvers/sqp/sequential_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "methods/solvers/confirm.hpp"
#include "methods/solvers/least_violation.hpp"

namespace dmocbench::sqp {

namespace {

/// Of the tolerance of the whole: with equal tolerances the last major iterations stall.
constexpr double tolerance_of_quadratic_programs = 0.1;

}  // namespace

QuadraticProgram quadratic_program_at(const NonlinearProgram& program, const Linearisation& at,
                                      const Hessian& hessian) {
  QuadraticProgram result{.hessian = &hessian, .gradient = at.gradient, .rows = at.jacobian, .lower = {}, .upper = {}};
  result.lower.resize(result.column_count());
  result.upper.resize(result.column_count());
  result.lower << program.variable_lower() - at.point, program.constraint_lower() - at.constraints;
  result.upper << program.variable_upper() - at.point, program.constraint_upper() - at.constraints;
  return result;
}

SequentialRun::SequentialRun(CountedProgram& program, const Eigen::VectorXd& start, const SolverOptions& options,
                             const SequentialOptions& choices)
    : program_(program),
      options_(options),
      choices_(choices),
      tolerance_(std::max(options.tolerance, program.rounding_floor())),
      quadratic_solver_({.feasibility_tolerance = tolerance_of_quadratic_programs * tolerance_,
                         .optimality_tolerance = tolerance_of_quadratic_programs * tolerance_,
                         .crash = choices.crash},
                        Pricing(choices.pricing, choices.seed),
                        [this](const MinorIteration& minor) { return observe(minor); }),
      globalisation_(program),
      multipliers_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.constraint_count()))) {
  at_.point = start.cwiseMax(program.variable_lower()).cwiseMin(program.variable_upper());
}

Solution SequentialRun::run() {
  Solution solution;
  at_ = values_at(program_, at_.point);
  differentiate(program_, at_);
  solution.status = Status::evaluation_failed;
  if (at_.has_finite_values() && at_.gradient.allFinite()) {
    std::optional<Status> end;
    while (!end) end = major_iteration();
    const bool gave_up = end == Status::step_failed || end == Status::iteration_limit;
    const bool is_outside = violations(program_, at_.constraints).lpNorm<Eigen::Infinity>() > tolerance_;
    const bool is_stuck = gave_up && is_outside && is_point_of_least_violation(program_.uncounted(), at_.point);
    solution.status = is_stuck ? Status::infeasible : end.value_or(Status::solver_error);
  }
  solution.message = message_;
  solution.primal = at_.point;
  solution.multipliers = multipliers_;
  solution.major_iterations = majors_;
  solution.minor_iterations = phase_one_minors_ + phase_two_minors_;
  solution.phase_one_minor_iterations = phase_one_minors_;
  solution.phase_two_minor_iterations = phase_two_minors_;
  return solution;
}

std::optional<Status> SequentialRun::reason_to_stop() const {
  if (options_.stop_requested && options_.stop_requested()) return Status::interrupted;
  if (options_.most_seconds > 0.0 && program_.elapsed_seconds() > options_.most_seconds) return Status::time_limit;
  return std::nullopt;
}

bool SequentialRun::observe(MinorIteration minor) {
  minor.major = majors_;
  (minor.phase == MinorIteration::Phase::feasibility ? phase_one_minors_ : phase_two_minors_) += 1;
  if (options_.on_minor_iteration) options_.on_minor_iteration(minor);
  return !reason_to_stop();
}

bool SequentialRun::has_converged() {
  Solution now;
  now.primal = at_.point;
  now.multipliers = multipliers_;
  judge_residuals(program_.uncounted(), now);
  return scaled_residual(program_, options_.tolerance, now) <= 1.0;
}

void SequentialRun::choose_hessian() {
  if (choices_.limited_memory) {
    if (limited_memory_ != nullptr) return;
    auto hessian = std::make_unique<LimitedMemoryHessian>(at_.point.size());
    limited_memory_ = hessian.get();
    hessian_ = std::move(hessian);
    return;
  }
  Eigen::SparseMatrix<double> exact = hessian_at(program_, at_.point, multipliers_);
  const double needed =
      convexification_.shift_for(exact, at_.jacobian, free_variables(program_), equality_rows(program_));
  shift_ = std::max(needed, cautious_shift_);
  hessian_ = std::make_unique<ShiftedHessian>(std::move(exact), shift_);
}

std::optional<Status> SequentialRun::major_iteration() {
  if (has_converged()) return Status::solved;
  if (const auto reason = reason_to_stop()) return reason;
  if (majors_ == options_.most_iterations) return Status::iteration_limit;
  choose_hessian();
  ++majors_;
  const QuadraticSolution quadratic = quadratic_solver_.solve(quadratic_program_at(program_, at_, *hessian_));
  switch (quadratic.status) {
    case QuadraticSolution::Status::stopped:
      return reason_to_stop().value_or(Status::interrupted);
    case QuadraticSolution::Status::breakdown:
      message_ = "A quadratic program could not be solved: " + quadratic.message + ".";
      return Status::step_failed;
    case QuadraticSolution::Status::infeasible:
      if (quadratic.step.lpNorm<Eigen::Infinity>() < tolerance_) return Status::infeasible;
      break;
    case QuadraticSolution::Status::optimal:
      break;
  }
  const Eigen::VectorXd curved = hessian_->times(quadratic.step);
  const LineSearchResult search = globalisation_.search(at_, quadratic.step, quadratic.step.dot(curved),
                                                        Globalisation::longest_length(at_.point, quadratic.step));
  if (search.step_length == 0.0) {
    return quadratic.status == QuadraticSolution::Status::infeasible ? Status::infeasible : Status::step_failed;
  }
  if (options_.verbose) print(quadratic.step.lpNorm<Eigen::Infinity>(), search.step_length, search.accepted.objective);
  take(search, quadratic);
  return std::nullopt;
}

void SequentialRun::print(double longest, double step_length, double objective) const {
  fmt::print(
      "major {}, minors {} + {}, merit weight {:.2e}, shift {:.2e}, step {:.2e} taken by {:.2e}, objective {:.10e}\n",
      majors_, phase_one_minors_, phase_two_minors_, globalisation_.weight(), shift_, longest, step_length, objective);
}

void SequentialRun::take(const LineSearchResult& search, const QuadraticSolution& quadratic) {
  Eigen::VectorXd wanted = quadratic.multipliers;
  if (quadratic.status == QuadraticSolution::Status::infeasible) {
    wanted = wanted.cwiseMax(-globalisation_.weight()).cwiseMin(globalisation_.weight());
  }
  multipliers_ += search.step_length * (wanted - multipliers_);
  const Linearisation before = std::exchange(at_, search.accepted);
  differentiate(program_, at_);
  if (limited_memory_ != nullptr) {
    limited_memory_->update(at_.point - before.point,
                            (at_.gradient + at_.jacobian.transpose() * multipliers_) -
                                (before.gradient + before.jacobian.transpose() * multipliers_));
  }
  adapt_shift(search.step_length);
}

void SequentialRun::adapt_shift(double step_length) {
  constexpr double short_step = 0.2;
  constexpr double growth = 4.0;
  constexpr double decay = 3.0;
  constexpr double smallest = 1e-6;
  if (step_length < short_step) {
    cautious_shift_ = growth * std::max({shift_, cautious_shift_, smallest});
  } else if (step_length == 1.0) {
    cautious_shift_ /= decay;
    if (cautious_shift_ < smallest) cautious_shift_ = 0.0;
  }
}

}  // namespace dmocbench::sqp
