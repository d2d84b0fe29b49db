#include "methods/solvers/sqp/sqp_solver.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "methods/choose.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/kkt/linearisation.hpp"
#include "methods/program/counted_program.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/solvers/iteration_scope.hpp"
#include "methods/solvers/named_options.hpp"
#include "methods/solvers/run_alone.hpp"
#include "methods/solvers/sqp/globalisation.hpp"
#include "methods/solvers/sqp/hessians.hpp"
#include "methods/solvers/sqp/quadratic/quadratic_solver.hpp"

namespace dmocbench {

namespace sqp {

namespace {

/// Share of the solver's tolerance: with equal tolerances the last major iterations stall.
constexpr double tolerance_of_quadratic_programs = 0.1;

/// One run of the SQP method.
class SequentialRun {
 public:
  SequentialRun(CountedProgram& program, const Eigen::VectorXd& start, const SolverOptions& options,
                const SequentialOptions& choices)
      : program_(program),
        options_(options),
        choices_(choices),
        tolerance_(std::max(options.tolerance, program.rounding_floors().smallest)),
        quadratic_solver_({.tolerance = tolerance_of_quadratic_programs * tolerance_, .crash = choices.crash},
                          Pricing(choices.pricing, choices.seed),
                          [this](const MinorIteration& minor) { return observe(minor); }),
        globalisation_(program),
        multipliers_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(program.constraint_count()))) {
    at_ = values_at(program, start.cwiseMax(program.variable_lower()).cwiseMin(program.variable_upper()));
    if (choices.hessian == SecondDerivatives::limited_memory) limited_memory_.emplace(start.size());
    if (choices.hessian == SecondDerivatives::limited_memory_by_cost) limited_memory_.emplace(curvatures_of_cost());
  }

  /// Major iterations until the Karush-Kuhn-Tucker conditions hold.
  [[nodiscard]] Solution run() {
    Solution solution;
    differentiate(program_, at_);
    solution.status = Status::evaluation_failed;
    if (is_differentiable()) {
      std::optional<Status> end;
      try {
        while (!end) end = major_iteration();
      } catch (const Stopped&) {
        end = reason_to_stop().value_or(Status::time_limit);
      }
      solution.status = end.value_or(Status::solver_error);
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

 private:
  [[nodiscard]] std::optional<Status> reason_to_stop() const {
    if (options_.stop_requested && options_.stop_requested()) return Status::interrupted;
    if (program_.is_out_of_time()) return Status::time_limit;
    return std::nullopt;
  }

  /// With the identity in their place, how many iterations are needed depends on the units of the unknowns.
  [[nodiscard]] Eigen::VectorXd curvatures_of_cost() const {
    const Eigen::VectorXd diagonal =
        hessian_at(program_, at_.point, Eigen::VectorXd::Zero(multipliers_.size())).diagonal();
    return (diagonal.array() > 0.0 && diagonal.array().isFinite()).select(diagonal, 1.0);
  }

  [[nodiscard]] bool is_differentiable() const {
    return at_.has_finite_values() && at_.gradient.allFinite() && at_.jacobian.coeffs().allFinite();
  }

  [[nodiscard]] bool observe(MinorIteration minor) {
    minor.major = majors_;
    (minor.phase == MinorPhase::feasibility ? phase_one_minors_ : phase_two_minors_) += 1;
    if (choices_.on_minor_iteration) choices_.on_minor_iteration(minor);
    return !reason_to_stop();
  }

  [[nodiscard]] bool has_converged() const {
    Solution now;
    now.primal = at_.point;
    now.multipliers = multipliers_;
    judge_residuals(program_.uncounted(), now);
    if (majors_ > 0) {
      report_iteration({.solver = "sqp",
                        .number = majors_,
                        .objective = at_.objective,
                        .violation = now.constraint_violation.value_or(0.0),
                        .stationarity = now.kkt_residual.value_or(0.0)});
    }
    return scaled_residual(program_.uncounted(), options_.tolerance, now) <= 1.0;
  }

  [[nodiscard]] std::optional<Status> major_iteration() {
    if (has_converged()) return Status::solved;
    if (const auto reason = reason_to_stop()) return reason;
    if (majors_ == options_.most_iterations) return Status::iteration_limit;
    if (!limited_memory_) {
      if (const auto reason = compute_exact_hessian()) return reason;
    }
    ++majors_;
    const QuadraticSolution quadratic = quadratic_solver_.solve(
        quadratic_program_at(program_, at_, [this](const auto& vectors) { return hessian_times(vectors); }));
    switch (quadratic.status) {
      case QuadraticStatus::stopped:
        return reason_to_stop().value_or(Status::time_limit);
      case QuadraticStatus::breakdown:
        message_ = "A quadratic program could not be solved: " + quadratic.message + ".";
        return Status::step_failed;
      case QuadraticStatus::infeasible:
        if (quadratic.step.lpNorm<Eigen::Infinity>() < tolerance_) return Status::infeasible;
        break;
      case QuadraticStatus::optimal:
        break;
    }
    const double curvature = quadratic.step.dot(hessian_times(quadratic.step).col(0));
    const LineSearchResult search = globalisation_.search(at_, quadratic.step, curvature);
    if (search.step_length == 0.0) {
      return quadratic.status == QuadraticStatus::infeasible ? Status::infeasible : Status::step_failed;
    }
    if (options_.verbose) print(quadratic, search);
    take(search, quadratic);
    if (is_differentiable()) return std::nullopt;
    return Status::evaluation_failed;
  }

  /// A status where there is none to work with, or the time is up.
  [[nodiscard]] std::optional<Status> compute_exact_hessian() {
    exact_hessian_ = hessian_at(program_, at_.point, multipliers_);
    const auto needed =
        convexification_.shift_for(exact_hessian_, at_.jacobian, free_variables(program_), equalities_of(program_),
                                   [this] { return reason_to_stop().has_value(); });
    if (!needed) {
      if (const auto reason = reason_to_stop()) return reason;
      message_ = "The Hessian of the Lagrangian is not finite, or its entries are too large.";
      return Status::step_failed;
    }
    shift_ = std::max(*needed, cautious_shift_);
    return std::nullopt;
  }

  /// The quasi-Newton matrix, or the exact Hessian with its shift, times vectors.
  [[nodiscard]] Eigen::MatrixXd hessian_times(const Eigen::Ref<const Eigen::MatrixXd>& vectors) const {
    if (limited_memory_) return limited_memory_->times(vectors);
    return exact_hessian_.selfadjointView<Eigen::Lower>() * vectors + shift_ * vectors;
  }

  void print(const QuadraticSolution& quadratic, const LineSearchResult& search) const {
    fmt::print(
        "major {}, minors {} + {}, merit weight {:.2e}, shift {:.2e}, step {:.2e} taken by {:.2e}, objective {:.10e}\n",
        majors_, phase_one_minors_, phase_two_minors_, globalisation_.weight(), shift_,
        quadratic.step.lpNorm<Eigen::Infinity>(), search.step_length, search.accepted.objective);
  }

  void take(const LineSearchResult& search, const QuadraticSolution& quadratic) {
    Eigen::VectorXd wanted = quadratic.multipliers;
    if (quadratic.status == QuadraticStatus::infeasible) {
      wanted = wanted.cwiseMax(-globalisation_.weight()).cwiseMin(globalisation_.weight());
    }
    multipliers_ += search.step_length * (wanted - multipliers_);
    const Linearisation before = std::exchange(at_, search.accepted);
    differentiate(program_, at_);
    if (limited_memory_) {
      limited_memory_->update(at_.point - before.point,
                              (at_.gradient + at_.jacobian.transpose() * multipliers_) -
                                  (before.gradient + before.jacobian.transpose() * multipliers_));
    }
    adapt_shift(search.step_length);
  }

  /// Short steps need more curvature than the quadratic program needs.
  void adapt_shift(double step_length) {
    constexpr double short_step = 0.2;
    constexpr double growth = 4.0;
    constexpr double decay = 3.0;
    constexpr double smallest = 1e-6;
    constexpr double least = 1e-10;
    if (step_length < short_step) {
      cautious_shift_ = growth * std::max({shift_, cautious_shift_, smallest});
      convexification_.least_shift = Convexification::first_least_shift;
    } else if (step_length == 1.0) {
      cautious_shift_ /= decay;
      if (cautious_shift_ < smallest) cautious_shift_ = 0.0;
      if (shift_ == convexification_.least_shift) convexification_.least_shift = std::max(least, shift_ / decay);
    }
  }

  CountedProgram& program_;
  const SolverOptions& options_;
  const SequentialOptions& choices_;
  double tolerance_;
  QuadraticSolver quadratic_solver_;
  Globalisation globalisation_;
  Convexification convexification_;
  std::optional<LimitedMemoryHessian> limited_memory_;  // in place of the exact Hessian
  Eigen::SparseMatrix<double> exact_hessian_;           // its lower triangle
  double shift_ = 0.0;                                  // added to its diagonal
  double cautious_shift_ = 0.0;                         // the least shift, after short steps
  Linearisation at_;
  Eigen::VectorXd multipliers_;
  int majors_ = 0;
  int phase_one_minors_ = 0;
  int phase_two_minors_ = 0;
  std::string message_;
};

constexpr std::array crashes{Named<Crash>{"none", Crash::none}, Named<Crash>{"basis", Crash::basis}};
constexpr std::array hessians{
    Named<SecondDerivatives>{"exact", SecondDerivatives::exact},
    Named<SecondDerivatives>{"limited_memory", SecondDerivatives::limited_memory},
    Named<SecondDerivatives>{"limited_memory_by_cost", SecondDerivatives::limited_memory_by_cost}};
constexpr std::array pricing_rules{
    Named<PricingRule>{"largest", PricingRule::largest}, Named<PricingRule>{"lowest", PricingRule::lowest},
    Named<PricingRule>{"last", PricingRule::last}, Named<PricingRule>{"random", PricingRule::random}};

}  // namespace

}  // namespace sqp

sqp::Crash crash_named(std::string_view name) { return value_named(sqp::crashes, name, "there is no first basis"); }

SequentialOptions sequential_options(const NamedOptions& named) {
  SequentialOptions choices;
  read_named_options(
      "sqp", named,
      {named_option("crash", choices.crash, sqp::crashes), named_option("hessian", choices.hessian, sqp::hessians),
       named_option("pricing", choices.pricing, sqp::pricing_rules), named_option("seed", choices.seed)});
  return choices;
}

SqpSolver::SqpSolver(SolverOptions options, SequentialOptions choices)
    : SolverWithoutMemory("sqp",
                          "sequential quadratic programming with an active-set method and exact Hessian; counts every "
                          "minor iteration",
                          std::move(options)),
      choices_(std::move(choices)) {}

Solution SqpSolver::run(CountedProgram& program, const Eigen::VectorXd& start) const {
  return run_alone(program, start, options(),
                   [&] { return sqp::SequentialRun(program, start, options(), choices_).run(); });
}

}  // namespace dmocbench
