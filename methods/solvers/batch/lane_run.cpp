#include "methods/solvers/batch/lane_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/error.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/solvers/interior_point/optimality_errors.hpp"

namespace dmocbench::batch {

namespace {

constexpr double nearly_full = 0.9;  // a step that bounds shorten by less counts as one of Newton's

LaneValues values_of(const LaneProblem& problem) {
  return {LaneVector(problem.constraint_count()), OfLanes::Zero(), OfLanes::Zero(), OfLanes::Zero(), OfLanes::Zero()};
}

}  // namespace

LaneRun::LaneRun(SharedBatch& batch, std::unique_ptr<LaneProgram> lanes, std::unique_ptr<kkt::LaneKkt> kkt)
    : options_(batch.options()),
      queue_(batch, lanes->parameter_count()),
      problem_(batch.program(), std::move(lanes)),
      kkt_(std::move(kkt)),
      floors_(batch.program().rounding_floors()),
      stop_rule_(floors_, options_.tolerance),
      rounding_of_theta_(floors_.norm_of_constraints(problem_.constraint_count())),
      primal_(problem_.primal_count()),
      multipliers_(problem_.constraint_count()),
      z_(problem_.bounds().count()),
      values_(values_of(problem_)),
      trial_(primal_),
      trial_values_(values_),
      step_(primal_),
      multiplier_step_(multipliers_),
      z_step_(z_),
      sigma_(primal_),
      gradient_(primal_),
      compliance_(problem_.inequalities().empty() ? 0 : problem_.constraint_count()),
      residuals_(multipliers_),
      balanced_(primal_) {}

void LaneRun::run() {
  clock_.begin();
  for (refill(); !std::ranges::all_of(lanes_, [](const Lane& lane) { return lane.phase == LanePhase::idle; });
       refill()) {
    solve_systems();
    search_lines();
    differentiate();
    judge();
    queue_.count_round();
  }
  queue_.end_generation(clock_.seconds());
}

bool LaneRun::is_warm(std::size_t lane) const { return lanes_[lane].assignment.instance.multipliers.size() > 0; }

double LaneRun::push_of(std::size_t lane) const {
  return is_warm(lane) ? constants::of_warm_start : constants::kappa_1;
}

bool LaneRun::is_anyone(LanePhase phase) const {
  return std::ranges::any_of(lanes_, [&](const Lane& lane) { return lane.phase == phase; });
}

void LaneRun::refill() {
  const PhaseClock::Within within(clock_, BatchPhase::exchange);
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) {
    while (lanes_[lane].phase == LanePhase::idle && !queue_.is_stopped()) {
      if (!queue_.fetch(lanes_[lane].assignment)) return;
      try {
        begin(lane);
      } catch (const Error& error) {
        refuse(lane, error.what());
      }
    }
  }
}

/// A-1, as far as it needs no value of the program.
void LaneRun::begin(std::size_t number) {
  Lane& lane = lanes_[number];
  const BatchInstance& instance = lane.assignment.instance;
  lane.phase = LanePhase::fresh;
  lane.shift = {};
  lane.iterations = 0;
  lane.systems = 0;
  lane.evaluations = {};
  lane.moves = false;
  lane.is_newton = false;
  lane.mu = !problem_.has_bounds() ? 0.0 : is_warm(number) ? constants::of_warm_start : constants::mu_0;
  kkt_->forget(number);
  problem_.set_equality_values(number, instance.equality_values);
  const Eigen::VectorXd& parameters = instance.parameters;
  problem_.program().set_parameters(number, {parameters.data(), static_cast<std::size_t>(parameters.size())});
  primal_.of(number).head(problem_.variable_count()) = instance.start;
  problem_.bounds().push_inside(number, push_of(number), 0, problem_.variable_count(), primal_);
  if (is_warm(number)) {
    multipliers_.of(number) = instance.multipliers;
  } else {
    multipliers_.of(number).setZero();
  }
  z_.of(number).setOnes();
}

/// Assembles the systems of this round.
kkt::LaneKkt::Systems LaneRun::systems() {
  const bool is_plain = primal_.size() == problem_.variable_count() && !problem_.has_bounds() &&
                        !is_anyone(LanePhase::estimating) && !is_anyone(LanePhase::restoring);
  kkt::LaneKkt::Systems systems{.hessian = problem_.hessian().data(),
                                .jacobian = problem_.jacobian().data(),
                                .diagonal = sigma_.data(),
                                .compliance = compliance_.data(),
                                .gradient = problem_.gradient_of_lagrangian().data(),
                                .constraints = values_.constraints.data()};
  const OfLanes shift = of_lanes([](const Lane& lane) {
    return lane.phase == LanePhase::estimating || lane.phase == LanePhase::restoring ? 1.0 : lane.shift.value();
  });
  if (is_plain) {
    if ((shift != shift_in_sigma_).any()) {
      for (Eigen::Index i = 0; i < sigma_.size(); ++i) sigma_[i] = shift;
    }
    shift_in_sigma_ = shift;
    return systems;
  }
  shift_in_sigma_.setConstant(-1.0);
  assemble_systems(shift);
  systems.gradient = gradient_.data();
  systems.constraints = residuals_.data();
  return systems;
}

/// Σ, the right-hand side and the compliance of all lanes, with slacks eliminated: ds = E (dλ - ∇_s), E the compliance.
void LaneRun::assemble_systems(const OfLanes& shift) {
  const Eigen::Index n = problem_.variable_count();
  const Eigen::Index m = problem_.constraint_count();
  std::copy_n(problem_.gradient_of_lagrangian().data(), primal_.size() * width, gradient_.data());
  std::copy_n(values_.constraints.data(), m * width, residuals_.data());
  std::fill_n(sigma_.data(), sigma_.size() * width, 0.0);
  if (problem_.has_bounds()) {
    problem_.bounds().add_barrier(primal_, z_, of_lanes([](const Lane& lane) { return lane.mu; }), sigma_, gradient_);
  }
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) {
    const LanePhase phase = lanes_[lane].phase;
    if (phase != LanePhase::estimating && phase != LanePhase::restoring) continue;
    problem_.hessian().of(lane).setZero();
    sigma_.of(lane).setZero();
    gradient_.of(lane).setZero();
    if (phase == LanePhase::restoring) continue;
    residuals_.of(lane).setZero();
    gradient_.of(lane).head(n) = problem_.gradient().of(lane);
    problem_.bounds().subtract_multipliers(z_.of(lane), gradient_.of(lane));
  }
  for (Eigen::Index i = 0; i < primal_.size(); ++i) sigma_[i] += shift;
  for (Eigen::Index j = n; const Eigen::Index row : problem_.inequalities()) {
    compliance_[row] = 1.0 / sigma_[j];
    residuals_[row] += compliance_[row] * gradient_[j++];
  }
}

/// A lane whose inertia is wrong waits for the next round with a larger shift, by Algorithm IC.
void LaneRun::solve_systems() {
  LaneMask wanted{};
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) {
    wanted[lane] = lanes_[lane].phase != LanePhase::idle && lanes_[lane].phase != LanePhase::fresh;
    lanes_[lane].moves = false;
    lanes_[lane].waits = false;
  }
  if (std::ranges::none_of(wanted, std::identity{})) return;
  {
    const PhaseClock::Within within(clock_, BatchPhase::tapes);
    problem_.evaluate_hessian(primal_, multipliers_);
  }
  const PhaseClock::Within within(clock_, BatchPhase::linear_systems);
  const kkt::LaneKkt::Outcomes outcomes = kkt_->solve(systems(), wanted, step_.data(), multiplier_step_.data());
  for (Eigen::Index j = problem_.variable_count(); const Eigen::Index row : problem_.inequalities()) {
    step_[j] = compliance_[row] * (multiplier_step_[row] - gradient_[j]);
    ++j;
  }
  for (std::size_t number = 0; number < instance_lanes; ++number) {
    Lane& lane = lanes_[number];
    if (!wanted[number]) continue;
    using enum kkt::LaneKkt::Outcome;
    if (outcomes[number] == again) {
      lane.waits = true;
      continue;
    }
    ++lane.systems;
    if (lane.phase == LanePhase::estimating) {
      auto estimate = multiplier_step_.of(number);
      const bool is_usable = outcomes[number] == solved && estimate.lpNorm<Eigen::Infinity>() <= constants::lambda_max;
      if (is_usable) multipliers_.of(number) = estimate;
      if (!is_usable) multipliers_.of(number).setZero();
    } else if (outcomes[number] == solved) {
      lane.moves = true;
    } else if (outcomes[number] == wrong_inertia && lane.phase == LanePhase::newton &&
               lane.shift.raise(kkt::FactorisationStatus::wrong_inertia)) {
      lane.waits = true;
    } else {
      give_up(number);
    }
  }
}

void LaneRun::differentiate() {
  const PhaseClock::Within within(clock_, BatchPhase::tapes);
  problem_.differentiate(primal_);
  problem_.find_gradient_of_lagrangian(multipliers_);
  if (!problem_.has_bounds()) return;
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) {
    const bool is_fresh_and_warm = lanes_[lane].phase == LanePhase::fresh && is_warm(lane);
    if (is_fresh_and_warm) {
      problem_.bounds().balance(lanes_[lane].mu, primal_.of(lane), problem_.gradient_of_lagrangian().of(lane),
                                z_.of(lane));
    }
  }
}

/// of all lanes.
void LaneRun::judge() {
  OfLanes sum_of_multipliers;
  OfLanes stationarity;
  OfLanes sum_of_z = OfLanes::Zero();
  OfLanes smallest_product = OfLanes::Zero();
  OfLanes largest_product = OfLanes::Zero();
  lane_loops().magnitudes(multipliers_.data(), multipliers_.size(), sum_of_multipliers.data(),
                          largest_multiplier_.data());
  if (problem_.has_bounds()) {
    const LaneVector& gradient = problem_.gradient_of_lagrangian();
    std::copy_n(gradient.data(), gradient.size() * width, balanced_.data());
    problem_.bounds().subtract_multipliers(z_, balanced_);
    problem_.bounds().find_products(primal_, z_, smallest_product, largest_product);
    lane_loops().sum(z_.data(), z_.size(), sum_of_z.data());
  }
  lane_loops().magnitudes(with_bounds().data(), with_bounds().size(), size_of_gradient_.data(), stationarity.data());
  const OfLanes mean_of_z = sum_of_z / std::max(1.0, static_cast<double>(z_.size()));
  const OfLanes mean =
      (sum_of_multipliers + sum_of_z) / std::max(1.0, static_cast<double>(z_.size() + multipliers_.size()));
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) {
    const Eigen::Index at = index_of(lane);
    errors_[lane] = {.stationarity = stationarity[at],
                     .violation = values_.violation[at],
                     .mean_multiplier = mean[at],
                     .mean_bound_multiplier = mean_of_z[at],
                     .smallest_product = smallest_product[at],
                     .largest_product = largest_product[at]};
    if (lanes_[lane].phase != LanePhase::idle) judge(lane);
  }
}

/// The gradient of the Lagrangian with the multipliers of bounds.
const LaneVector& LaneRun::with_bounds() const {
  return problem_.has_bounds() ? balanced_ : problem_.gradient_of_lagrangian();
}

void LaneRun::judge(std::size_t number) {
  Lane& lane = lanes_[number];
  if (lane.waits) {
    if (queue_.is_stopped()) finish(number, queue_.status_of_stop());
    return;
  }
  if (lane.moves || lane.phase == LanePhase::fresh) {
    ++lane.evaluations.gradient;
    ++lane.evaluations.jacobian;
  }
  if (!std::isfinite(size_of_gradient_[index_of(number)])) return give_up(number);
  if (lane.phase == LanePhase::restoring) {
    if (queue_.is_stopped()) return finish(number, queue_.status_of_stop());
    if (lane.iterations >= options_.most_iterations) return finish(number, Status::iteration_limit);
    ++lane.iterations;
    if (is_restored(number)) lane.phase = LanePhase::estimating;
    return;
  }
  const bool is_cold_start = lane.phase == LanePhase::fresh && !is_warm(number);
  // Where bounds allow short steps only, every one of them may multiply the multipliers.
  const bool has_runaway_multipliers = lane.moves && length_[index_of(number)] <= constants::short_step &&
                                       largest_multiplier_[index_of(number)] > constants::runaway;
  if (lane.moves) lane.share_moved = share_of_step_[index_of(number)];
  lane.is_newton = lane.is_newton && lane.moves && length_[index_of(number)] >= nearly_full;
  if (is_cold_start || has_runaway_multipliers) {
    const bool has_gradient = problem_.has_bounds() || !problem_.gradient().of(number).isZero(0.0);
    lane.phase = has_gradient ? LanePhase::estimating : LanePhase::newton;
    if (has_gradient) return;
  }
  lane.phase = LanePhase::newton;
  if (is_solved(number)) return finish(number, Status::solved);
  if (queue_.is_stopped()) return finish(number, queue_.status_of_stop());
  if (lane.iterations >= options_.most_iterations) return finish(number, Status::iteration_limit);
  update_barrier_parameter(number);
  ++lane.iterations;
  ++lane.evaluations.hessian;
  lane.shift.begin();
}

bool LaneRun::is_solved(std::size_t number) const {
  const auto gradient = with_bounds().of(number);
  const Eigen::Index n = problem_.variable_count();
  return errors_[number].meet(stop_rule_, values_.constraints.of(number), multipliers_.of(number), gradient.head(n),
                              gradient.tail(gradient.size() - n));
}

///
void LaneRun::update_barrier_parameter(std::size_t number) {
  if (!problem_.has_bounds()) return;
  Lane& lane = lanes_[number];
  const double lowered = interior_point::lowered_barrier_parameter(lane.mu, options_.tolerance, errors_[number]);
  if (lowered == lane.mu) return;
  lane.mu = lowered;
  lane.line_search.forget();
}

/// An instance whose parameters are not allowed.
void LaneRun::refuse(std::size_t number, const char* reason) {
  lanes_[number].phase = LanePhase::idle;
  solution_ = {};
  solution_.status = Status::invalid_program;
  solution_.message = reason;
  solution_.solver = "batch";
  queue_.deliver(lanes_[number].assignment.index, solution_);
}

void LaneRun::give_up(std::size_t number) {
  Lane& lane = lanes_[number];
  lane.phase = LanePhase::idle;
  lane.moves = false;
  lane.is_searching = false;
  solution_ = {};
  solution_.status = Status::step_failed;
  solution_.solver = "batch";
  solution_.major_iterations = lane.iterations;
  solution_.linear_systems = lane.systems;
  solution_.evaluations = lane.evaluations;
  const PhaseClock::Within within(clock_, BatchPhase::one_by_one);
  queue_.solve_one_by_one(lane.assignment, solution_);
}

/// Whether the tolerance may miss the cost: its gradient is below the permitted residual.
bool LaneRun::has_small_cost(std::size_t number) const {
  Eigen::VectorXd gradient = problem_.gradient().of(number);
  for (const Eigen::Index j : problem_.fixed()) gradient[j] = 0.0;
  return gradient.lpNorm<Eigen::Infinity>() < confirmation_factor * options_.tolerance;
}

void LaneRun::finish(std::size_t number, Status status) {
  const Eigen::Index at = index_of(number);
  Lane& lane = lanes_[number];
  lane.phase = LanePhase::idle;
  lane.moves = false;
  solution_.status = status;
  solution_.message = sentence_of(status);
  solution_.solver = "batch";
  solution_.primal = primal_.of(number).head(problem_.variable_count());
  solution_.multipliers = multipliers_.of(number);
  solution_.objective = values_.objective[at];
  solution_.kkt_residual = errors_[number].stationarity;
  solution_.constraint_violation = values_.violation[at];
  solution_.correction.reset();
  solution_.major_iterations = lane.iterations;
  solution_.linear_systems = lane.systems;
  solution_.evaluations = lane.evaluations;
  // Where the last step was a full one of Newton's and short, the next one is shorter.
  const bool is_settled = lane.is_newton && lane.share_moved <= settled;
  if (status == Status::solved && (!is_settled || has_small_cost(number))) {
    const PhaseClock::Within within(clock_, BatchPhase::one_by_one);
    queue_.confirm(lane.assignment, solution_);
  }
  const PhaseClock::Within within(clock_, BatchPhase::exchange);
  queue_.deliver(lane.assignment.index, solution_);
}

/// From the fraction to the boundary (15a), halve α until filter and decrease accept the point.
void LaneRun::search_lines() {
  const PhaseClock::Within within(clock_, BatchPhase::line_search);
  const OfLanes mu = of_lanes([](const Lane& lane) { return lane.mu; });
  const OfLanes tau = of_lanes([](const Lane& lane) { return interior_point::tau_of(lane.mu); });
  length_.setZero();
  if (std::ranges::any_of(lanes_, &Lane::moves)) {
    OfLanes derivative;
    lane_loops().dot(problem_.gradient().data(), step_.data(), problem_.variable_count(), derivative.data());
    share_of_step_ = problem_.length_of(step_, primal_, derivative, values_.objective);
    OfLanes longest = OfLanes::Ones();
    if (problem_.has_bounds()) {
      derivative += mu * problem_.bounds().barrier_derivative(primal_, step_);
      longest = problem_.bounds().fraction_to_boundary(primal_, step_, tau);
    }
    for (std::size_t lane = 0; lane < instance_lanes; ++lane) {
      if (!lanes_[lane].moves) continue;
      lanes_[lane].derivative = derivative[index_of(lane)];
      length_[index_of(lane)] = longest[index_of(lane)];
      begin_search(lane);
    }
  }
  LaneMask fresh{};
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) fresh[lane] = lanes_[lane].phase == LanePhase::fresh;
  search(fresh);
  primal_.swap(trial_);
  std::swap(values_, trial_values_);
  lane_loops().set_to_sum(multipliers_.data(), multipliers_.data(), length_.data(), multiplier_step_.data(),
                          multipliers_.size());
  if (!problem_.has_bounds()) return;
  // The step of z is that from the point before, which now stands in `trial_`.
  problem_.bounds().set_multiplier_step(trial_, z_, mu, step_, z_step_);
  const OfLanes of_z = problem_.bounds().multiplier_fraction_to_boundary(z_, z_step_, tau);
  problem_.bounds().update_multipliers(primal_, z_step_, (length_ > 0.0).select(of_z, 0.0), mu, z_);
}

/// Evaluates trial points until all lanes have one that is accepted. A lane that has one keeps its length, and gets the
/// same values again.
void LaneRun::search(const LaneMask& fresh) {
  bool is_first = true;
  bool has_returned = false;  // a lane goes back to where the search began
  OfLanes push;
  for (std::size_t lane = 0; lane < instance_lanes; ++lane) push[index_of(lane)] = push_of(lane);
  do {
    has_returned = false;
    lane_loops().set_to_sum(trial_.data(), primal_.data(), length_.data(), step_.data(), primal_.size());
    {
      const PhaseClock::Within within(clock_, BatchPhase::tapes);
      problem_.evaluate(fresh, push, trial_, trial_values_);
    }
    for (std::size_t number = 0; number < instance_lanes; ++number) {
      Lane& lane = lanes_[number];
      if (is_first && fresh[number]) evaluate_start(number);
      if (!lane.is_searching) continue;
      lane.is_searching = lane.phase == LanePhase::restoring ? !try_feasibility_step(number) : !try_step(number);
      if (!lane.is_searching) continue;
      length_[index_of(number)] *= 0.5;
      if (length_[index_of(number)] >= lane.smallest_length) continue;
      length_[index_of(number)] = 0.0;
      has_returned = begin_restoration(number) || has_returned;
    }
    is_first = false;
  } while (has_returned || std::ranges::any_of(lanes_, &Lane::is_searching));
}

void LaneRun::begin_search(std::size_t number) {
  Lane& lane = lanes_[number];
  lane.is_searching = true;
  if (lane.phase == LanePhase::restoring) {
    lane.is_newton = false;
    lane.smallest_length = constants::shortest_feasibility_step;
    return;
  }
  lane.is_newton = lane.shift.value() == 0.0;
  lane.shift.keep();
  lane.smallest_length = lane.line_search.smallest_length(values_.theta[index_of(number)], lane.derivative);
}

interior_point::PointValues LaneRun::values_in(std::size_t number, const LaneValues& values) const {
  const Eigen::Index at = index_of(number);
  const double objective = values.objective[at];
  return {objective, values.theta[at], objective + lanes_[number].mu * values.barrier[at]};
}

/// Whether filter and decrease allow the trial point.
bool LaneRun::try_step(std::size_t number) {
  Lane& lane = lanes_[number];
  ++lane.evaluations.objective;
  ++lane.evaluations.constraints;
  return lane.line_search.accept(values_in(number, values_), values_in(number, trial_values_), lane.derivative,
                                 length_[index_of(number)]);
}

/// A-1, with the values at the start.
void LaneRun::evaluate_start(std::size_t number) {
  Lane& lane = lanes_[number];
  const double theta = trial_values_.theta[index_of(number)];
  ++lane.evaluations.objective;
  ++lane.evaluations.constraints;
  if (!std::isfinite(theta) || !std::isfinite(trial_values_.objective[index_of(number)])) return give_up(number);
  lane.line_search.begin(theta, rounding_of_theta_, problem_.variable_count());
}

/// The lane goes back to the point where its search began. False if it cannot be restored.
bool LaneRun::begin_restoration(std::size_t number) {
  Lane& lane = lanes_[number];
  const double theta = values_.theta[index_of(number)];
  if (lane.phase == LanePhase::restoring || problem_.has_bounds() || theta <= options_.tolerance) {
    give_up(number);
    return false;
  }
  lane.line_search.begin_restoration(values_in(number, values_));
  lane.phase = LanePhase::restoring;
  lane.is_searching = false;
  lane.moves = false;
  lane.waits = true;
  return true;
}

bool LaneRun::try_feasibility_step(std::size_t number) {
  ++lanes_[number].evaluations.objective;
  ++lanes_[number].evaluations.constraints;
  const Eigen::Index at = index_of(number);
  const double theta = trial_values_.theta[at];
  return std::isfinite(theta) && std::isfinite(trial_values_.objective[at]) &&
         interior_point::FilterLineSearch::restores(values_.theta[at], theta, length_[at]);
}

/// Whether the filter accepts the point that a step has led to.
bool LaneRun::is_restored(std::size_t number) {
  Lane& lane = lanes_[number];
  if (lane.line_search.may_return_to(values_in(number, values_), lane.line_search.restored_theta())) return true;
  if (lane.line_search.has_no_room(length_[index_of(number)])) give_up(number);
  return false;
}

}  // namespace dmocbench::batch
