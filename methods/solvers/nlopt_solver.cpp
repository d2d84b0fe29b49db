#include "methods/solvers/nlopt_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlopt.h>

#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/judgement/kkt_residual.hpp"
#include "methods/kkt/linearisation.hpp"
#include "methods/program/counted_program.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/solvers/iteration_scope.hpp"
#include "methods/solvers/one_sided_constraints.hpp"

namespace dmocbench {

namespace {

/// The distance of a point from a solution: points that meet the constraints before those that do not.
struct Nearness {
  bool violates = true;
  double residual = unbounded;  // scaled_residual of confirm.hpp

  [[nodiscard]] bool is_nearer_than(const Nearness& other) const {
    return violates == other.violates ? residual < other.residual : other.violates;
  }
};

struct Setting {
  std::string_view name;
  nlopt_result (*set)(nlopt_opt, double);
};

constexpr std::array settings{
    Setting{"ftol_rel", nlopt_set_ftol_rel},
    Setting{"ftol_abs", nlopt_set_ftol_abs},
    Setting{"xtol_rel", nlopt_set_xtol_rel},
    Setting{"xtol_abs", nlopt_set_xtol_abs1},
    Setting{"maxeval",
            [](nlopt_opt handle, double value) { return nlopt_set_maxeval(handle, static_cast<int>(value)); }},
    Setting{"maxtime", nlopt_set_maxtime},
};

/// An option passed on, and its value: a number that is not negative, whole for maxeval.
std::pair<const Setting&, double> read_option(const std::string& name, const std::string& text) {
  const Setting& setting = one_of(settings, &Setting::name, name, "NLopt's SLSQP has no option");
  const double value = parsed<double>(text).value_or(-1.0);
  const bool is_whole = name != "maxeval" || (value == std::floor(value) && value <= std::numeric_limits<int>::max());
  if (!std::isfinite(value) || value < 0.0 || !is_whole) {
    throw Error("NLopt rejects the option {}={}; give a {}number of at least 0", name, text,
                name == "maxeval" ? "whole " : "");
  }
  return {setting, value};
}

/// The status by NLopt. It computes no KKT residual, so it can only report that it stopped: "acceptable", for our
/// residual to confirm.
Status claim_of(nlopt_result result) {
  switch (result) {
    case NLOPT_MAXEVAL_REACHED:
      return Status::iteration_limit;
    case NLOPT_MAXTIME_REACHED:
      return Status::time_limit;
    case NLOPT_OUT_OF_MEMORY:
      return Status::out_of_memory;
    case NLOPT_INVALID_ARGS:
      return Status::invalid_program;
    default:
      return Status::acceptable;
  }
}

Solution refused(Status status, std::string message) {
  Solution solution;
  solution.status = status;
  solution.message = std::move(message);
  return solution;
}

/// One solve by SLSQP. Judges the points that NLopt visits and keeps the one nearest to a solution.
class SlsqpRun {
 public:
  SlsqpRun(CountedProgram& program, const Eigen::VectorXd& start, const SolverOptions& options,
           const NamedOptions& named)
      : program_(program),
        options_(options),
        named_(named),
        constraint_tolerance_(std::max(options.tolerance, program.rounding_floors().smallest)),
        equalities_(program, OneSidedConstraints::Kind::equalities),
        inequalities_(program, OneSidedConstraints::Kind::inequalities),
        nearest_point_(start.cwiseMax(program.variable_lower()).cwiseMin(program.variable_upper())) {
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      if (!is_fixed(program, i)) free_.push_back(i);
    }
  }

  [[nodiscard]] Solution run() {
    Solution solution;
    solution.status = Status::acceptable;
    solution.primal = nearest_point_;
    if (free_.empty()) return solution;  // NLopt needs a variable
    if (equalities_.size() > free_.size()) {
      return refused(Status::invalid_program,
                     fmt::format("NLopt's SLSQP accepts at most as many equalities as free variables, but the program "
                                 "has {} and {}; free some variables.",
                                 equalities_.size(), free_.size()));
    }
    handle_.reset(nlopt_create(NLOPT_LD_SLSQP, static_cast<unsigned>(free_.size())));
    if (!handle_) return refused(Status::out_of_memory, {});
    state_program();
    set_options();
    const nlopt_result result = optimise();
    if (exception_) std::rethrow_exception(exception_);

    solution.primal = nearest_point_;
    solution.status = own_stop_.value_or(claim_of(result));
    const bool is_confirmed = confirmed_status(solution.status, nearest_.residual) != Status::not_confirmed;
    if (solution.status == Status::acceptable && !is_confirmed) {
      if (is_point_of_least_violation(program_.uncounted(), solution.primal)) {
        solution.status = Status::infeasible;
      } else if (result < 0) {
        solution.status = Status::step_failed;  // it did not claim to have solved anything
      }
    }
    return solution;
  }

 private:
  void state_program() {
    nlopt_opt handle = handle_.get();
    nlopt_set_lower_bounds(handle, Eigen::VectorXd(program_.variable_lower()(free_)).data());
    nlopt_set_upper_bounds(handle, Eigen::VectorXd(program_.variable_upper()(free_)).data());
    nlopt_set_min_objective(handle, objective, this);
    const std::vector<double> tolerances(std::max(equalities_.size(), inequalities_.size()), constraint_tolerance_);
    if (const auto count = static_cast<unsigned>(equalities_.size()); count > 0) {
      nlopt_add_equality_mconstraint(handle, count, constraints<&SlsqpRun::equalities_>, this, tolerances.data());
    }
    if (const auto count = static_cast<unsigned>(inequalities_.size()); count > 0) {
      nlopt_add_inequality_mconstraint(handle, count, constraints<&SlsqpRun::inequalities_>, this, tolerances.data());
    }
  }

  void set_options() {
    nlopt_set_xtol_rel(handle_.get(), std::numeric_limits<double>::epsilon());
    nlopt_set_maxeval(handle_.get(), options_.most_iterations);
    for (const auto& [name, text] : named_) {
      const auto [setting, value] = read_option(name, text);
      setting.set(handle_.get(), value);
    }
  }

  /// Where SLSQP makes no further progress, it starts again from the nearest point, without its quasi-Newton matrix, as
  /// long as that helps by a tenth and the limits allow it; not if a tolerance was passed on.
  nlopt_result optimise() {
    const bool has_own_tolerance =
        std::ranges::any_of(named_, [](const auto& option) { return option.first.find("tol") != std::string::npos; });
    const int most_evaluations = nlopt_get_maxeval(handle_.get());
    const double most_seconds = nlopt_get_maxtime(handle_.get());
    const auto start_from_nearest_point = [&] {
      Eigen::VectorXd x = nearest_point_(free_);
      double value = 0.0;
      return nlopt_optimize(handle_.get(), x.data(), &value);
    };
    const nlopt_result first = start_from_nearest_point();
    nlopt_result last = first;
    while (!has_own_tolerance && nearest_.residual > confirmation_factor &&
           (last == NLOPT_XTOL_REACHED || last == NLOPT_ROUNDOFF_LIMITED) &&
           set_remaining_limits(most_evaluations, most_seconds)) {
      const Nearness before = nearest_;
      last = start_from_nearest_point();
      if (!nearest_.is_nearer_than({before.violates, 0.9 * before.residual})) break;
    }
    return first;
  }

  /// False if nothing is left of the limits on evaluations and seconds, where 0 is none.
  [[nodiscard]] bool set_remaining_limits(int most_evaluations, double most_seconds) {
    const double seconds = program_.elapsed_seconds();
    if (most_evaluations > 0) nlopt_set_maxeval(handle_.get(), std::max(most_evaluations - visits_, 1));
    if (most_seconds > 0.0) nlopt_set_maxtime(handle_.get(), std::max(most_seconds - seconds, 1e-9));
    return (most_evaluations <= 0 || visits_ < most_evaluations) && (most_seconds <= 0.0 || seconds < most_seconds);
  }

  static double objective(unsigned /*n*/, const double* x, double* gradient, void* data) noexcept {
    auto& self = *static_cast<SlsqpRun*>(data);
    try {
      return self.visit(x, gradient);
    } catch (...) {  // NLopt is C: the exception waits until it has returned
      self.exception_ = std::current_exception();
      return self.stop(Status::solver_error);
    }
  }
  /// SLSQP evaluates the constraints right after the objective, both with derivatives or both without.
  template <OneSidedConstraints SlsqpRun::*some>
  static void constraints(unsigned /*m*/, double* values, unsigned /*n*/, const double* /*x*/, double* gradient,
                          void* data) noexcept {
    const auto& self = *static_cast<const SlsqpRun*>(data);
    (self.*some).values(self.at_.constraints, values);
    if (gradient == nullptr) return;
    const OneSidedConstraints::RowMajor dense = self.at_.jacobian;
    (self.*some).jacobian(dense(Eigen::all, self.free_), gradient);
  }

  double stop(Status status) noexcept {
    own_stop_ = status;
    nlopt_force_stop(handle_.get());
    return unbounded;
  }

  /// The objective; infinity, from which SLSQP's line search turns back, where it or a constraint is not a number.
  double visit(const double* x, double* gradient) {
    if (options_.stop_requested && options_.stop_requested()) return stop(Status::interrupted);
    if (program_.is_out_of_time()) return stop(Status::time_limit);
    const bool is_start = visits_++ == 0;
    const auto size = static_cast<Eigen::Index>(free_.size());
    Eigen::VectorXd point = nearest_point_;  // fixed variables keep their values
    point(free_) = Eigen::Map<const Eigen::VectorXd>(x, size);
    at_ = values_at(program_, point);
    if (!at_.has_finite_values()) return is_start ? stop(Status::evaluation_failed) : unbounded;
    if (gradient == nullptr) return at_.objective;
    differentiate(program_, at_);
    if (!at_.gradient.allFinite() || !at_.jacobian.coeffs().allFinite()) return stop(Status::evaluation_failed);
    Eigen::Map<Eigen::VectorXd>(gradient, size) = at_.gradient(free_);
    return meets_the_tolerance() ? stop(Status::solved) : at_.objective;
  }

  bool meets_the_tolerance() {
    Solution here;
    here.primal = at_.point;
    judge_residuals(program_.uncounted(), here);
    if (++points_ > 1) {
      report_iteration({.solver = "nlopt",
                        .number = points_ - 1,
                        .objective = at_.objective,
                        .violation = here.constraint_violation.value_or(0.0),
                        .stationarity = here.kkt_residual.value_or(0.0)});
    }
    const bool violates = !(here.constraint_violation.value_or(unbounded) <= constraint_tolerance_);
    const Nearness nearness{violates, scaled_residual(program_, options_.tolerance, here)};
    if (nearness.is_nearer_than(nearest_)) {
      nearest_ = nearness;
      nearest_point_ = at_.point;
    }
    return nearness.residual <= 1.0;
  }

  CountedProgram& program_;
  const SolverOptions& options_;
  const NamedOptions& named_;
  double constraint_tolerance_;
  std::vector<Eigen::Index> free_;  // the variables passed to NLopt
  OneSidedConstraints equalities_;
  OneSidedConstraints inequalities_;
  Linearisation at_;
  std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> handle_{nullptr, &nlopt_destroy};
  int visits_ = 0;
  int points_ = 0;  // whose derivatives were evaluated
  Eigen::VectorXd nearest_point_;
  Nearness nearest_;
  std::optional<Status> own_stop_;  // why we stopped NLopt, if we did
  std::exception_ptr exception_;
};

std::string description_of_slsqp() {
  int major = 0;
  int minor = 0;
  int patch = 0;
  nlopt_version(&major, &minor, &patch);
  return fmt::format(
      "SLSQP, a dense quasi-Newton method of sequential quadratic programming (NLopt {}.{}.{}) for at most {} free "
      "variables",
      major, minor, patch, NloptSolver::most_free_variables);
}

}  // namespace

NloptSolver::NloptSolver(SolverOptions options, NamedOptions named)
    : SolverWithoutMemory("nlopt", description_of_slsqp(), std::move(options)), named_(std::move(named)) {
  for (const auto& [name, text] : named_) static_cast<void>(read_option(name, text));
}

Solution NloptSolver::run(CountedProgram& program, const Eigen::VectorXd& start) const {
  if (const std::size_t free_count = free_variable_count(program); free_count > most_free_variables) {
    return refused(Status::too_large, fmt::format("NLopt's SLSQP is dense and accepts at most {} free variables, but "
                                                  "the program has {}; use fewer intervals or another solver.",
                                                  most_free_variables, free_count));
  }
  return SlsqpRun(program, start, options(), named_).run();
}

}  // namespace dmocbench
