#include "methods/solvers/interior_point/interior_point_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tl/expected.hpp>

#include "methods/choose.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/judgement/least_violation.hpp"
#include "methods/judgement/stop_rule.hpp"
#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/kkt/refined_kkt.hpp"
#include "methods/kkt/sparse_kkt.hpp"
#include "methods/program/counted_program.hpp"
#include "methods/runtime/long_vectors.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/interior_point/barrier_program.hpp"
#include "methods/solvers/interior_point/constants.hpp"
#include "methods/solvers/interior_point/filter_line_search.hpp"
#include "methods/solvers/interior_point/newton_step.hpp"
#include "methods/solvers/interior_point/optimality_errors.hpp"
#include "methods/solvers/iteration_scope.hpp"
#include "methods/solvers/named_options.hpp"

namespace dmocbench {

namespace interior_point {

namespace {

constexpr double push_of_descent = 1e-8;
constexpr double correctable = 2.0;  // see try_second_order_correction

/// The solver of the linear systems that the choices name, or a sentence with the reason why the program's structure
/// does not allow it.
tl::expected<std::unique_ptr<kkt::KktSystem>, std::string> make_kkt(NonlinearProgram& program,
                                                                    const InteriorPointOptions& choices) {
  if (choices.factorisation == InteriorPointOptions::Factorisation::sparse) {
    return std::make_unique<kkt::SparseKkt>(program);
  }
  auto by_intervals = kkt::IntervalKkt::make(program);
  if (by_intervals) return std::make_unique<kkt::RefinedKkt>(program, std::move(*by_intervals));
  if (program.interval_structure() != nullptr && program.interval_structure()->has_interior_equations) {
    return std::make_unique<kkt::SparseKkt>(program, kkt::SparseKkt::Order::along_the_horizon);
  }
  return tl::unexpected(std::move(by_intervals).error());
}

/// One solve by the method of Wächter and Biegler (README.md). Numbers in brackets are its equations, A-1 to
/// A-9 the steps of its Algorithm A.
class InteriorPointRun final : public PreparedRun {
 public:
  InteriorPointRun(CountedProgram& program, std::unique_ptr<kkt::KktSystem> kkt, const SolverOptions& options)
      : counted_(program),
        options_(options),
        program_(program),
        kkt_(std::move(kkt)),
        newton_(program_, *kkt_),
        stop_rule_(program, options.tolerance) {}

  void run(const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers, std::optional<double> barrier_parameter,
           Solution& solution) override {
    std::optional<Status> end = begin(start, multipliers, barrier_parameter);
    try {
      while (!end) end = iterate();
    } catch (const Stopped&) {
      end = reason_to_stop().value_or(Status::time_limit);
    }
    write(*end, solution);  // NOLINT(bugprone-unchecked-optional-access): the loop ends with a status
  }

 private:
  /// A status ends the solve, here and below.
  [[nodiscard]] std::optional<Status> begin(const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers,
                                            std::optional<double> barrier_parameter) {
    program_.read_bounds();
    newton_.begin_solve();
    length_ = 0.0;
    iterations_ = 0;
    descents_ = 0;
    near_ = 0;
    was_short_ = false;
    message_.clear();
    const bool is_warm = multipliers.size() > 0;
    if (program_.has_bounds()) {
      mu_ = barrier_parameter.value_or(is_warm ? constants::of_warm_start : constants::mu_0);
    }
    program_.set_interior(start, is_warm ? constants::of_warm_start : constants::kappa_1, at_);
    if (!program_.evaluate(at_, mu_, values_)) return Status::evaluation_failed;
    program_.differentiate(at_.x);
    if (is_warm) at_.multipliers = multipliers;
    if (!is_warm) newton_.estimate_multipliers(at_);
    if (!program_.gradient_of_lagrangian(at_.multipliers, gradient_)) return Status::evaluation_failed;
    if (is_warm) program_.bounds().balance(mu_, at_, gradient_, at_.z);
    line_search_.begin(values_.theta, counted_.rounding_floors().norm_of_constraints(values_.constraints.size()),
                       at_.x.size());
    return std::nullopt;
  }

  /// One iteration.
  [[nodiscard]] std::optional<Status> iterate() {
    const OptimalityErrors errors = program_.optimality_errors(at_, gradient_, values_);
    // Stop where E_0 <= ε, (5) and (6).
    if (program_.meets(stop_rule_, errors, at_, gradient_, values_) || is_at_round_off(errors)) return Status::solved;
    if (const auto reason = reason_to_stop()) return reason;
    // Lower μ while E_μ <= κ_ε μ, (7).
    update_barrier_parameter(errors);
    ++iterations_;
    // The Newton step (13), its Hessian shifted by Algorithm IC until the inertia is right.
    program_.evaluate_hessian(at_);
    bool is_accepted = false;
    if (newton_.compute(at_, mu_, gradient_, values_.constraints, step_)) {
      // From the fraction to the boundary (15a), halve α until filter and decrease accept the point or α < α_min.
      const double derivative = newton_.directional_derivative(at_, mu_, step_);
      const double alpha_min = line_search_.smallest_length(values_.theta, derivative);
      double alpha = program_.bounds().fraction_to_boundary(at_, step_, tau_of(mu_));
      is_accepted = try_step(step_, alpha, derivative, alpha) || try_second_order_correction(alpha, derivative);
      while (!is_accepted && 0.5 * alpha >= alpha_min) {
        alpha *= 0.5;
        is_accepted = try_step(step_, alpha, derivative, alpha);
      }
      length_ = alpha;
      was_short_ = is_accepted && alpha <= constants::short_step;
      // λ += α dλ, (14b), and z += α_z dz with α_z of (15b), (14c) and (16).
      if (is_accepted) {
        set_to_sum(at_.multipliers, at_.multipliers, alpha, step_.multipliers);
        const double alpha_z = program_.bounds().multiplier_fraction_to_boundary(at_.z, step_.z, tau_of(mu_));
        program_.bounds().update_multipliers(at_, step_.z, alpha_z, mu_, at_.z);
      }
    }
    // Restore feasibility where no step is acceptable.
    if (!is_accepted) {
      if (!is_finite(program_.hessian())) return Status::evaluation_failed;
      if (const auto reason = restoration_phase()) return reason;
    }
    program_.differentiate(at_.x);
    if (!is_accepted) reset_bound_multipliers();
    if (!is_accepted || has_runaway_multipliers()) newton_.estimate_multipliers(at_);
    if (!program_.gradient_of_lagrangian(at_.multipliers, gradient_)) return Status::evaluation_failed;
    report("newton");
    return std::nullopt;
  }

  void write(Status status, Solution& solution) const {
    if (options_.verbose) fmt::print("{} iterations, {} linear systems\n", iterations_, newton_.factorisations());
    solution.status = status;
    solution.message = message_;
    copy_to(solution.primal, at_.x);
    copy_to(solution.multipliers, at_.multipliers);
    solution.barrier_parameter = program_.has_bounds() ? std::optional(mu_) : std::nullopt;
    solution.major_iterations = iterations_;
    solution.linear_systems = newton_.factorisations();
    solution.linear_seconds = newton_.linear_seconds();
  }

  [[nodiscard]] std::optional<Status> reason_to_stop() const {
    if (options_.stop_requested && options_.stop_requested()) return Status::interrupted;
    if (counted_.is_out_of_time()) return Status::time_limit;
    if (iterations_ >= options_.most_iterations) return Status::iteration_limit;
    return std::nullopt;
  }

  /// Whether round-off alone may keep the iterates from the tolerance: `confirm` would accept each of the last ones.
  [[nodiscard]] bool is_at_round_off(const OptimalityErrors& errors) {
    const bool is_near = errors.of_barrier_problem(0.0) <= confirmation_factor * options_.tolerance;
    near_ = is_near ? near_ + 1 : 0;
    return near_ > constants::most_near;
  }

  void update_barrier_parameter(const OptimalityErrors& errors) {
    if (!program_.has_bounds()) return;
    const double lowered = lowered_barrier_parameter(mu_, options_.tolerance, errors);
    if (lowered == mu_) return;
    mu_ = lowered;
    values_.phi = program_.barrier_function(at_, mu_, values_.objective);
    line_search_.forget();
  }

  /// false if a value is not finite.
  [[nodiscard]] bool evaluate_trial(const Primal& step, double length) {
    set_to_sum(trial_.x, at_.x, length, step.x);
    if (at_.s.size() > 0) set_to_sum(trial_.s, at_.s, length, step.s);
    return program_.evaluate(trial_, mu_, trial_values_) && std::isfinite(trial_values_.phi);
  }

  void accept_trial() {
    at_.x.swap(trial_.x);
    at_.s.swap(trial_.s);
    std::swap(values_, trial_values_);
  }

  /// Accepts the point at `length` along a step if filter and decrease allow it. `derivative` and `newton_length` are
  /// the Newton step's, also where its correction is tried.
  [[nodiscard]] bool try_step(const Primal& step, double length, double derivative, double newton_length) {
    if (!evaluate_trial(step, length)) return false;
    if (!line_search_.accept(values_, trial_values_, derivative, newton_length)) return false;
    accept_trial();
    return true;
  }

  /// Where the violation grows from the start of a step, by the constraints' curvature, their residuals at the trial
  /// point join the right-hand side, A-5.5 to. Where it grows a lot the step is too long for a correction that
  /// would be worth its elimination, unless the last step was short: then it may be curvature that keeps them short.
  [[nodiscard]] bool try_second_order_correction(double newton_length, double derivative) {
    double before = values_.theta;
    const bool is_worthwhile = trial_values_.theta <= correctable * before || was_short_;
    const bool grows = trial_values_.theta >= before && std::isfinite(trial_values_.theta);
    if (!grows || !is_worthwhile) return false;
    Eigen::VectorXd& residuals = corrected_residuals_;
    residuals = newton_length * values_.constraints + trial_values_.constraints;  // (27)
    for (int p = 0; p < constants::p_max; ++p) {
      if (!residuals.allFinite() || !newton_.correct(at_, mu_, gradient_, residuals, corrected_)) return false;
      const double alpha = program_.bounds().fraction_to_boundary(at_, corrected_, tau_of(mu_));
      if (try_step(corrected_, alpha, derivative, newton_length)) return true;
      if (!(trial_values_.theta <= constants::kappa_soc * before)) return false;
      before = trial_values_.theta;
      residuals = alpha * residuals + trial_values_.constraints;
    }
    return false;
  }

  /// Steps towards feasibility alone, until the filter accepts the point: steps of least length to where the linearised
  /// constraints hold and, where these end, descent on the violation, which like section 3.3 needs no such place.
  [[nodiscard]] std::optional<Status> restoration_phase() {
    if (values_.theta <= options_.tolerance) {
      message_ = "No step along the Newton direction improves the iterate, although all constraints hold.";
      return Status::step_failed;
    }
    line_search_.begin_restoration(values_);
    const double enough = line_search_.restored_theta();
    for (bool has_room = true; has_room && take_feasibility_step(); has_room = !line_search_.has_no_room(length_)) {
      ++iterations_;
      report("normal");
      if (line_search_.may_return_to(values_, enough)) return std::nullopt;
      if (const auto reason = reason_to_stop()) return reason;
    }
    return values_.theta <= enough ? std::nullopt : descend_on_violation(enough);
  }

  /// Every descent must reduce the violation ten times as far as the one before. `judge_infeasibility` decides whether
  /// it ended at a point of least violation.
  [[nodiscard]] std::optional<Status> descend_on_violation(double enough) {
    enough *= std::pow(0.1, descents_++);
    ViolationDescent descent(counted_, at_.x);
    while (!descent.is_at_least_violation() && !descent.has_stalled() && descent.step()) {
      ++iterations_;
      program_.set_interior(descent.point(), push_of_descent, at_);
      if (!program_.evaluate(at_, mu_, values_)) break;
      report("descent");
      if (line_search_.may_return_to(values_, enough)) return std::nullopt;
      if (const auto reason = reason_to_stop()) return reason;
    }
    message_ = "Neither the Newton step nor descent on the constraint violation improves the iterate.";
    return Status::step_failed;
  }

  /// False if no length of the step lets the violation shrink.
  [[nodiscard]] bool take_feasibility_step() {
    const double mu = std::max(mu_, values_.constraints.lpNorm<Eigen::Infinity>());
    program_.differentiate(at_.x);
    if (!newton_.feasibility_step(at_, mu, values_.constraints, step_)) return false;
    for (length_ = program_.bounds().fraction_to_boundary(at_, step_, constants::tau_min);
         length_ > constants::shortest_feasibility_step; length_ *= 0.5) {
      if (evaluate_trial(step_, length_) && FilterLineSearch::restores(values_.theta, trial_values_.theta, length_)) {
        accept_trial();
        return true;
      }
    }
    return false;
  }

  /// Where bounds allow short steps only, every one of them may multiply the multipliers, until their Hessian swamps
  /// everything else. Large ones that a long step leads to may be true.
  [[nodiscard]] bool has_runaway_multipliers() const {
    return length_ <= constants::short_step && largest_of(at_.multipliers) > constants::runaway;
  }

  /// Resets them where they are large, at a point that was reached without them.
  void reset_bound_multipliers() {
    for (Eigen::VectorXd& z : at_.z) z = largest_of(z) > constants::largest_z ? Eigen::VectorXd::Ones(z.size()) : z;
  }

  void report(const char* kind) {
    if (!options_.verbose && !iterations_are_watched()) return;
    const OptimalityErrors errors = program_.optimality_errors(at_, gradient_, values_);
    report_iteration({.solver = "interior_point",
                      .number = iterations_,
                      .objective = values_.objective,
                      .violation = errors.violation,
                      .stationarity = errors.stationarity});
    if (!options_.verbose) return;
    fmt::print(
        "{:4} {:>7}  cost {:.10e}  violation {:.1e}  stationarity {:.1e}  "
        "complementarity {:.1e}  mu {:.1e}  shift {:.1e}  step {:.1e}\n",
        iterations_, kind, values_.objective, errors.violation, errors.stationarity, errors.complementarity(0.0), mu_,
        newton_.shift(), length_);
  }

  CountedProgram& counted_;
  const SolverOptions& options_;
  BarrierProgram program_;
  std::unique_ptr<kkt::KktSystem> kkt_;
  NewtonStep newton_;
  FilterLineSearch line_search_;
  StopRule stop_rule_;
  Iterate at_;
  Evaluation values_;  // at the iterate
  Primal gradient_;    // of the Lagrangian without bounds, there
  Iterate step_;
  Primal trial_;
  Evaluation trial_values_;
  Iterate corrected_;  // by the constraints' curvature
  Eigen::VectorXd corrected_residuals_;
  double mu_ = 0.0;
  double length_ = 0.0;  // of the last step
  int iterations_ = 0;
  int descents_ = 0;
  int near_ = 0;            // iterates in a row within `confirmation_factor` of the tolerance
  bool was_short_ = false;  // the last Newton step
  std::string message_;
};

/// The answer for a program whose linear systems cannot be factorised as requested.
class RefusedRun final : public PreparedRun {
 public:
  explicit RefusedRun(std::string message) : message_(std::move(message)) {}
  void run(const Eigen::VectorXd& /*start*/, const Eigen::VectorXd& /*multipliers*/,
           std::optional<double> /*barrier_parameter*/, Solution& solution) override {
    solution.status = Status::invalid_program;
    solution.message = message_;
  }

 private:
  std::string message_;
};

using Factorisation = InteriorPointOptions::Factorisation;
constexpr std::array factorisations{Named<Factorisation>{"intervals", Factorisation::intervals},
                                    Named<Factorisation>{"sparse", Factorisation::sparse}};

std::vector<NamedOption> options_by_name(InteriorPointOptions& choices) {
  return {named_option("factorisation", choices.factorisation, factorisations)};
}

}  // namespace

}  // namespace interior_point

InteriorPointOptions::Factorisation factorisation_named(std::string_view name) {
  return value_named(interior_point::factorisations, name, "there is no factorisation");
}

InteriorPointOptions interior_point_options(const NamedOptions& named) {
  InteriorPointOptions choices;
  read_named_options("interior_point", named, interior_point::options_by_name(choices));
  return choices;
}

std::pair<InteriorPointOptions, NamedOptions> interior_point_options_among(const NamedOptions& named) {
  InteriorPointOptions choices;
  NamedOptions others = read_known_options("interior_point", named, interior_point::options_by_name(choices));
  return {std::move(choices), std::move(others)};
}

InteriorPointSolver::InteriorPointSolver(SolverOptions options, InteriorPointOptions choices)
    : Solver("interior_point",
             "interior-point method with exact Hessian; solves its linear systems by elimination, interval by interval",
             std::move(options)),
      choices_(std::move(choices)) {}

std::unique_ptr<PreparedRun> InteriorPointSolver::prepare(CountedProgram& program) const {
  auto kkt = interior_point::make_kkt(program, choices_);
  if (kkt) return std::make_unique<interior_point::InteriorPointRun>(program, std::move(*kkt), options());
  return std::make_unique<interior_point::RefusedRun>(
      fmt::format("interior_point cannot eliminate this program interval by interval: {}; choose ipopt or the option "
                  "factorisation=sparse.",
                  kkt.error()));
}

}  // namespace dmocbench
