#include "methods/solvers/solver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/error.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/judgement/least_violation.hpp"
#include "methods/judgement/linearised_conditions.hpp"
#include "methods/program/counted_program.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/solvers/iteration_scope.hpp"
#include "methods/solvers/leave_saddle.hpp"

namespace dmocbench {

namespace {

/// A program with its cost and its constraints times powers of two. Its multipliers are the original's, times the
/// factor of the cost and divided by the constraint's own.
class ScaledProgram final : public ForwardingProgram {
 public:
  /// `program` must outlive it.
  ScaledProgram(NonlinearProgram& program, const Scaling& scaling) : ForwardingProgram(program), scaling_(scaling) {
    if (!has_rows()) return;
    lower_ = program.constraint_lower().cwiseProduct(scaling.of_rows);
    upper_ = program.constraint_upper().cwiseProduct(scaling.of_rows);
  }

  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override {
    return has_rows() ? lower_ : original().constraint_lower();
  }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override {
    return has_rows() ? upper_ : original().constraint_upper();
  }
  /// None for scaled constraints: their sizes are about 1, and their round-off is far below any tolerance.
  [[nodiscard]] const RoundingFloors& rounding_floors() const override {
    return has_rows() ? NonlinearProgram::rounding_floors() : original().rounding_floors();
  }

  [[nodiscard]] double objective(const VectorIn& x) override { return scaling_.of_cost * original().objective(x); }
  void gradient(const VectorIn& x, VectorOut result) override {
    original().gradient(x, result);
    result *= scaling_.of_cost;
  }
  void constraints(const VectorIn& x, VectorOut result) override {
    original().constraints(x, result);
    if (has_rows()) result.array() *= scaling_.of_rows.array();
  }
  void jacobian(const VectorIn& x, VectorOut values) override {
    original().jacobian(x, values);
    if (!has_rows()) return;
    jacobian_structure().for_each([&](Eigen::Index e, int row, int) { values[e] *= scaling_.of_rows[row]; });
  }
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override {
    if (has_rows()) {
      weighted_ = multipliers.cwiseProduct(scaling_.of_rows);
      original().hessian(x, scaling_.of_cost * objective_factor, weighted_, values);
    } else {
      original().hessian(x, scaling_.of_cost * objective_factor, multipliers, values);
    }
  }

  /// Multipliers of this program, from the original's.
  [[nodiscard]] Eigen::VectorXd scaled(const Eigen::VectorXd& multipliers) const {
    if (multipliers.size() == 0 || !has_rows()) return scaling_.of_cost * multipliers;
    return scaling_.of_cost * multipliers.cwiseQuotient(scaling_.of_rows);
  }
  /// The original's multipliers, from this program's.
  [[nodiscard]] Eigen::VectorXd original_ones(const Eigen::VectorXd& multipliers) const {
    if (multipliers.size() == 0 || !has_rows()) return multipliers / scaling_.of_cost;
    return multipliers.cwiseProduct(scaling_.of_rows) / scaling_.of_cost;
  }

 private:
  [[nodiscard]] bool has_rows() const noexcept { return scaling_.of_rows.size() > 0; }

  const Scaling& scaling_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::VectorXd weighted_;  // multipliers of the original
};

constexpr double shortest_limit = 1e-9;  // in seconds; 0 means no limit

/// " Entry 3 of the start is nan."; empty if the start is finite.
std::string fault_of_start(const Eigen::VectorXd& start) {
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    if (!std::isfinite(start[i])) return fmt::format(" Entry {} of the start is {}.", i, start[i]);
  }
  return {};
}

/// The solution of a scaled program, as one of the program itself.
void state_without_scaling(NonlinearProgram& program, const Scaling& scaling, const ScaledProgram& scaled,
                           Solution& solution) {
  if (scaling.of_cost != 1.0) {
    solution.message += fmt::format(
        " The cost was too small for the tolerance and was multiplied by {:.0e} for the solver, as with `cost_scale`.",
        scaling.of_cost);
  }
  if (scaling.of_rows.size() > 0) {
    solution.message +=
        fmt::format(" {} multiplied by powers of two for the solver.",
                    counted((scaling.of_rows.array() != 1.0).count(), "constraint with a size far from 1 was",
                            "constraints with sizes far from 1 were"));
  }
  if (solution.status == Status::not_confirmed) solution.correction.reset();  // Newton steps would ignore the factors
  if (solution.barrier_parameter) *solution.barrier_parameter /= scaling.of_cost;
  solution.multipliers = scaled.original_ones(solution.multipliers);
  if (solution.primal.size() > 0) Confirmation(program).judge_sizes(solution);
}

/// True of a failure that dependent constraints may cause.
bool has_stopped(Status status) {
  return status == Status::step_failed || status == Status::not_confirmed || status == Status::acceptable;
}

/// Whether a program has equations of its ends, which alone may be left out: to look for dependent rows takes a sparse
/// factorisation, and more memory than the solve.
bool has_equations_of_ends(const NonlinearProgram& program) {
  const IntervalStructure* const structure = program.interval_structure();
  return structure != nullptr && std::ranges::any_of(structure->rows.runs(), [&](const PlaceRun& run) {
           const auto rows = Eigen::seqN(static_cast<Eigen::Index>(run.first), static_cast<Eigen::Index>(run.count));
           return run.kind == Place::Kind::border &&
                  (program.constraint_lower()(rows).array() == program.constraint_upper()(rows).array()).any();
         });
}

/// A program without conditions of its ends that others imply: each is an inequality that no point near a solution
/// reaches. Equations of intervals and nodes stay.
class RelaxedProgram final : public ForwardingProgram {
 public:
  /// `program` must outlive it.
  explicit RelaxedProgram(NonlinearProgram& program)
      : ForwardingProgram(program), lower_(program.constraint_lower()), upper_(program.constraint_upper()) {}

  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return upper_; }

  /// Relaxes the last of the conditions whose gradients depend on each other at a point; false if there are none.
  [[nodiscard]] bool relax_one_at(const Eigen::VectorXd& point) {
    constexpr std::size_t most = 16;
    if (!has_equations_of_ends(*this) || relaxed_.size() == most || !point.allFinite()) return false;
    Eigen::Index last = -1;
    const std::vector<std::size_t> rows = dependent_rows(*this, point);
    for (const std::size_t row : rows) {
      const auto i = static_cast<Eigen::Index>(row);
      const bool is_of_ends = interval_structure()->rows[row].kind == Place::Kind::border;
      if (is_of_ends && lower_[i] == upper_[i]) last = std::max(last, i);
    }
    if (last < 0 || rows.size() < 2) return false;
    Eigen::VectorXd values(lower_.size());
    constraints(point, values);
    const double room = std::max({1.0, std::abs(lower_[last]), 10.0 * std::abs(values[last] - lower_[last])});
    lower_[last] -= room;
    upper_[last] += room;
    relaxed_.push_back(last);
    return true;
  }

  /// Whether a solution of this program is one of the original (`Confirmation`); then it is stated as that.
  [[nodiscard]] bool states_of_original(double tolerance, Solution& solution) const {
    if (!is_solved(solution.status)) return false;
    for (const Eigen::Index row : relaxed_) solution.multipliers[row] = 0.0;
    Solution judged = solution;
    judged.status = Status::solved;
    Confirmation(original()).judge(tolerance, judged, false);
    if (judged.status != Status::solved) return false;
    solution.kkt_residual = judged.kkt_residual;
    solution.constraint_violation = judged.constraint_violation;
    solution.message +=
        fmt::format(" These constraints repeat others and were left out for the solver: {}. State each condition once.",
                    fmt::join(relaxed_, ", "));
    return true;
  }

 private:
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  std::vector<Eigen::Index> relaxed_;
};

class RunWithoutMemory final : public PreparedRun {
 public:
  explicit RunWithoutMemory(std::function<Solution(const Eigen::VectorXd&)> method) : method_(std::move(method)) {}
  void run(const Eigen::VectorXd& start, const Eigen::VectorXd& /*multipliers*/,
           std::optional<double> /*barrier_parameter*/, Solution& solution) override {
    solution = method_(start);
  }

 private:
  std::function<Solution(const Eigen::VectorXd&)> method_;
};

}  // namespace

Solver::Solver(std::string name, std::string description, SolverOptions options)
    : name_(std::move(name)), description_(std::move(description)), options_(std::move(options)) {
  options_.validate();
}

std::unique_ptr<PreparedRun> SolverWithoutMemory::prepare(CountedProgram& program) const {
  return std::make_unique<RunWithoutMemory>(
      [this, &program](const Eigen::VectorXd& start) { return run(program, start); });
}

double Solver::seconds_allowed() const {
  const double in_scope = std::max(seconds_left(), shortest_limit);
  return options_.most_seconds > 0.0 ? std::min(options_.most_seconds, in_scope) : in_scope;
}

StopScope Solver::scope(const CountedProgram& counted) const {
  return {[this] { return options_.stop_requested && options_.stop_requested(); },
          std::max(counted.seconds_left(), shortest_limit)};
}

void Solver::check(const NonlinearProgram& program, const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers,
                   std::optional<double> barrier_parameter) {
  const auto require = [](Eigen::Index given, std::size_t wanted, const char* what, const char* of_program) {
    if (static_cast<std::size_t>(given) == wanted) return;
    throw Error("{} {} entries, but the program has {} {}", what, given, wanted, of_program);
  };
  require(start.size(), program.variable_count(), "the start has", "variables");
  if (multipliers.size() > 0) {
    require(multipliers.size(), program.constraint_count(), "the multipliers have", "constraints");
  }
  if (barrier_parameter && (!(*barrier_parameter > 0.0) || std::isinf(*barrier_parameter))) {
    throw Error("the barrier parameter must be a positive number, got {}", *barrier_parameter);
  }
}

Scaling Solver::complete(CountedProgram& counted, const Eigen::VectorXd& start, Confirmation& confirmation,
                         bool asks_newton, Solution& solution) const {
  solution.seconds = counted.elapsed_seconds();
  solution.evaluation_seconds = counted.evaluation_seconds();
  if (counted.counts().total() > 0) solution.evaluations = counted.counts();
  judge_infeasibility(counted, options_, start, solution);
  const bool claims_success = is_solved(solution.status) || solution.status == Status::acceptable;
  const bool has_point = solution.primal.size() == start.size();
  confirmation.judge(options_.tolerance, solution, asks_newton);
  Scaling needed;
  if (claims_success && has_point) needed = confirmation.scaling(options_.tolerance, start, solution);
  if (needed.of_cost != 1.0) refuse_small_cost(needed.of_cost, solution);
  if (solution.solver.empty()) solution.solver = name();
  if (solution.message.empty()) solution.message = sentence_of(solution.status);
  if (solution.status == Status::evaluation_failed) solution.message += fault_of_start(start);
  return needed;
}

Scaling Solver::run_within_limits(CountedProgram& counted, PreparedRun& run, const WarmStart& start,
                                  Confirmation& confirmation, bool asks_newton, Solution& solution) const {
  const StopScope limits = scope(counted);
  try {
    run.run(start.primal, start.multipliers, start.barrier_parameter, solution);
    return complete(counted, start.primal, confirmation, asks_newton, solution);
  } catch (const Stopped&) {
    solution.status = limits.stop_is_requested() ? Status::interrupted : Status::time_limit;
    solution.message.clear();
    if (solution.primal.size() != start.primal.size()) solution.primal = start.primal;
    return complete(counted, start.primal, confirmation, asks_newton, solution);
  }
}

Scaling Solver::run_and_judge(CountedProgram& counted, PreparedRun& run, const WarmStart& start,
                              Confirmation& confirmation, bool asks_newton, Solution& solution) const {
  Scaling needed = run_within_limits(counted, run, start, confirmation, asks_newton, solution);
  if (!needed.is_one() || !is_solved(solution.status) || !confirmation.negative_curvature()) return needed;
  const Eigen::VectorXd no_multipliers;
  const auto solve_from = [&](const Eigen::VectorXd& moved) {
    Solution next;
    static_cast<void>(
        run_within_limits(counted, run, {moved, no_multipliers, std::nullopt}, confirmation, asks_newton, next));
    return next;
  };
  leave_saddle(counted, options_.tolerance, confirmation, solve_from, solution);
  return needed;
}

Solution Solver::solve_as_stated(NonlinearProgram& program, const WarmStart& start, double seconds,
                                 bool& may_depend) const {
  Confirmation confirmation(program);  // before the clock begins
  CountedProgram counted(program, seconds);
  Solution solution;
  const Scaling needed = run_and_judge(counted, *prepare(counted), start, confirmation, true, solution);
  may_depend = has_stopped(solution.status) || confirmation.has_huge_multipliers();
  if (needed.is_one()) return solution;

  ScaledProgram scaled(program, needed);
  Confirmation of_scaled(scaled);
  CountedProgram counted_again(scaled, std::max(counted.seconds_left(), shortest_limit));
  solution = {};
  std::optional<double> barrier_parameter = start.barrier_parameter;
  if (barrier_parameter) *barrier_parameter *= needed.of_cost;
  const Eigen::VectorXd scaled_multipliers = scaled.scaled(start.multipliers);
  const IterationScope of_original(needed.of_cost);
  static_cast<void>(run_and_judge(counted_again, *prepare(counted_again),
                                  {start.primal, scaled_multipliers, barrier_parameter}, of_scaled, true, solution));
  may_depend = has_stopped(solution.status) || of_scaled.has_huge_multipliers();
  state_without_scaling(program, needed, scaled, solution);
  return solution;
}

Solution Solver::solve(NonlinearProgram& program, const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers,
                       std::optional<double> barrier_parameter) const {
  check(program, start, multipliers, barrier_parameter);
  const WarmStart from{start, multipliers, barrier_parameter};
  const StopScope limits(options_.stop_requested, seconds_allowed());
  bool may_depend = false;
  Solution solution = solve_as_stated(program, from, seconds_allowed(), may_depend);
  if (!may_depend || solution.primal.size() != start.size() || must_stop()) return solution;
  try {
    RelaxedProgram relaxed(program);
    while (relaxed.relax_one_at(solution.primal)) {
      Solution next = solve_as_stated(relaxed, from, std::max(seconds_left(), shortest_limit), may_depend);
      if (relaxed.states_of_original(options_.tolerance, next)) return next;
      if (next.primal.size() != start.size() || must_stop()) break;
    }
  } catch (const Stopped&) {  // the first solution stays
  }
  return solution;
}

}  // namespace dmocbench
