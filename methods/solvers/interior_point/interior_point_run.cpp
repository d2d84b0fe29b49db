#include "methods/solvers/interior_point/interior_point_run.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <sstream>

#include "methods/runtime/clock.hpp"
#include "methods/runtime/long_vectors.hpp"
#include "methods/solvers/interior_point/bound_list.hpp"
#include "methods/solvers/least_violation.hpp"

namespace dmocbench::interior_point {

namespace {

// Constants of Wächter and Biegler, with their names there.
constexpr double first_mu = 0.1;
constexpr double first_mu_of_warm_start = 1e-6;
constexpr double push_of_warm_start = 1e-6;
constexpr double kappa_epsilon = 10.0;
constexpr double kappa_mu = 0.2;
constexpr double theta_mu = 1.5;
constexpr double tau_min = 0.99;
constexpr double eta = 1e-8;
constexpr double delta = 1.0;
constexpr double s_theta = 1.1;
constexpr double s_phi = 2.3;
constexpr double gamma_alpha = 0.05;
constexpr double kappa_soc = 0.99;
constexpr int most_corrections = 4;
constexpr double correctable = 2.0;        // ours: every correction takes an elimination, see is_worth_correcting
constexpr double small_violation = 1e-4;   // θ_min over θ of the start
constexpr double largest_violation = 1e4;  // θ_max over it
constexpr double runaway = 1e8;            // ours: multipliers that are not believed after a step
constexpr double short_step = 0.1;         // as short as this
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

InteriorPointRun::InteriorPointRun(CountedProgram& program, const ProgramRuns& runs, KktSystem& kkt,
                                   const Eigen::VectorXd& start, const SolverOptions& options)
    : plain_program_(program.uncounted()),
      options_(options),
      program_(program, runs),
      newton_(program_, kkt),
      fixed_(fixed_entries(program.variable_lower(), program.variable_upper())),
      tolerance_(options.tolerance),
      allowed_(program, options.tolerance),
      begin_(Clock::now()) {
  point_ = is_warm() ? program_.interior(start, push_of_warm_start) : program_.interior(start);
  resize_unwritten(rows_, point_.multipliers.size());
  resize_unwritten(trial_rows_, point_.multipliers.size());
}

Solution InteriorPointRun::run() {
  Solution solution;
  std::optional<Status> end;
  if (!begin(point_.x)) end = Status::evaluation_failed;
  while (!end) end = iterate();
  if (options_.verbose) {
    std::cout << iterations_ << " iterations, " << newton_.factorisations() << " linear systems\n";
  }
  solution.status = end.value_or(Status::solver_error);
  solution.message = message_;
  solution.primal = std::move(point_.x);
  solution.multipliers = std::move(point_.multipliers);
  solution.major_iterations = iterations_;
  solution.linear_systems = newton_.factorisations();
  solution.linear_seconds = newton_.linear_seconds();
  return solution;
}

bool InteriorPointRun::begin(const Eigen::VectorXd& start) {
  if (program_.has_bounds()) mu_ = is_warm() ? first_mu_of_warm_start : first_mu;
  const auto merit = program_.evaluate(start, point_.s, rows_);
  if (!merit) return false;
  merit_ = *merit;
  program_.differentiate(start);
  if (is_warm()) {
    point_.multipliers = options_.start_multipliers;
    program_.balance_bounds(mu_, point_);
  } else {
    newton_.estimate_multipliers(point_);
  }
  if (!find_slope()) return false;
  measure();
  first_violation_ = std::max(1.0, merit_.violation);
  noise_of_violation_ = plain_program_.rounding_floor() * std::sqrt(static_cast<double>(rows_.size()));
  filter_.reset(largest_violation * first_violation_);
  return true;
}

void InteriorPointRun::measure() { function_ = function_at(point_, merit_); }

double InteriorPointRun::function_at(const Point& point, const BarrierProgram::Merit& merit) const {
  return merit.objective + (program_.has_bounds() ? mu_ * program_.barrier(point) : 0.0);
}

std::optional<Status> InteriorPointRun::reason_to_stop() const {
  if (options_.stop_requested && options_.stop_requested()) return Status::interrupted;
  if (options_.most_seconds > 0.0 && seconds_since(begin_) > options_.most_seconds) return Status::time_limit;
  if (iterations_ >= options_.most_iterations) return Status::iteration_limit;
  return std::nullopt;
}

bool InteriorPointRun::find_slope() {
  if (!program_.slope_of_lagrangian(point_.multipliers, slope_)) return false;
  for (const Eigen::Index i : fixed_) slope_[i] = 0.0;
  return true;
}

InteriorPointRun::Residuals InteriorPointRun::residuals() {
  Residuals at;
  at.violation = largest_of(rows_);
  if (!program_.has_bounds()) {
    at.stationarity = largest_of(slope_);
    return at;
  }
  copy_to(balanced_, slope_);
  subtract_multipliers(program_.x_lower(), point_.x_lower, 1.0, balanced_);
  subtract_multipliers(program_.x_upper(), point_.x_upper, -1.0, balanced_);
  Eigen::VectorXd slack_slope = program_.slope_of_slacks(point_.multipliers);
  subtract_multipliers(program_.s_lower(), point_.s_lower, 1.0, slack_slope);
  subtract_multipliers(program_.s_upper(), point_.s_upper, -1.0, slack_slope);
  at.stationarity = std::max(largest_of(balanced_), largest_of(slack_slope));
  return at;
}

InteriorPointRun::Means InteriorPointRun::mean_multipliers() const {
  const double sum_z = point_.x_lower.sum() + point_.x_upper.sum() + point_.s_lower.sum() + point_.s_upper.sum();
  const auto bounds = static_cast<double>(program_.bound_count());
  const double sum = sum_of_magnitudes(point_.multipliers) + sum_z;
  const double count = bounds + static_cast<double>(point_.multipliers.size());
  return {.all = count > 0.0 ? sum / count : 0.0, .of_bounds = bounds > 0.0 ? sum_z / bounds : 0.0};
}

bool InteriorPointRun::has_converged(const Residuals& at) const {
  if (at.violation > allowed_.violation()) return false;
  const Means mean = mean_multipliers();
  return at.stationarity <= allowed_.stationarity(mean.all, largest_of(point_.multipliers)) &&
         program_.complementarity(point_, 0.0) <= allowed_.complementarity(mean.of_bounds);
}

void InteriorPointRun::lower_barrier(const Residuals& at) {
  if (!program_.has_bounds()) return;
  const double smallest = tolerance_ / (kappa_epsilon + 1.0);
  const Means mean = mean_multipliers();
  const double without_barrier = std::max(at.stationarity / StopRule::scale(mean.all), at.violation);
  const auto error = [&] {
    return std::max(without_barrier, program_.complementarity(point_, mu_) / StopRule::scale(mean.of_bounds));
  };
  while (mu_ > smallest && without_barrier <= kappa_epsilon * mu_ && error() <= kappa_epsilon * mu_) {
    mu_ = std::max(smallest, std::min(kappa_mu * mu_, std::pow(mu_, theta_mu)));
    measure();
    filter_.reset(largest_violation * first_violation_);
  }
}

std::optional<Status> InteriorPointRun::iterate() {
  const Residuals at = residuals();
  if (has_converged(at)) return Status::solved;
  if (const auto reason = reason_to_stop()) return reason;
  lower_barrier(at);
  ++iterations_;
  program_.evaluate_hessian(point_);
  if (!newton_.compute(point_, mu_, slope_, rows_, direction_) || !search(direction_)) {
    if (const auto end = restore()) return end;
  }
  program_.differentiate(point_.x);
  keep_multipliers_from_running_away();
  if (!find_slope()) return Status::evaluation_failed;
  report("newton", step_length_);
  return std::nullopt;
}

/// Where bounds allow short steps only, every one of them may multiply the multipliers, until their Hessian drowns all
/// else. Large ones that a long step leads to may be true.
void InteriorPointRun::keep_multipliers_from_running_away() {
  if (step_length_ <= short_step && largest_of(point_.multipliers) > runaway) newton_.estimate_multipliers(point_);
}

double InteriorPointRun::largest_step(const Direction& direction, double share) const {
  return std::min({longest_step(point_.x, direction.x, program_.x_lower(), 1.0, share),
                   longest_step(point_.x, direction.x, program_.x_upper(), -1.0, share),
                   longest_step(point_.s, direction.s, program_.s_lower(), 1.0, share),
                   longest_step(point_.s, direction.s, program_.s_upper(), -1.0, share)});
}

double InteriorPointRun::largest_bound_step(const Direction& direction, double share) const {
  return std::min(
      {longest_step(point_.x_lower, direction.x_lower, share), longest_step(point_.x_upper, direction.x_upper, share),
       longest_step(point_.s_lower, direction.s_lower, share), longest_step(point_.s_upper, direction.s_upper, share)});
}

/// Accepts the point at `length` along the direction if filter and descent allow it, (18) and (20) of the paper; with
/// differences that are rounding counted as none.
bool InteriorPointRun::try_point(const Direction& direction, double length, double slope, double reference_length) {
  set_trial(direction, length);
  const auto merit = program_.evaluate(trial_.x, trial_.s, trial_rows_);
  trial_merit_ = merit.value_or(BarrierProgram::Merit{infinite, infinite});
  if (!merit) return false;
  const double violation = merit->violation;
  const double function = function_at(trial_, *merit);
  if (!std::isfinite(function)) return false;
  const double noise = noise_of_function();
  if (!filter_.accepts(violation - noise_of_violation_, function - noise)) return false;
  const bool is_noise = violation <= noise_of_violation_ && merit_.violation <= noise_of_violation_;
  const bool is_descent =
      slope < 0.0 && reference_length * std::pow(-slope, s_phi) > delta * std::pow(merit_.violation, s_theta);
  if (merit_.violation <= small_violation * first_violation_ && (is_descent || is_noise)) {
    // Where rows hold but for rounding, the cost may have to rise for them to hold better still.
    const bool is_nearer = is_noise && violation <= (1.0 - Filter::margin) * merit_.violation;
    if (!(function - function_ <= eta * reference_length * slope + noise) && !is_nearer) return false;
  } else {
    const bool is_better = violation <= (1.0 - Filter::margin) * merit_.violation ||
                           function - function_ <= -Filter::margin * merit_.violation + noise;
    if (!is_better) return false;
    filter_.add(merit_.violation, function_);
  }
  accept_trial();
  return true;
}

void InteriorPointRun::set_trial(const Direction& direction, double length) {
  set_to_sum(trial_.x, point_.x, length, direction.x);
  if (point_.s.size() > 0) set_to_sum(trial_.s, point_.s, length, direction.s);
}

/// Rounding of a sum of as many terms as there are unknowns.
double InteriorPointRun::noise_of_function() const {
  constexpr double safety = 10.0;
  return safety * std::sqrt(static_cast<double>(point_.x.size())) * std::numeric_limits<double>::epsilon() *
         (std::abs(merit_.objective) + std::abs(function_ - merit_.objective));
}

void InteriorPointRun::accept_trial() {
  point_.x.swap(trial_.x);
  point_.s.swap(trial_.s);
  rows_.swap(trial_rows_);
  merit_ = trial_merit_;
}

void InteriorPointRun::move_bounds(const Direction& direction, double length) {
  point_.x_lower += length * direction.x_lower;
  point_.x_upper += length * direction.x_upper;
  point_.s_lower += length * direction.s_lower;
  point_.s_upper += length * direction.s_upper;
  program_.keep_near_barrier(mu_, point_);
}

void InteriorPointRun::report(const char* kind, double length) {
  if (!options_.verbose) return;
  const Residuals at = residuals();
  std::ostringstream line;
  line << std::setw(4) << iterations_ << " " << std::setw(6) << kind << std::scientific << std::setprecision(10)
       << "  cost " << merit_.objective << std::setprecision(1) << "  violation " << at.violation << "  stationarity "
       << at.stationarity << "  complementarity " << program_.complementarity(point_, 0.0) << "  mu " << mu_
       << "  shift " << newton_.shift() << "  step " << length << "\n";
  std::cout << line.str();
}

bool InteriorPointRun::search(const Direction& direction) {
  const double share = std::max(tau_min, 1.0 - mu_);
  const double slope = newton_.slope_along(point_, mu_, direction);
  const double longest_step = largest_step(direction, share);
  const double bound_step = largest_bound_step(direction, share);
  const auto smallest_length = [&] {
    double length = Filter::margin;
    if (slope < 0.0) {
      length = std::min(length, -Filter::margin * merit_.violation / slope);
      if (merit_.violation <= small_violation * first_violation_) {
        length = std::min(length, delta * std::pow(merit_.violation, s_theta) / std::pow(-slope, s_phi));
      }
    }
    return std::max(gamma_alpha * length, 1e-14);
  };
  const double least = smallest_length();
  double length = longest_step;
  for (bool is_first = true; is_first || length >= least; length *= 0.5) {
    bool accepted = try_point(direction, length, slope, length);
    if (!accepted && is_first && is_worth_correcting(trial_merit_.violation)) {
      accepted = correct_second_order(slope, length);
    }
    is_first = false;
    if (!accepted) continue;
    set_to_sum(point_.multipliers, point_.multipliers, length, direction.multipliers);
    move_bounds(direction, bound_step);
    measure();
    step_length_ = length;
    return true;
  }
  return false;
}

/// A violation that grows is the rows' curvature. Where it grows a lot the step is too long for a correction: over the
/// library, N = 64, one system in ten is saved, and iterations do not change.
bool InteriorPointRun::is_worth_correcting(double violation_there) const {
  return violation_there >= merit_.violation && violation_there <= correctable * merit_.violation;
}

/// Steps for the rows' curvature: their residual at the trial point joins the right-hand side, (27) of the paper.
bool InteriorPointRun::correct_second_order(double slope, double length) {
  const double share = std::max(tau_min, 1.0 - mu_);
  Eigen::VectorXd residual = length * rows_ + trial_rows_;
  double before = merit_.violation;
  Direction corrected;
  for (int i = 0; i < most_corrections; ++i) {
    if (!residual.allFinite() || !newton_.correct(point_, mu_, slope_, residual, corrected)) return false;
    const double corrected_length = largest_step(corrected, share);
    // NOLINTNEXTLINE(readability-suspicious-call-argument): descent is measured by the step that is corrected.
    if (try_point(corrected, corrected_length, slope, length)) return true;
    const double now = trial_merit_.violation;
    if (!(now <= kappa_soc * before)) return false;
    before = now;
    residual = corrected_length * residual + trial_rows_;
  }
  return false;
}

/// The shortest step towards the rows that makes them better; false if there is none.
bool InteriorPointRun::step_towards_rows() {
  const double mu = std::max(mu_, rows_.lpNorm<Eigen::Infinity>());
  program_.differentiate(point_.x);
  if (!newton_.towards_rows(point_, mu, rows_, direction_)) return false;
  constexpr double shortest = 1e-10;
  constexpr double sufficient = 1e-4;
  for (double length = largest_step(direction_, tau_min); length > shortest; length *= 0.5) {
    set_trial(direction_, length);
    const auto merit = program_.evaluate(trial_.x, trial_.s, trial_rows_);
    if (!merit || !(merit->violation <= (1.0 - sufficient * length) * merit_.violation)) continue;
    trial_merit_ = *merit;
    accept_trial();
    measure();
    step_length_ = length;
    return true;
  }
  return false;
}

/// Steps towards the rows alone, until the filter takes the point back.
std::optional<Status> InteriorPointRun::restore() {
  if (merit_.violation <= tolerance_) {
    message_ = "No step along the Newton direction is an improvement, though all rows hold.";
    return Status::step_failed;
  }
  constexpr double enough = 0.9;
  const double violation_before = merit_.violation;
  filter_.add(merit_.violation, function_);
  bool is_restored = false;
  while (!is_restored) {
    if (const auto reason = reason_to_stop()) return reason;
    if (!step_towards_rows()) break;
    ++iterations_;
    report("rows", step_length_);
    is_restored = merit_.violation <= enough * violation_before && filter_.accepts(merit_.violation, function_);
  }
  if (merit_.violation <= enough * violation_before) {
    begin_anew();
    return std::nullopt;
  }
  if (is_point_of_least_violation(plain_program_, point_.x)) return Status::infeasible;
  message_ = "Neither the Newton step nor a step towards the rows is an improvement.";
  return Status::step_failed;
}

/// Multipliers for a point that was reached without them.
void InteriorPointRun::begin_anew() {
  constexpr double largest = 1e3;
  for (Eigen::VectorXd* z : {&point_.x_lower, &point_.x_upper, &point_.s_lower, &point_.s_upper}) {
    if (z->size() > 0 && z->maxCoeff() > largest) z->setOnes();
  }
  program_.differentiate(point_.x);
  newton_.estimate_multipliers(point_);
}

}  // namespace dmocbench::interior_point
