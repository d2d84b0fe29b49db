#include "methods/solvers/interior_point/interior_point_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "methods/solvers/confirm.hpp"
#include "methods/solvers/least_violation.hpp"

namespace dmocbench::interior_point {

namespace {

// Constants of Wächter and Biegler, with their names there.
constexpr double first_mu = 0.1;
constexpr double kappa_epsilon = 10.0;
constexpr double kappa_mu = 0.2;
constexpr double theta_mu = 1.5;
constexpr double tau_min = 0.99;
constexpr double kappa_sigma = 1e10;
constexpr double s_max = 100.0;
constexpr double eta = 1e-8;
constexpr double delta = 1.0;
constexpr double s_theta = 1.1;
constexpr double s_phi = 2.3;
constexpr double gamma_alpha = 0.05;
constexpr double kappa_soc = 0.99;
constexpr int most_corrections = 4;
constexpr int most_restorations = 200;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The longest step that leaves `1 - share` of the distance from every bound.
double longest(const Eigen::VectorXd& vector, const Eigen::VectorXd& step, const BoundList& bounds, double side,
               double share) {
  double length = 1.0;
  for (std::size_t i = 0; i < bounds.entries.size(); ++i) {
    const Eigen::Index entry = bounds.entries[i];
    const double distance = side * (vector[entry] - bounds.values[static_cast<Eigen::Index>(i)]);
    const double change = side * step[entry];
    if (change < 0.0) length = std::min(length, -share * distance / change);
  }
  return length;
}

double longest(const Eigen::VectorXd& z, const Eigen::VectorXd& step, double share) {
  double length = 1.0;
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    if (step[i] < 0.0) length = std::min(length, -share * z[i] / step[i]);
  }
  return length;
}

double largest_product(const Eigen::VectorXd& vector, const BoundList& bounds, const Eigen::VectorXd& z, double side,
                       double mu) {
  double largest = 0.0;
  for (std::size_t i = 0; i < bounds.entries.size(); ++i) {
    const auto b = static_cast<Eigen::Index>(i);
    const double distance = side * (vector[bounds.entries[i]] - bounds.values[b]);
    largest = std::max(largest, std::abs(distance * z[b] - mu));
  }
  return largest;
}

void subtract(const BoundList& bounds, const Eigen::VectorXd& z, double side, Eigen::VectorXd& slope) {
  for (std::size_t i = 0; i < bounds.entries.size(); ++i) {
    slope[bounds.entries[i]] -= side * z[static_cast<Eigen::Index>(i)];
  }
}

/// z within a factor of μ/d, so that it cannot leave the neighbourhood of the barrier's own multipliers.
void keep_near(const Eigen::VectorXd& vector, const BoundList& bounds, double side, double mu, Eigen::VectorXd& z) {
  for (std::size_t i = 0; i < bounds.entries.size(); ++i) {
    const auto b = static_cast<Eigen::Index>(i);
    const double barrier = mu / (side * (vector[bounds.entries[i]] - bounds.values[b]));
    z[b] = std::clamp(z[b], barrier / kappa_sigma, barrier * kappa_sigma);
  }
}

}  // namespace

InteriorPointRun::InteriorPointRun(NonlinearProgram& program, KktSystem& kkt, const Eigen::VectorXd& start,
                                   const SolverOptions& options)
    : plain_program_(program),
      options_(options),
      program_(program),
      newton_(program_, kkt),
      tolerance_(options.tolerance),
      begin_(std::chrono::steady_clock::now()) {
  point_ = program_.interior(start);
  rows_.resize(point_.s.size());
  trial_rows_.resize(point_.s.size());
}

Solution InteriorPointRun::run() {
  Solution solution;
  std::optional<Status> end;
  if (!begin(point_.x)) end = Status::evaluation_failed;
  while (!end) end = iterate();
  solution.status = *end;
  solution.message = message_.empty() ? std::string(sentence_of(solution.status)) : message_;
  solution.primal = point_.x;
  solution.multipliers = point_.multipliers;
  solution.major_iterations = iterations_;
  solution.evaluations = program_.evaluations();
  solution.evaluation_seconds = program_.evaluation_seconds();
  solution.seconds = seconds_since(begin_);
  return solution;
}

bool InteriorPointRun::begin(const Eigen::VectorXd& start) {
  mu_ = program_.has_bounds() ? first_mu : 0.0;
  if (!program_.evaluate(start, objective_, rows_)) return false;
  rows_ -= point_.s;
  if (!program_.differentiate(start)) return false;
  if (!newton_.estimate_multipliers(point_)) point_.multipliers.setZero();
  measure();
  first_violation_ = std::max(1.0, violation_);
  filter_.reset(1e4 * first_violation_);
  return true;
}

void InteriorPointRun::measure() {
  violation_ = rows_.lpNorm<1>();
  function_ = objective_ + (program_.has_bounds() ? mu_ * program_.barrier(point_) : 0.0);
}

std::optional<Status> InteriorPointRun::reason_to_stop() const {
  if (options_.stop_requested && options_.stop_requested()) return Status::interrupted;
  if (options_.most_seconds > 0.0 && seconds_since(begin_) > options_.most_seconds) return Status::time_limit;
  if (iterations_ >= options_.most_iterations) return Status::iteration_limit;
  return std::nullopt;
}

InteriorPointRun::Residuals InteriorPointRun::residuals(double mu) const {
  Eigen::VectorXd slope = program_.gradient();
  program_.add_transposed_product(point_.multipliers, slope);
  subtract(program_.x_lower(), point_.x_lower, 1.0, slope);
  subtract(program_.x_upper(), point_.x_upper, -1.0, slope);
  Residuals at;
  const Eigen::VectorXd& lower = plain_program_.variable_lower();
  const Eigen::VectorXd& upper = plain_program_.variable_upper();
  for (Eigen::Index i = 0; i < slope.size(); ++i) {
    if (lower[i] != upper[i]) at.stationarity = std::max(at.stationarity, std::abs(slope[i]));
  }
  if (program_.has_bounds()) {
    Eigen::VectorXd slack_slope = -point_.multipliers;
    subtract(program_.s_lower(), point_.s_lower, 1.0, slack_slope);
    subtract(program_.s_upper(), point_.s_upper, -1.0, slack_slope);
    for (Eigen::Index i = 0; i < slack_slope.size(); ++i) {
      if (!program_.is_equality()[static_cast<std::size_t>(i)]) {
        at.stationarity = std::max(at.stationarity, std::abs(slack_slope[i]));
      }
    }
    at.complementarity = std::max({largest_product(point_.x, program_.x_lower(), point_.x_lower, 1.0, mu),
                                   largest_product(point_.x, program_.x_upper(), point_.x_upper, -1.0, mu),
                                   largest_product(point_.s, program_.s_lower(), point_.s_lower, 1.0, mu),
                                   largest_product(point_.s, program_.s_upper(), point_.s_upper, -1.0, mu)});
  }
  at.violation = rows_.lpNorm<Eigen::Infinity>();
  return at;
}

double InteriorPointRun::barrier_error(const Residuals& at) const {
  const double sum_z = point_.x_lower.sum() + point_.x_upper.sum() + point_.s_lower.sum() + point_.s_upper.sum();
  const auto bounds = static_cast<double>(program_.bound_count());
  const double sum = point_.multipliers.lpNorm<1>() + sum_z;
  const double count = bounds + static_cast<double>(point_.multipliers.size());
  const double s_d = std::max(s_max, count > 0.0 ? sum / count : 0.0) / s_max;
  const double s_c = std::max(s_max, bounds > 0.0 ? sum_z / bounds : 0.0) / s_max;
  return std::max({at.stationarity / s_d, at.violation, at.complementarity / s_c});
}

bool InteriorPointRun::has_converged() const {
  const Residuals at = residuals(0.0);
  const double floor = plain_program_.rounding_floor();
  const double largest = point_.multipliers.size() > 0 ? point_.multipliers.lpNorm<Eigen::Infinity>() : 0.0;
  const double excused_stationarity = floor * std::max(1.0, largest);
  Residuals left = at;
  if (at.stationarity <= excused_stationarity) left.stationarity = 0.0;
  if (at.violation <= floor) left.violation = 0.0;
  return barrier_error(left) <= tolerance_;
}

void InteriorPointRun::lower_barrier() {
  if (!program_.has_bounds()) return;
  const double smallest = tolerance_ / (kappa_epsilon + 1.0);
  while (mu_ > smallest && barrier_error(residuals(mu_)) <= kappa_epsilon * mu_) {
    mu_ = std::max(smallest, std::min(kappa_mu * mu_, std::pow(mu_, theta_mu)));
    measure();
    filter_.reset(1e4 * first_violation_);
  }
}

std::optional<Status> InteriorPointRun::iterate() {
  if (has_converged()) return Status::solved;
  if (const auto reason = reason_to_stop()) return reason;
  lower_barrier();
  program_.evaluate_hessian(point_);
  ++iterations_;
  Direction direction;
  const bool has_direction = program_.hessian().allFinite() && newton_.compute(point_, mu_, rows_, direction);
  if (!has_direction || !search(direction)) {
    if (const auto end = restore()) return end;
  }
  if (!program_.differentiate(point_.x)) return Status::evaluation_failed;
  return std::nullopt;
}

double InteriorPointRun::largest_step(const Direction& direction, double share) const {
  return std::min({longest(point_.x, direction.x, program_.x_lower(), 1.0, share),
                   longest(point_.x, direction.x, program_.x_upper(), -1.0, share),
                   longest(point_.s, direction.s, program_.s_lower(), 1.0, share),
                   longest(point_.s, direction.s, program_.s_upper(), -1.0, share)});
}

double InteriorPointRun::largest_bound_step(const Direction& direction, double share) const {
  return std::min({longest(point_.x_lower, direction.x_lower, share), longest(point_.x_upper, direction.x_upper, share),
                   longest(point_.s_lower, direction.s_lower, share),
                   longest(point_.s_upper, direction.s_upper, share)});
}

/// Accepts the point at `length` along the direction if filter and descent allow it, (18) and (20) of the paper.
bool InteriorPointRun::try_point(const Direction& direction, double length, double slope, double step_length) {
  trial_.x = point_.x + length * direction.x;
  trial_.s = point_.s + length * direction.s;
  if (!program_.evaluate(trial_.x, trial_objective_, trial_rows_)) return false;
  trial_rows_ -= trial_.s;
  const double violation = trial_rows_.lpNorm<1>();
  const double function = trial_objective_ + (program_.has_bounds() ? mu_ * program_.barrier(trial_) : 0.0);
  if (!std::isfinite(function) || !filter_.accepts(violation, function)) return false;
  // Differences of the function below this are its rounding.
  const double rounding = 10.0 * std::numeric_limits<double>::epsilon() * std::abs(function_);
  const double smallest_violation = 1e-4 * first_violation_;
  const bool is_descent = slope < 0.0 && step_length * std::pow(-slope, s_phi) > delta * std::pow(violation_, s_theta);
  if (violation_ <= smallest_violation && is_descent) {
    if (!(function - function_ <= eta * step_length * slope + rounding)) return false;
  } else {
    const bool is_better = violation <= (1.0 - Filter::margin) * violation_ ||
                           function - function_ <= -Filter::margin * violation_ + rounding;
    if (!is_better) return false;
    filter_.add(violation_, function_);
  }
  point_.x.swap(trial_.x);
  point_.s.swap(trial_.s);
  rows_.swap(trial_rows_);
  objective_ = trial_objective_;
  return true;
}

void InteriorPointRun::move_bounds(const Direction& direction, double length) {
  point_.x_lower += length * direction.x_lower;
  point_.x_upper += length * direction.x_upper;
  point_.s_lower += length * direction.s_lower;
  point_.s_upper += length * direction.s_upper;
  keep_bounds_near_barrier();
}

void InteriorPointRun::keep_bounds_near_barrier() {
  keep_near(point_.x, program_.x_lower(), 1.0, mu_, point_.x_lower);
  keep_near(point_.x, program_.x_upper(), -1.0, mu_, point_.x_upper);
  keep_near(point_.s, program_.s_lower(), 1.0, mu_, point_.s_lower);
  keep_near(point_.s, program_.s_upper(), -1.0, mu_, point_.s_upper);
}

bool InteriorPointRun::search(const Direction& direction) {
  const double share = std::max(tau_min, 1.0 - mu_);
  const double slope = newton_.slope_along(point_, mu_, direction);
  const double longest_step = largest_step(direction, share);
  const double bound_step = largest_bound_step(direction, share);
  const auto smallest_length = [&] {
    double length = Filter::margin;
    if (slope < 0.0) {
      length = std::min(length, -Filter::margin * violation_ / slope);
      if (violation_ <= 1e-4 * first_violation_) {
        length = std::min(length, delta * std::pow(violation_, s_theta) / std::pow(-slope, s_phi));
      }
    }
    return std::max(gamma_alpha * length, 1e-14);
  };
  const double least = smallest_length();
  double length = longest_step;
  for (bool is_first = true; is_first || length >= least; length *= 0.5) {
    bool accepted = try_point(direction, length, slope, length);
    if (!accepted && is_first && trial_rows_.lpNorm<1>() >= violation_) {
      accepted = correct_second_order(direction, slope, length);
    }
    is_first = false;
    if (!accepted) continue;
    point_.multipliers += length * direction.multipliers;
    move_bounds(direction, bound_step);
    measure();
    return true;
  }
  return false;
}

/// Steps for the rows' curvature: their residual at the trial point joins the right-hand side, (27) of the paper.
bool InteriorPointRun::correct_second_order(const Direction& direction, double slope, double length) {
  const double share = std::max(tau_min, 1.0 - mu_);
  Eigen::VectorXd residual = length * rows_ + trial_rows_;
  double before = violation_;
  Direction corrected;
  for (int i = 0; i < most_corrections; ++i) {
    if (!residual.allFinite() || !newton_.correct(point_, mu_, residual, corrected)) return false;
    const double corrected_length = largest_step(corrected, share);
    if (try_point(corrected, corrected_length, slope, length)) return true;
    const double now = trial_rows_.lpNorm<1>();
    if (!(now <= kappa_soc * before)) return false;
    before = now;
    residual = corrected_length * residual + trial_rows_;
  }
  static_cast<void>(direction);
  return false;
}

/// Steps towards the rows alone until the filter takes the point back.
std::optional<Status> InteriorPointRun::restore() {
  const double violation_before = violation_;
  if (violation_before <= tolerance_) {
    message_ = "No step along the Newton direction is an improvement, though all rows hold.";
    return Status::step_failed;
  }
  filter_.add(violation_, function_);
  for (int i = 0; i < most_restorations; ++i) {
    if (const auto reason = reason_to_stop()) return reason;
    Direction direction;
    if (!program_.differentiate(point_.x)) return Status::evaluation_failed;
    if (!newton_.towards_rows(point_, rows_, direction)) break;
    double length = largest_step(direction, tau_min);
    bool moved = false;
    for (; length > 1e-10 && !moved; length *= 0.5) {
      trial_.x = point_.x + length * direction.x;
      trial_.s = point_.s + length * direction.s;
      if (!program_.evaluate(trial_.x, trial_objective_, trial_rows_)) continue;
      trial_rows_ -= trial_.s;
      moved = trial_rows_.lpNorm<1>() <= (1.0 - 1e-4 * length) * violation_;
    }
    if (!moved) break;
    ++iterations_;
    point_.x.swap(trial_.x);
    point_.s.swap(trial_.s);
    rows_.swap(trial_rows_);
    objective_ = trial_objective_;
    measure();
    if (violation_ <= 0.9 * violation_before && filter_.accepts(violation_, function_)) {
      keep_bounds_near_barrier();
      if (!program_.differentiate(point_.x)) return Status::evaluation_failed;
      if (!newton_.estimate_multipliers(point_)) point_.multipliers.setZero();
      return std::nullopt;
    }
  }
  if (violation_ <= 0.9 * violation_before) return std::nullopt;
  if (is_point_of_least_violation(plain_program_, point_.x)) return Status::infeasible;
  message_ = "Neither the Newton step nor a step towards the rows is an improvement.";
  return Status::step_failed;
}

}  // namespace dmocbench::interior_point
