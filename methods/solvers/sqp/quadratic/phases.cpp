#include "methods/solvers/sqp/quadratic/phases.hpp"

#include <algorithm>

namespace dmocbench::sqp {

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

void report(const Iterate& iterate, MinorIteration minor, const MinorObserver& observer) {
  const WorkingSet& sets = iterate.sets();
  minor.infeasibility = iterate.infeasibility();
  minor.objective = iterate.objective();
  minor.superbasics = static_cast<Eigen::Index>(sets.superbasics().size());
  minor.basic_slacks = std::count_if(sets.basics().begin(), sets.basics().end(),
                                     [&](Eigen::Index j) { return j >= iterate.program().variable_count(); });
  if (!observer(minor)) throw Stopped{};
}

}  // namespace dmocbench::sqp
