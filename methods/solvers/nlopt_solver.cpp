#include "methods/solvers/nlopt_solver.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlopt.h>

#include "methods/error.hpp"
#include "methods/solvers/confirm.hpp"
#include "methods/solvers/counted_program.hpp"
#include "methods/solvers/least_violation.hpp"
#include "methods/solvers/one_sided_constraints.hpp"

namespace dmocbench {

namespace {

/// How near a point is to a solution: points that meet the constraints before those that do not.
struct Nearness {
  bool violates = true;
  double residual = unbounded;  // scaled_residual of confirm.hpp

  [[nodiscard]] bool is_nearer_than(const Nearness& other) const {
    return violates == other.violates ? residual < other.residual : other.violates;
  }
};

/// True if `after` is nearer than `before` by a tenth.
bool helped(const Nearness& before, const Nearness& after) {
  return after.is_nearer_than({before.violates, 0.9 * before.residual});
}

std::vector<Eigen::Index> free_indices(const NonlinearProgram& program) {
  std::vector<Eigen::Index> indices;
  for (Eigen::Index i = 0; i < program.variable_lower().size(); ++i) {
    if (program.variable_lower()[i] != program.variable_upper()[i]) indices.push_back(i);
  }
  return indices;
}

/// NLopt's view of a program; it judges the points that NLopt visits and keeps the best one.
class ProgramForNlopt {
 public:
  ProgramForNlopt(CountedProgram& program, const Eigen::VectorXd& start, const SolverOptions& options,
                  Solution& solution)
      : program_(program),
        options_(options),
        solution_(solution),
        free_(free_indices(program)),
        equalities_(program, OneSidedConstraints::Kind::equalities),
        inequalities_(program, OneSidedConstraints::Kind::inequalities),
        point_(start.cwiseMax(program.variable_lower()).cwiseMin(program.variable_upper())),
        gradient_(point_.size()),
        constraints_(static_cast<Eigen::Index>(program.constraint_count())),
        jacobian_values_(static_cast<Eigen::Index>(program.jacobian_structure().size())),
        jacobian_(OneSidedConstraints::RowMajor::Zero(constraints_.size(), point_.size())) {
    solution.primal = point_;
  }

  [[nodiscard]] Eigen::VectorXd best_point() const { return solution_.primal(free_); }
  [[nodiscard]] const Nearness& nearest() const noexcept { return nearest_; }
  [[nodiscard]] std::size_t equality_count() const noexcept { return equalities_.size(); }
  [[nodiscard]] int visits() const noexcept { return visits_; }
  [[nodiscard]] double seconds() const { return program_.elapsed_seconds(); }
  /// Why we stopped NLopt, if we did.
  [[nodiscard]] const std::optional<Status>& own_stop() const noexcept { return own_stop_; }
  [[nodiscard]] const std::exception_ptr& exception() const noexcept { return exception_; }

  /// States the program to NLopt, which must not outlive this.
  void state(nlopt_opt handle) {
    handle_ = handle;
    nlopt_set_lower_bounds(handle, Eigen::VectorXd(program_.variable_lower()(free_)).data());
    nlopt_set_upper_bounds(handle, Eigen::VectorXd(program_.variable_upper()(free_)).data());
    nlopt_set_min_objective(handle, objective, this);
    const std::vector<double> tolerances(std::max(equalities_.size(), inequalities_.size()), constraint_tolerance());
    if (equalities_.size() > 0) {
      const auto count = static_cast<unsigned>(equalities_.size());
      nlopt_add_equality_mconstraint(handle, count, constraints<&ProgramForNlopt::equalities_>, this,
                                     tolerances.data());
    }
    if (inequalities_.size() > 0) {
      const auto count = static_cast<unsigned>(inequalities_.size());
      nlopt_add_inequality_mconstraint(handle, count, constraints<&ProgramForNlopt::inequalities_>, this,
                                       tolerances.data());
    }
  }

 private:
  static ProgramForNlopt& from(void* data) { return *static_cast<ProgramForNlopt*>(data); }

  static double objective(unsigned /*n*/, const double* x, double* gradient, void* data) noexcept {
    ProgramForNlopt& self = from(data);
    try {
      return self.visit(x, gradient);
    } catch (...) {  // NLopt is C: the exception waits until it has returned
      self.exception_ = std::current_exception();
      return self.stop(Status::solver_error);
    }
  }
  /// SLSQP asks for the constraints where it has just asked for the objective, with the same wish for derivatives.
  template <OneSidedConstraints ProgramForNlopt::*some>
  static void constraints(unsigned /*m*/, double* values, unsigned /*n*/, const double* /*x*/, double* gradient,
                          void* data) noexcept {
    const ProgramForNlopt& self = from(data);
    (self.*some).values(self.constraints_, values);
    if (gradient != nullptr) (self.*some).jacobian(self.jacobian_(Eigen::all, self.free_), gradient);
  }

  [[nodiscard]] double constraint_tolerance() const { return std::max(options_.tolerance, program_.rounding_floor()); }

  double stop(Status status) noexcept {
    own_stop_ = status;
    nlopt_force_stop(handle_);
    return unbounded;
  }

  /// The objective; infinity, from which SLSQP's line search turns back, where it or a constraint is not a number.
  double visit(const double* x, double* gradient) {
    if (options_.stop_requested && options_.stop_requested()) return stop(Status::interrupted);
    const bool is_start = visits_++ == 0;
    const double value = evaluate(x, gradient != nullptr);
    if (!std::isfinite(value) || !constraints_.allFinite()) {
      return is_start ? stop(Status::evaluation_failed) : unbounded;
    }
    if (gradient == nullptr) return value;
    if (!gradient_.allFinite() || !jacobian_values_.allFinite()) return stop(Status::evaluation_failed);
    Eigen::Map<Eigen::VectorXd>(gradient, size()) = gradient_(free_);
    return meets_the_tolerance() ? stop(Status::solved) : value;
  }

  double evaluate(const double* x, bool with_derivatives) {
    point_(free_) = Eigen::Map<const Eigen::VectorXd>(x, size());
    const double value = program_.objective(point_);
    program_.constraints(point_, constraints_);
    if (!with_derivatives) return value;
    program_.gradient(point_, gradient_);
    program_.jacobian(point_, jacobian_values_);
    program_.jacobian_structure().for_each(
        [&](Eigen::Index e, int row, int column) { jacobian_(row, column) = jacobian_values_[e]; });
    return value;
  }

  bool meets_the_tolerance() {
    Solution here;
    here.primal = point_;
    judge_residuals(program_.uncounted(), here);
    const bool violates = !(here.constraint_violation.value_or(unbounded) <= constraint_tolerance());
    const Nearness nearness{violates, scaled_residual(program_, options_.tolerance, here)};
    if (nearness.is_nearer_than(nearest_)) {
      nearest_ = nearness;
      solution_.primal = point_;
    }
    return nearness.residual <= 1.0;
  }

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(free_.size()); }

  CountedProgram& program_;
  const SolverOptions& options_;
  Solution& solution_;
  std::vector<Eigen::Index> free_;  // the variables that NLopt sees
  OneSidedConstraints equalities_;
  OneSidedConstraints inequalities_;
  Eigen::VectorXd point_;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd constraints_;
  Eigen::VectorXd jacobian_values_;
  OneSidedConstraints::RowMajor jacobian_;
  nlopt_opt handle_ = nullptr;
  int visits_ = 0;
  Nearness nearest_;
  std::optional<Status> own_stop_;
  std::exception_ptr exception_;
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

const Setting& setting_named(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Setting& setting : settings) {
    if (setting.name == name) return setting;
    known.push_back(setting.name);
  }
  throw Error(fmt::format("NLopt's SLSQP has no option \"{}\" here; choose one of {}", name, fmt::join(known, ", ")));
}

/// A number that is not negative, whole for maxeval.
double value_of(const std::string& name, const std::string& text) {
  const char* end = text.data() + text.size();
  double value = 0.0;
  const auto [read, error] = std::from_chars(text.data(), end, value);
  const bool is_whole = name != "maxeval" || (value == std::floor(value) && value <= std::numeric_limits<int>::max());
  if (error != std::errc() || read != end || !std::isfinite(value) || value < 0.0 || !is_whole) {
    throw Error(fmt::format("NLopt does not take the option {}={}; give a number that is not negative{}", name, text,
                            name == "maxeval" ? " and whole" : ""));
  }
  return value;
}

void set_options(nlopt_opt handle, const SolverOptions& options) {
  nlopt_set_xtol_rel(handle, std::numeric_limits<double>::epsilon());
  nlopt_set_maxeval(handle, options.most_iterations);
  if (options.most_seconds > 0.0) nlopt_set_maxtime(handle, options.most_seconds);
  for (const auto& [name, text] : options.passed_on) setting_named(name).set(handle, value_of(name, text));
}

/// Limits NLopt to what is left of evaluations and seconds; false if nothing is.
bool set_remaining_limits(nlopt_opt handle, int most_evaluations, int evaluations, double most_seconds,
                          double seconds) {
  if (most_evaluations > 0) nlopt_set_maxeval(handle, std::max(most_evaluations - evaluations, 1));
  if (most_seconds > 0.0) nlopt_set_maxtime(handle, std::max(most_seconds - seconds, 1e-9));
  return (most_evaluations <= 0 || evaluations < most_evaluations) && (most_seconds <= 0.0 || seconds < most_seconds);
}

/// Runs SLSQP. Where it makes no further progress, it starts again from its best point, without its quasi-Newton
/// matrix, as long as that helps and the limits allow it; not if a tolerance was passed on.
nlopt_result optimize(nlopt_opt handle, const ProgramForNlopt& view, const SolverOptions& options) {
  const bool has_own_tolerance =
      std::any_of(options.passed_on.begin(), options.passed_on.end(),
                  [](const auto& option) { return option.first.find("tol") != std::string::npos; });
  const int most_evaluations = nlopt_get_maxeval(handle);
  const double most_seconds = nlopt_get_maxtime(handle);
  const auto run = [&] {
    Eigen::VectorXd x = view.best_point();
    double value = 0.0;
    return nlopt_optimize(handle, x.data(), &value);
  };
  const nlopt_result first = run();
  nlopt_result last = first;
  while (!has_own_tolerance && view.nearest().residual > confirmation_factor &&
         (last == NLOPT_XTOL_REACHED || last == NLOPT_ROUNDOFF_LIMITED) &&
         set_remaining_limits(handle, most_evaluations, view.visits(), most_seconds, view.seconds())) {
    const Nearness before = view.nearest();
    last = run();
    if (!helped(before, view.nearest())) break;
  }
  return first;
}

/// What NLopt says. It judges no KKT residual, so it cannot claim more than that it stopped: "acceptable", for our
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

}  // namespace

NloptSolver::NloptSolver(SolverOptions options) : Solver(std::move(options)) {
  for (const auto& [name, text] : this->options().passed_on) {
    static_cast<void>(setting_named(name));
    static_cast<void>(value_of(name, text));
  }
}

std::string NloptSolver::description() const {
  int major = 0;
  int minor = 0;
  int patch = 0;
  nlopt_version(&major, &minor, &patch);
  return fmt::format(
      "SLSQP, a dense quasi-Newton method of sequential quadratic programming (NLopt {}.{}.{}), at most {} free "
      "variables",
      major, minor, patch, most_free_variables);
}

Solution NloptSolver::run(CountedProgram& program, const Eigen::VectorXd& start) const {
  const std::size_t free_count = free_variable_count(program);
  if (free_count > most_free_variables) {
    return refused(Status::too_large, fmt::format("NLopt's SLSQP is dense and takes at most {} free variables, the "
                                                  "program has {}; take fewer intervals or another solver.",
                                                  most_free_variables, free_count));
  }
  Solution solution;
  ProgramForNlopt view(program, start, options(), solution);
  if (free_count == 0) {  // NLopt wants a variable
    solution.status = Status::acceptable;
    return solution;
  }
  if (view.equality_count() > free_count) {
    return refused(Status::invalid_program,
                   fmt::format("NLopt's SLSQP takes no more equalities than free variables, the program has {} and {}; "
                               "free some variables.",
                               view.equality_count(), free_count));
  }
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> handle(
      nlopt_create(NLOPT_LD_SLSQP, static_cast<unsigned>(free_count)), &nlopt_destroy);
  if (!handle) return refused(Status::out_of_memory, {});
  view.state(handle.get());
  set_options(handle.get(), options());
  const nlopt_result result = optimize(handle.get(), view, options());
  if (view.exception()) std::rethrow_exception(view.exception());

  solution.status = view.own_stop().value_or(claim_of(result));
  const bool is_confirmed = judged(solution.status, view.nearest().residual) != Status::not_confirmed;
  if (solution.status == Status::acceptable && !is_confirmed) {
    if (is_point_of_least_violation(program.uncounted(), solution.primal)) {
      solution.status = Status::infeasible;
    } else if (result < 0) {
      solution.status = Status::step_failed;  // it did not claim to have solved anything
    }
  }
  return solution;
}

}  // namespace dmocbench
