#include "methods/solvers/sqp/quadratic/phases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "methods/solvers/sqp/quadratic/ratio_test.hpp"
#include "methods/solvers/sqp/quadratic/reduced_hessian.hpp"

namespace dmocbench::sqp {

namespace {

/// The columns that may move and thereby lower the objective, without the basic and (if `but_superbasics`) the
/// superbasic ones. `rates` (n + m entries): the rates of change of the objective.
std::vector<PricedColumn> candidates_of(const Iterate& iterate, const Eigen::VectorXd& rates, double tolerance,
                                        bool but_superbasics) {
  std::vector<PricedColumn> candidates;
  const WorkingSet& sets = iterate.sets();
  for (Eigen::Index j = 0; j < rates.size(); ++j) {
    const WorkingSet::Membership membership = sets.of(j);
    if (membership == WorkingSet::Membership::basic) continue;
    if (but_superbasics && membership == WorkingSet::Membership::superbasic) continue;
    const double value = iterate.values()[j];
    const bool can_rise = value < iterate.upper()[j];
    const bool can_fall = value > iterate.lower()[j];
    if ((rates[j] < -tolerance && can_rise) || (rates[j] > tolerance && can_fall)) candidates.push_back({j, rates[j]});
  }
  return candidates;
}

/// How far the columns `moving` may follow `change` (n + m entries).
RatioTest ratio_test(const Iterate& iterate, const std::vector<Eigen::Index>& moving, const Eigen::VectorXd& change,
                     double limit) {
  std::vector<MovingColumn> columns;
  columns.reserve(moving.size());
  for (const Eigen::Index j : moving) {
    columns.push_back({iterate.values()[j], change[j], iterate.lower()[j], iterate.upper()[j]});
  }
  return ratio_test(columns, limit, iterate.tolerance());
}

/// Tells the observer; throws `Stopped`.
void report(const Iterate& iterate, MinorIteration minor, const MinorObserver& observer) {
  const WorkingSet& sets = iterate.sets();
  minor.infeasibility = iterate.infeasibility();
  minor.objective = iterate.objective();
  minor.superbasics = static_cast<Eigen::Index>(sets.superbasics().size());
  minor.basic_slacks = std::count_if(sets.basics().begin(), sets.basics().end(),
                                     [&](Eigen::Index j) { return j >= iterate.program().variable_count(); });
  if (!observer(minor)) throw Stopped{};
}

/// The rate of change of the sum of infeasibilities with each basic column: -1, 0 or 1.
Eigen::VectorXd infeasibility_rates(const Iterate& iterate) {
  const std::vector<Eigen::Index>& basics = iterate.sets().basics();
  Eigen::VectorXd rates(static_cast<Eigen::Index>(basics.size()));
  for (std::size_t position = 0; position < basics.size(); ++position) {
    const Eigen::Index j = basics[position];
    const double value = iterate.values()[j];
    const bool below = value < iterate.lower()[j] - iterate.tolerance();
    const bool above = value > iterate.upper()[j] + iterate.tolerance();
    rates[static_cast<Eigen::Index>(position)] = below ? -1.0 : above ? 1.0 : 0.0;
  }
  return rates;
}

/// Moves `entering` and the basic columns with it until one of them is stopped by a bound, and exchanges the two.
void take_step(Iterate& iterate, const PricedColumn& entering, const MinorObserver& observer) {
  const QuadraticProgram& program = iterate.program();
  const std::vector<Eigen::Index>& basics = iterate.sets().basics();
  const double direction = entering.rate < 0.0 ? 1.0 : -1.0;
  const Eigen::VectorXd solved = iterate.basis().solve(program.column(entering.column));

  Eigen::VectorXd change = Eigen::VectorXd::Zero(program.column_count());
  change[entering.column] = direction;
  for (std::size_t position = 0; position < basics.size(); ++position) {
    change[basics[position]] = -direction * solved[static_cast<Eigen::Index>(position)];
  }
  std::vector<Eigen::Index> moving = basics;
  moving.push_back(entering.column);  // it may reach its own other bound
  const RatioTest test = ratio_test(iterate, moving, change, std::numeric_limits<double>::infinity());
  if (!test.blocking) throw Breakdown("no row stops a column that lowers the infeasibility");

  const Eigen::Index leaving = moving[*test.blocking];
  const bool crosses = leaving == entering.column;
  const bool from_below = iterate.values()[leaving] < iterate.lower()[leaving] - iterate.tolerance();
  const bool from_above = iterate.values()[leaving] > iterate.upper()[leaving] + iterate.tolerance();
  iterate.move(change, test.step);
  iterate.put_on_bound(leaving, from_above || (change[leaving] > 0.0 && !from_below));
  if (!crosses) {
    iterate.replace_basic(static_cast<Eigen::Index>(*test.blocking), entering.column, solved);
  } else if (iterate.sets().of(leaving) == WorkingSet::Membership::superbasic) {
    const auto& superbasics = iterate.sets().superbasics();
    iterate.drop_superbasic(std::find(superbasics.begin(), superbasics.end(), leaving) - superbasics.begin());
  }
  report(iterate,
         {.phase = MinorIteration::Phase::feasibility,
          .entering = entering.column,
          .leaving = leaving,
          .into_basis = {},
          .step = test.step},
         observer);
}

/// The state of phase 2 between two minor iterations.
class PhaseTwo {
 public:
  PhaseTwo(Iterate& iterate, Pricing& pricing, double tolerance, const MinorObserver& observer)
      : iterate_(iterate), pricing_(pricing), tolerance_(tolerance), observer_(observer) {
    start();
  }

  Eigen::VectorXd run() {
    bool stationary = largest_rate_of_superbasics() <= tolerance();
    while (true) {
      std::optional<Eigen::Index> entering;
      if (stationary) {
        const auto candidates = candidates_of(iterate_, rates_, tolerance(), true);
        if (candidates.empty()) return multipliers_;
        entering = pricing_.choose(candidates).column;
        add_superbasic(*entering);
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
    gradient.head(program().variable_count()) = program().gradient + program().hessian->times(iterate_.variables());
    multipliers_ = iterate_.basis().solve_transposed(iterate_.at_basics(gradient));
    rates_ = gradient - program().transposed_times(multipliers_);
  }

  [[nodiscard]] double largest_rate_of_superbasics() const {
    const Eigen::VectorXd rates = iterate_.at_superbasics(rates_);
    return rates.size() > 0 ? rates.lpNorm<Eigen::Infinity>() : 0.0;
  }

  void add_superbasic(Eigen::Index column) {
    iterate_.make_superbasic(column);
    if (border()) return;
    // An ill-conditioned basis may look like negative curvature: try a better basis among the same columns.
    rebuild();
  }

  /// Borders the reduced Hessian by the superbasic column that joined last.
  [[nodiscard]] bool border() {
    const auto count = static_cast<Eigen::Index>(iterate_.sets().superbasics().size());
    const Eigen::VectorXd direction = iterate_.null_space_times(Eigen::VectorXd::Unit(count, count - 1));
    const Eigen::VectorXd curved = program().hessian->times(direction.head(program().variable_count()));
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
    const Eigen::VectorXd change = iterate_.null_space_times(-reduced_.solve(iterate_.at_superbasics(rates_)));
    std::vector<Eigen::Index> moving = iterate_.sets().basics();
    const auto basic_count = moving.size();
    moving.insert(moving.end(), iterate_.sets().superbasics().begin(), iterate_.sets().superbasics().end());
    constexpr double whole = 1.0;
    const RatioTest test = ratio_test(iterate_, moving, change, whole);
    iterate_.move(change, test.step);
    MinorIteration minor{.phase = MinorIteration::Phase::optimality,
                         .entering = entering,
                         .leaving = {},
                         .into_basis = {},
                         .step = test.step};
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
    const Eigen::VectorXd weights = iterate_.at_superbasics(program().transposed_times(row));
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
      iterate_.move(iterate_.null_space_times(-reduced_.solve(iterate_.at_superbasics(rates_))), 1.0);
      compute_rates();
    }
  }

  Iterate& iterate_;
  ReducedHessian reduced_;
  Pricing& pricing_;
  double tolerance_;
  const MinorObserver& observer_;
  Eigen::VectorXd multipliers_;
  Eigen::VectorXd rates_;
};

}  // namespace

void find_feasible_point(Iterate& iterate, Pricing& pricing, double tolerance, const MinorObserver& observer) {
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

Eigen::VectorXd find_minimiser(Iterate& iterate, Pricing& pricing, double tolerance, const MinorObserver& observer) {
  return PhaseTwo(iterate, pricing, tolerance, observer).run();
}

}  // namespace dmocbench::sqp
