#include "methods/solvers/sqp/quadratic/quadratic_solver.hpp"

#include <algorithm>
#include <limits>
#include <ranges>
#include <utility>
#include <vector>

#include "methods/solvers/sqp/quadratic/pricing.hpp"
#include "methods/solvers/sqp/quadratic/reduced_hessian.hpp"

namespace dmocbench::sqp {

namespace {

/// Thrown where an observer requests a stop.
struct StoppedByObserver {};

/// The columns that may move and thereby lower the objective, without the basic and (if `but_superbasics`) the
/// superbasic ones. `rates` (n + m entries): the rates of change of the objective.
std::vector<PricedColumn> candidates_of(const QuadraticIterate& iterate, const Eigen::VectorXd& rates, double tolerance,
                                        bool but_superbasics) {
  std::vector<PricedColumn> candidates;
  const WorkingSet& sets = iterate.sets();
  for (Eigen::Index j = 0; j < rates.size(); ++j) {
    if (sets.of(j) == WorkingSet::Membership::basic) continue;
    if (but_superbasics && sets.of(j) == WorkingSet::Membership::superbasic) continue;
    const double value = iterate.values()[j];
    const bool can_rise = value < iterate.upper()[j];
    const bool can_fall = value > iterate.lower()[j];
    if ((rates[j] < -tolerance && can_rise) || (rates[j] > tolerance && can_fall)) candidates.push_back({j, rates[j]});
  }
  return candidates;
}

/// The distance by which the columns `moving` may follow `change` (n + m entries).
RatioTest ratio_test(const QuadraticIterate& iterate, const std::vector<Eigen::Index>& moving,
                     const Eigen::VectorXd& change, double limit) {
  std::vector<MovingColumn> columns;
  columns.reserve(moving.size());
  for (const Eigen::Index j : moving) {
    columns.push_back({iterate.values()[j], change[j], iterate.lower()[j], iterate.upper()[j]});
  }
  return ratio_test(columns, limit, iterate.tolerance());
}

/// Calls the observer; throws `StoppedByObserver`.
void report(const QuadraticIterate& iterate, MinorIteration minor, const MinorObserver& observer) {
  const WorkingSet& sets = iterate.sets();
  minor.infeasibility = iterate.infeasibility();
  minor.objective = iterate.objective();
  minor.superbasics = static_cast<Eigen::Index>(sets.superbasics().size());
  minor.basic_slacks = std::count_if(sets.basics().begin(), sets.basics().end(),
                                     [&](Eigen::Index j) { return j >= iterate.program().variable_count(); });
  if (!observer(minor)) throw StoppedByObserver{};
}

/// The rate of change of the sum of infeasibilities with each basic column: -1, 0 or 1.
Eigen::VectorXd infeasibility_rates(const QuadraticIterate& iterate) {
  const std::vector<Eigen::Index>& basics = iterate.sets().basics();
  Eigen::VectorXd rates(static_cast<Eigen::Index>(basics.size()));
  for (std::size_t position = 0; position < basics.size(); ++position) {
    rates[static_cast<Eigen::Index>(position)] = iterate.violated_side(basics[position]);
  }
  return rates;
}

/// Moves `entering` and the basic columns with it until one of them is stopped by a bound, and exchanges the two.
void take_step(QuadraticIterate& iterate, const PricedColumn& entering, const MinorObserver& observer) {
  const QuadraticProgram& program = iterate.program();
  const double direction = entering.rate < 0.0 ? 1.0 : -1.0;
  const Eigen::VectorXd solved = iterate.basis().solve(program.column(entering.column));

  Eigen::VectorXd change = Eigen::VectorXd::Zero(program.column_count());
  change[entering.column] = direction;
  change(iterate.sets().basics()) = -direction * solved;
  std::vector<Eigen::Index> moving = iterate.sets().basics();
  moving.push_back(entering.column);  // it may reach its own other bound
  const RatioTest test = ratio_test(iterate, moving, change, std::numeric_limits<double>::infinity());
  if (!test.blocking) throw Breakdown("no constraint limits a step that lowers the infeasibility");

  const Eigen::Index leaving = moving[*test.blocking];
  const bool crosses = leaving == entering.column;
  const int violated = iterate.violated_side(leaving);
  iterate.move(change, test.step);
  iterate.put_on_bound(leaving, violated > 0 || (change[leaving] > 0.0 && violated == 0));
  if (!crosses) {
    iterate.replace_basic(static_cast<Eigen::Index>(*test.blocking), entering.column, solved);
  } else if (iterate.sets().of(leaving) == WorkingSet::Membership::superbasic) {
    const auto& superbasics = iterate.sets().superbasics();
    iterate.drop_superbasic(std::find(superbasics.begin(), superbasics.end(), leaving) - superbasics.begin());
  }
  report(iterate,
         {.phase = MinorPhase::feasibility, .entering = entering.column, .leaving = leaving, .step = test.step},
         observer);
}

/// Phase 1: one column enters the basis and one leaves per minor iteration, so that the sum of infeasibilities falls,
/// until all columns are within their bounds or no column can lower the sum. Throws `Breakdown`, `StoppedByObserver`.
void find_feasible_point(QuadraticIterate& iterate, Pricing& pricing, double tolerance, const MinorObserver& observer) {
  while (true) {
    const Eigen::VectorXd weights = infeasibility_rates(iterate);
    if (weights.isZero(0.0)) return;
    const Eigen::VectorXd multipliers = iterate.basis().solve_transposed(weights);
    const Eigen::VectorXd rates = -iterate.program().transposed_times(multipliers);
    const auto candidates = candidates_of(iterate, rates, tolerance, false);
    if (candidates.empty()) return;
    take_step(iterate, pricing.choose(candidates), observer);
  }
}

/// Phase 2: from a feasible point (up to violations that were accepted) to the minimiser. A column whose reduced
/// gradient exceeds `tolerance` becomes superbasic when the point is stationary on the present sets; each minor
/// iteration takes the exact step of the reduced Hessian ZᵀHZ, or as much of it as the bounds allow.
class PhaseTwo {
 public:
  PhaseTwo(QuadraticIterate& iterate, Pricing& pricing, double tolerance, const MinorObserver& observer)
      : iterate_(iterate), pricing_(pricing), tolerance_(tolerance), observer_(observer) {
    start();
  }

  /// Returns the multipliers π of A d - s = 0: g + Hd - Aᵀπ vanishes in the free columns. Throws `Breakdown`,
  /// `StoppedByObserver`.
  Eigen::VectorXd run() {
    bool stationary = largest_rate_of_superbasics() <= tolerance();
    while (true) {
      std::optional<Eigen::Index> entering;
      if (stationary) {
        const auto candidates = candidates_of(iterate_, rates_, tolerance(), true);
        if (candidates.empty()) return multipliers_;
        entering = pricing_.choose(candidates).column;
        iterate_.make_superbasic(*entering);
        // An ill-conditioned basis may look like negative curvature: try a better basis among the same columns.
        if (!border()) rebuild();
      }
      stationary = take_step(entering);
    }
  }

 private:
  [[nodiscard]] const QuadraticProgram& program() const { return iterate_.program(); }

  /// Scaled like the convergence test of the whole method, which would stall if quadratic programs were solved less
  /// accurately.
  [[nodiscard]] double tolerance() const {
    constexpr double multiplier_scale = 100.0;
    const double mean = multipliers_.size() > 0 ? multipliers_.cwiseAbs().mean() : 0.0;
    return tolerance_ * std::max(1.0, mean / multiplier_scale);
  }

  /// π and the reduced gradients of all columns at the present point.
  void compute_rates() {
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(program().column_count());
    gradient.head(program().variable_count()) = program().gradient + program().hessian_times(iterate_.variables());
    multipliers_ = iterate_.basis().solve_transposed(gradient(iterate_.sets().basics()));
    rates_ = gradient - program().transposed_times(multipliers_);
  }

  [[nodiscard]] double largest_rate_of_superbasics() const {
    const Eigen::VectorXd rates = rates_(iterate_.sets().superbasics());
    return rates.size() > 0 ? rates.lpNorm<Eigen::Infinity>() : 0.0;
  }

  /// The step from the point to the minimiser on the present sets: n + m entries.
  [[nodiscard]] Eigen::VectorXd newton_step() const {
    return iterate_.null_space_times(-reduced_.solve(rates_(iterate_.sets().superbasics())));
  }

  /// Borders the reduced Hessian by the superbasic column that joined last.
  [[nodiscard]] bool border() {
    const auto count = static_cast<Eigen::Index>(iterate_.sets().superbasics().size());
    const Eigen::VectorXd direction = iterate_.null_space_times(Eigen::VectorXd::Unit(count, count - 1));
    const Eigen::VectorXd curved = program().hessian_times(direction.head(program().variable_count()));
    const Eigen::VectorXd entries = iterate_.null_space_transposed_times(curved);
    return reduced_.append(entries.head(count - 1), entries[count - 1]);
  }

  void rebuild() {
    iterate_.choose_basis_again();
    start();
  }

  /// The reduced Hessian and the reduced gradients from the present sets.
  void start() {
    if (!reduced_.assign(iterate_.reduced_hessian())) {
      throw Breakdown("the reduced Hessian is not positive definite");
    }
    compute_rates();
  }

  /// One minor iteration; true if the point is stationary on the sets afterwards, as it is after a whole step.
  bool take_step(std::optional<Eigen::Index> entering) {
    const Eigen::VectorXd change = newton_step();
    std::vector<Eigen::Index> moving = iterate_.sets().basics();
    const auto basic_count = moving.size();
    moving.insert(moving.end(), iterate_.sets().superbasics().begin(), iterate_.sets().superbasics().end());
    constexpr double whole = 1.0;
    const RatioTest test = ratio_test(iterate_, moving, change, whole);
    iterate_.move(change, test.step);
    MinorIteration minor{.phase = MinorPhase::optimality, .entering = entering, .step = test.step};
    if (test.blocking) {
      minor.leaving = moving[*test.blocking];
      iterate_.put_on_bound(*minor.leaving, change[*minor.leaving] > 0.0);
      if (*test.blocking < basic_count) {
        minor.into_basis = exchange(static_cast<Eigen::Index>(*test.blocking));
      } else {
        const auto place = static_cast<Eigen::Index>(*test.blocking - basic_count);
        iterate_.drop_superbasic(place);
        if (!reduced_.remove(place)) rebuild();
      }
    }
    compute_rates();
    if (!test.blocking) refine();
    report(iterate_, minor, observer_);
    return !test.blocking || largest_rate_of_superbasics() <= tolerance();
  }

  /// The basic column at `position` stays at its bound; the superbasic column with the largest pivot takes its place.
  Eigen::Index exchange(Eigen::Index position) {
    const Eigen::VectorXd row =
        iterate_.basis().solve_transposed(Eigen::VectorXd::Unit(program().row_count(), position));
    const Eigen::VectorXd weights = program().transposed_times(row)(iterate_.sets().superbasics());
    Eigen::Index place = 0;
    weights.cwiseAbs().maxCoeff(&place);
    const Eigen::Index entering = iterate_.sets().superbasics()[static_cast<std::size_t>(place)];
    const bool kept = reduced_.exchange(place, weights);
    iterate_.replace_basic(position, entering, iterate_.basis().solve(program().column(entering)));
    if (!kept) rebuild();
    return entering;
  }

  /// Where the reduced Hessian is ill conditioned, rounding leaves the step a little short; the rest belongs to the
  /// same step.
  void refine() {
    constexpr int most = 3;
    for (int i = 0; i < most && largest_rate_of_superbasics() > 0.1 * tolerance(); ++i) {
      iterate_.move(newton_step(), 1.0);
      compute_rates();
    }
  }

  QuadraticIterate& iterate_;
  ReducedHessian reduced_;
  Pricing& pricing_;
  double tolerance_;
  const MinorObserver& observer_;
  Eigen::VectorXd multipliers_;
  Eigen::VectorXd rates_;
};

WorkingSet slack_start(const QuadraticProgram& program) { return {program.column_count(), program.slacks(), {}}; }

/// The same free columns, with a well-conditioned basis among them.
WorkingSet warm_start(const QuadraticProgram& program, const WorkingSet& sets) {
  BasisChoice choice = choose_basis(program, sets.basics(), sets.superbasics());
  return {program.column_count(), std::move(choice.basics), std::move(choice.others)};
}

bool leaves_variable_outside(const QuadraticIterate& iterate) {
  return std::ranges::any_of(std::views::iota(Eigen::Index{0}, iterate.program().variable_count()),
                             [&](Eigen::Index j) { return iterate.violated_side(j) != 0; });
}

}  // namespace

QuadraticSolution QuadraticSolver::solve(const QuadraticProgram& program) {
  if (sets_) return solve_from(program, warm_start(program, *sets_), true);
  if (options_.crash == Crash::none) return solve_from(program, slack_start(program), false);
  return solve_from(program, {program.column_count(), crash_basis(program).basics, {}}, true);
}

QuadraticSolution QuadraticSolver::solve_from(const QuadraticProgram& program, WorkingSet start, bool may_restart) {
  QuadraticSolution solution;
  try {
    QuadraticIterate iterate(program, std::move(start), options_.tolerance);
    find_feasible_point(iterate, pricing_, options_.tolerance, observer_);
    if (may_restart && leaves_variable_outside(iterate)) return solve_from(program, slack_start(program), false);
    solution.infeasibility = iterate.infeasibility();
    if (solution.infeasibility > 0.0) iterate.accept_violations();
    solution.multipliers = -PhaseTwo(iterate, pricing_, options_.tolerance, observer_).run();
    solution.step = iterate.variables();
    solution.status = solution.infeasibility > 0.0 ? QuadraticStatus::infeasible : QuadraticStatus::optimal;
    sets_ = iterate.sets();
  } catch (const Breakdown& reason) {
    sets_.reset();
    if (may_restart) return solve_from(program, slack_start(program), false);
    solution.status = QuadraticStatus::breakdown;
    solution.message = reason.what();
  } catch (const StoppedByObserver&) {
    solution.status = QuadraticStatus::stopped;
  }
  return solution;
}

}  // namespace dmocbench::sqp
