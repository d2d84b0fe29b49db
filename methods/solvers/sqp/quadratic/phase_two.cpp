#include <algorithm>
#include <cmath>
#include <limits>

#include "methods/solvers/sqp/quadratic/null_space.hpp"
#include "methods/solvers/sqp/quadratic/phases.hpp"
#include "methods/solvers/sqp/quadratic/ratio_test.hpp"

namespace dmocbench::sqp {

namespace {

/// The state of phase 2 between two minor iterations.
class PhaseTwo {
 public:
  PhaseTwo(Iterate& iterate, ReducedHessian& reduced, Pricing& pricing, double tolerance, const MinorObserver& observer)
      : iterate_(iterate), reduced_(reduced), pricing_(pricing), tolerance_(tolerance), observer_(observer) {
    compute_rates();
  }

  Eigen::VectorXd run() {
    bool stationary = largest_rate_of_superbasics() <= allowed();
    while (true) {
      std::optional<Eigen::Index> entering;
      if (stationary) {
        const auto candidates = candidates_of(iterate_, rates_, allowed(), true);
        if (candidates.empty()) return multipliers_;
        entering = pricing_.choose(candidates).column;
        add_superbasic(*entering);
      }
      stationary = take_step(entering);
    }
  }

 private:
  [[nodiscard]] const QuadraticProgram& program() const { return iterate_.program(); }

  /// Scaled as the convergence test of the whole is: a quadratic program solved less accurately than that would stall
  /// it.
  [[nodiscard]] double allowed() const {
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
    // An ill-conditioned basis may look like negative curvature: the same columns with a better basis among them.
    rebuild();
  }

  /// Borders the reduced Hessian by the superbasic column that joined last.
  [[nodiscard]] bool border() {
    const auto count = static_cast<Eigen::Index>(iterate_.sets().superbasics().size());
    const Eigen::VectorXd direction = null_space_times(iterate_, Eigen::VectorXd::Unit(count, count - 1));
    const Eigen::VectorXd curved = program().hessian->times(direction.head(program().variable_count()));
    const Eigen::VectorXd entries = null_space_transposed_times(iterate_, curved);
    return reduced_.append(entries.head(count - 1), entries[count - 1]);
  }

  void rebuild() {
    iterate_.choose_basis_again();
    if (!reduced_.assign(reduced_matrix(iterate_))) not_convex();
    compute_rates();
  }

  [[noreturn]] static void not_convex() { throw Breakdown("the reduced Hessian is not positive definite"); }

  /// One minor iteration; true if the point is stationary on the sets afterwards, as it is after a whole step.
  bool take_step(std::optional<Eigen::Index> entering) {
    const Eigen::VectorXd change = null_space_times(iterate_, -reduced_.solve(iterate_.at_superbasics(rates_)));
    std::vector<Eigen::Index> moving = iterate_.sets().basics();
    const auto basic_count = moving.size();
    moving.insert(moving.end(), iterate_.sets().superbasics().begin(), iterate_.sets().superbasics().end());
    std::vector<MovingColumn> columns;
    columns.reserve(moving.size());
    for (const Eigen::Index j : moving) {
      columns.push_back({iterate_.values()[j], change[j], iterate_.lower()[j], iterate_.upper()[j]});
    }
    constexpr double whole = 1.0;
    const RatioTest test = ratio_test(columns, whole, iterate_.tolerance());
    iterate_.move(change, test.step);
    MinorIteration minor{.phase = MinorIteration::Phase::optimality,
                         .entering = entering,
                         .leaving = {},
                         .into_basis = {},
                         .step = test.step};
    if (test.blocking) {
      minor.leaving = moving[*test.blocking];
      iterate_.settle(*minor.leaving, change[*minor.leaving] > 0.0);
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
    return !test.blocking || largest_rate_of_superbasics() <= allowed();
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

  /// Rounding of an ill-conditioned reduced Hessian leaves the step a little short; the rest belongs to the same step.
  void refine() {
    constexpr int most = 3;
    for (int i = 0; i < most && largest_rate_of_superbasics() > 0.1 * allowed(); ++i) {
      iterate_.move(null_space_times(iterate_, -reduced_.solve(iterate_.at_superbasics(rates_))), 1.0);
      compute_rates();
    }
  }

  Iterate& iterate_;
  ReducedHessian& reduced_;
  Pricing& pricing_;
  double tolerance_;
  const MinorObserver& observer_;
  Eigen::VectorXd multipliers_;
  Eigen::VectorXd rates_;
};

}  // namespace

Eigen::VectorXd find_minimiser(Iterate& iterate, ReducedHessian& reduced, Pricing& pricing, double tolerance,
                               const MinorObserver& observer) {
  return PhaseTwo(iterate, reduced, pricing, tolerance, observer).run();
}

}  // namespace dmocbench::sqp
