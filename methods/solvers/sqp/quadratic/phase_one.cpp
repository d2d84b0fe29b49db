#include <algorithm>
#include <limits>

#include "methods/solvers/sqp/quadratic/phases.hpp"
#include "methods/solvers/sqp/quadratic/ratio_test.hpp"

namespace dmocbench::sqp {

namespace {

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
  moving.push_back(entering.column);  // it may run into its own other bound
  std::vector<MovingColumn> columns;
  columns.reserve(moving.size());
  for (const Eigen::Index j : moving) {
    columns.push_back({iterate.values()[j], change[j], iterate.lower()[j], iterate.upper()[j]});
  }
  const RatioTest test = ratio_test(columns, std::numeric_limits<double>::infinity(), iterate.tolerance());
  if (!test.blocking) throw Breakdown("no row stops a column that lowers the infeasibility");

  const Eigen::Index leaving = moving[*test.blocking];
  const bool crosses = leaving == entering.column;
  const bool from_below = iterate.values()[leaving] < iterate.lower()[leaving] - iterate.tolerance();
  const bool from_above = iterate.values()[leaving] > iterate.upper()[leaving] + iterate.tolerance();
  iterate.move(change, test.step);
  iterate.settle(leaving, from_above || (change[leaving] > 0.0 && !from_below));
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

}  // namespace dmocbench::sqp
