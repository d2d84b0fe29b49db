#include "methods/judgement/confirm.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include <fmt/format.h>

#include "methods/judgement/stop_rule.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

Status confirmed_status(Status claim, double residual) {
  if (residual <= confirmation_factor) return Status::solved;
  const bool is_near = residual <= confirmation_factor * acceptable_factor;
  return claim == Status::acceptable && is_near ? Status::acceptable : Status::not_confirmed;
}

namespace {

/// The largest; NaN where one is.
double largest_of(std::initializer_list<double> shares) {
  double largest = 0.0;
  for (const double share : shares) {
    if (std::isnan(share)) return share;
    largest = std::max(largest, share);
  }
  return largest;
}

double largest_of_free(const NonlinearProgram& program, const Eigen::VectorXd& gradient) {
  double largest = 0.0;
  for (Eigen::Index j = 0; j < gradient.size(); ++j) {
    if (!is_fixed(program, j)) largest = std::max(largest, std::abs(gradient[j]));
  }
  return largest;
}

}  // namespace

void Confirmation::judge_residuals(Solution& solution) {
  solution.objective = program_.objective(solution.primal);
  const auto constraints = static_cast<Eigen::Index>(program_.constraint_count());
  const bool has_multipliers = solution.multipliers.size() == constraints;
  // A sparse least-squares problem may take minutes, which a solve whose time is over does not have.
  const bool is_over = solution.status == Status::time_limit || solution.status == Status::interrupted;
  if (!has_multipliers && is_over) {
    solution.multipliers.setConstant(constraints, std::numeric_limits<double>::quiet_NaN());
    solution.constraint_violation = constraint_violation(program_, solution.primal);
    return;
  }
  if (!has_multipliers) {
    solution.multipliers = least_squares_multipliers(program_, solution.primal);
    solution.multipliers_are_estimated = true;
  }
  const KktResidual residual = kkt_residual(program_, solution.primal, solution.multipliers, memory_);
  solution.kkt_residual = residual.stationarity;
  solution.constraint_violation = residual.constraint_violation;
}

double Confirmation::scaled_residual(double tolerance, const Solution& solution) {
  const StopRule allowed(program_, tolerance);
  const Eigen::VectorXd& multipliers = solution.multipliers;
  const bool has_multipliers = multipliers.size() > 0;
  const double mean = has_multipliers ? multipliers.lpNorm<1>() / static_cast<double>(multipliers.size()) : 0.0;
  const double largest = has_multipliers ? multipliers.lpNorm<Eigen::Infinity>() : 0.0;
  const double stationarity = allowed.stationarity(mean, largest);
  if (allowed.is_one_for_all() || !solution.kkt_residual || !solution.constraint_violation) {
    return largest_of({solution.kkt_residual.value_or(unbounded) / stationarity,
                       solution.constraint_violation.value_or(unbounded) / allowed.violation()});
  }
  kkt_entries(program_, solution.primal, multipliers, memory_, entries_);
  const double of_slacks = has_multipliers ? entries_.multipliers.lpNorm<Eigen::Infinity>() : 0.0;
  return largest_of({allowed.share_of_stationarity(entries_.gradient, mean, largest), of_slacks / stationarity,
                     allowed.share_of_violation(entries_.rows), entries_.bounds / allowed.violation()});
}

/// The lengths of the Newton step; none where it cannot be computed.
std::optional<Confirmation::StepLengths> Confirmation::newton_step(const Solution& solution) {
  if (!corrections_) corrections_.emplace(program_);
  const auto length = corrections_->length_at(solution.primal, solution.multipliers, memory_);
  if (!length) return std::nullopt;
  return StepLengths{.of_all = *length, .of_state = corrections_->length_of_state()};
}

void Confirmation::look_for_curvature(double tolerance, Solution& solution) {
  if (!corrections_ || corrections_->has_minimum() || !corrections_->conditions().is_finite()) return;
  curvature_ = dmocbench::negative_curvature(program_, corrections_->conditions());
  if (!curvature_) return;
  const double length = std::max(1.0, solution.primal.lpNorm<Eigen::Infinity>());
  const double decrease = -0.5 * curvature_->value * length * length;
  if (decrease <= confirmation_factor * tolerance * std::max(1.0, std::abs(solution.objective)))
    return curvature_.reset();
  solution.curvature = curvature_->share;
}

/// The largest |∂a_i/∂ξ_j λ_i| of the free variables.
double Confirmation::largest_term(const Eigen::VectorXd& multipliers) const {
  double largest = 0.0;
  program_.jacobian_structure().for_each([&](Eigen::Index e, int row, int column) {
    if (!is_fixed(program_, column)) largest = std::max(largest, std::abs(memory_.jacobian[e] * multipliers[row]));
  });
  return largest;
}

bool Confirmation::refuse_hidden_violation(Solution& solution) {
  const auto hidden = sizes_.hidden_violation(program_, solution.primal, memory_);
  if (!hidden) return false;
  solution.status = Status::not_confirmed;
  solution.message = fmt::format(
      "The violation of {0} {2} is below the tolerance, but it is {3:.1g} times the size of this {1} ({4:.1g}). State "
      "this {1} in units in which its size is about 1.",
      hidden->is_of_bound ? "a bound of unknown" : "constraint", hidden->is_of_bound ? "unknown" : "constraint",
      hidden->number, hidden->share, hidden->size);
  return true;
}

void Confirmation::judge_sizes(Solution& solution) {
  judge_residuals(solution);
  if (is_solved(solution.status)) refuse_hidden_violation(solution);
}

/// Takes "solved" back from an answer whose residuals the tolerance, or the round-off of a constraint, hides.
void Confirmation::require_visible(double tolerance, Solution& solution) {
  const bool is_hidden = refuse_hidden_violation(solution);
  needs_factors_of_rows_ = is_hidden || sizes_.has_small_inequality(program_);
  if (is_hidden) return;
  const Eigen::VectorXd& multipliers = solution.multipliers;
  const double mean = multipliers.lpNorm<1>() / std::max(1.0, static_cast<double>(multipliers.size()));
  const double residual = solution.kkt_residual.value_or(0.0);
  const double gradient = largest_of_free(program_, memory_.gradient_of_cost);
  const double term = largest_term(multipliers);
  has_huge_multipliers_ = term > largest_terms * std::max(gradient, tolerance);
  if (std::numeric_limits<double>::epsilon() * term > ConstraintSizes::largest_share * std::max(gradient, tolerance)) {
    solution.status = Status::not_confirmed;
    solution.message = fmt::format(
        "The multipliers are so large ({:.1g}) that round-off hides the stationarity residual: constraints depend on "
        "each other. State each condition once.",
        multipliers.lpNorm<Eigen::Infinity>());
    return;
  }
  if (residual <= confirmation_factor * tolerance * StopRule::scale(mean)) return;
  if (!(residual > ConstraintSizes::largest_share * gradient)) return;
  needs_factors_of_rows_ = true;
  solution.status = Status::not_confirmed;
  solution.message = fmt::format(
      "The stationarity residual {:.1g} is within the round-off of large constraints, but it is {:.1g} times the "
      "gradient of the cost. State the constraints in units in which their sizes are about 1.",
      residual, gradient > 0.0 ? residual / gradient : unbounded);
}

/// Takes "solved" back from an answer that a Newton step would move.
void Confirmation::require_settled(double tolerance, Solution& solution) {
  std::optional<StepLengths> step;
  try {
    step = newton_step(solution);
    look_for_curvature(tolerance, solution);
  } catch (const Stopped&) {
    return tell_of_stop(solution);
  }
  if (!step) return;
  const double length = step->of_all;
  solution.correction = length;
  if (length <= settled) return;
  if (!std::isfinite(length)) {
    solution.status = Status::evaluation_failed;
    solution.message = "A second derivative is not a number at the solution.";
    return;
  }
  if (step->of_state <= settled) {
    solution.status = Status::control_not_determined;
    solution.message = fmt::format(
        "{} A Newton step would move a control by {:.1g} of its size without changing the state or the cost. The "
        "control is singular or near a bound that the solver has not reached; a smaller tolerance shows which.",
        sentence_of(solution.status), length);
    return;
  }
  solution.status = Status::not_confirmed;
  solution.message = fmt::format(
      "The residuals are below the tolerance, but a Newton step would move the solution by {:.1g} of its size. Scale "
      "the cost to about 1, or reduce the tolerance; neither helps if the cost hardly depends on the moving unknowns.",
      length);
}

void Confirmation::judge(double tolerance, Solution& solution, bool asks_newton) {
  if (static_cast<std::size_t>(solution.primal.size()) != program_.variable_count()) {
    if (!is_solved(solution.status)) return;
    solution.status = Status::not_confirmed;  // nothing to look at
    solution.message = sentence_of(solution.status);
    return;
  }
  judge_residuals(solution);
  solution.curvature.reset();
  curvature_.reset();
  needs_factors_of_rows_ = false;
  has_huge_multipliers_ = false;
  const bool claims_success = solution.status == Status::solved || solution.status == Status::acceptable;
  if (!claims_success) return;
  solution.status = confirmed_status(solution.status, scaled_residual(tolerance, solution));
  solution.message = sentence_of(solution.status);
  if (is_solved(solution.status)) require_visible(tolerance, solution);
  if (is_solved(solution.status) && asks_newton) require_settled(tolerance, solution);
}

namespace {

/// The largest entry of the Hessian of the cost.
double largest_curvature(NonlinearProgram& program, const Eigen::VectorXd& at) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(program.hessian_structure().size()));
  program.hessian(at, 1.0, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.constraint_count())), values);
  return largest_entry(program, values);
}

}  // namespace

double Confirmation::factor_of_cost(double tolerance, const Eigen::VectorXd& start, const Solution& solution) {
  const double enough = confirmation_factor * tolerance;
  double size = largest_of_free(program_, memory_.gradient_of_cost);
  // Second derivatives of a long horizon take time: each is evaluated only where all before it is small.
  if (size < enough) {
    Eigen::VectorXd gradient(start.size());
    program_.gradient(start, gradient);
    size = std::max(size, largest_of_free(program_, gradient));
  }
  if (size < enough) size = std::max(size, largest_curvature(program_, solution.primal));
  if (size < enough) size = std::max(size, largest_curvature(program_, start));
  if (!(size < enough) || size == 0.0) return 1.0;
  constexpr int most = 1000;  // the factor stays finite
  return std::ldexp(1.0, std::min(most, -std::ilogb(size)));
}

Scaling Confirmation::scaling(double tolerance, const Eigen::VectorXd& start, const Solution& solution) {
  return {.of_cost = factor_of_cost(tolerance, start, solution),
          .of_rows = needs_factors_of_rows_ ? sizes_.factors() : Eigen::VectorXd()};
}

void tell_of_stop(Solution& solution) {
  solution.status = stop_is_requested() ? Status::interrupted : Status::time_limit;
  solution.message =
      fmt::format("{} The residuals are below the tolerance, but Newton steps have not confirmed the solution.",
                  sentence_of(solution.status));
}

void refuse_small_cost(double factor, Solution& solution) {
  solution.status = Status::not_confirmed;
  // No Newton step may settle it either: its matrix holds the cost's curvature next to entries that round it away.
  solution.correction.reset();
  solution.message = fmt::format(
      "The derivatives of the cost are below the tolerance, so every feasible point looks optimal; multiply the cost "
      "by about {:.0e} (set `cost_scale` of the problem).",
      factor);
}

void judge_residuals(NonlinearProgram& program, Solution& solution) { Confirmation(program).judge_residuals(solution); }

double scaled_residual(NonlinearProgram& program, double tolerance, const Solution& solution) {
  return Confirmation(program).scaled_residual(tolerance, solution);
}

void confirm(NonlinearProgram& program, double tolerance, Solution& solution) {
  Confirmation(program).judge(tolerance, solution);
}

}  // namespace dmocbench
