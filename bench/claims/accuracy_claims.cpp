// Whether the system responds to the forces as computed (section 1: "minimal effort is only meaningful if ..."), and
// the rounding errors that staying on Q x Q costs.
#include <algorithm>
#include <cmath>

#include "bench/claims/claim.hpp"
#include "bench/run/solve_case.hpp"

namespace dmocbench {

namespace {

/// The error that the controls of DMOC leave when they are integrated on the continuous equations, over the error of
/// tangent-space collocation. Both are of order h^2, so that their ratio has a limit: it is judged where the ratio is
/// settled, on the grids from which on it is near the finest one's, and at least on the two finest.
Finding replay_beside_tangent(const ResultTables& tables, const std::string& problem) {
  constexpr double settled = 0.01;
  const Selection rows = tables.rows("convergence", problem);
  const Selection all = midpoint(rows, "dmoc");
  Selection used;
  std::vector<Measurement> ratios;
  for (const Row& row : all.usable().sorted_by("intervals")) {
    const Selection tangent = midpoint(rows, "tangent").usable().matching(row, {"intervals"});
    if (tangent.empty()) continue;
    ratios.push_back({"ratio of replay errors (DMOC to tangent-space collocation)",
                      quotient(row, tangent.front(), "replay_error"), "dmoc", "N = " + row.text("intervals")});
    used.append(row);
  }
  require(used.size() > 1, "convergence.csv has {} grids of {} solved by dmoc and tangent; two are needed", used.size(),
          problem);
  const double finest = ratios.back().value;
  const auto is_unsettled = [&](const Measurement& ratio) { return std::abs(ratio.value / finest - 1.0) > settled; };
  const auto first = std::find_if(ratios.rbegin(), ratios.rend(), is_unsettled).base();
  const Row& coarsest = *(used.begin() + (first - ratios.begin()));
  const auto [least, most] =
      std::ranges::minmax_element(std::min(first, ratios.end() - 2), ratios.end(), {}, &Measurement::value);
  const auto [least_of_all, most_of_all] = std::ranges::minmax(ratios, {}, &Measurement::value);
  return found(verdict_on_interval(least->value, most->value, 0.0, 1.0),
               "ratio of replay errors (DMOC to tangent-space collocation): {:.3f} on the finest grid (N = {}), and "
               "within 1 % of this value from N = {} on",
               ratios.back(), used.back().text("intervals"), coarsest.text("intervals"))
      .also(worded("on all {} grids from N = {} on, the ratio lies between {:.3f} ({}) and {:.3f} ({})", used.size(),
                   used.front().text("intervals"), least_of_all, least_of_all.at, most_of_all, most_of_all.at))
      .also(left_out(all, used, "not solved by both methods, which favours"));
}

/// The momentum balance at the level of rounding, on the finest grid that both methods solve.
Finding rounding_floor(const ResultTables& tables, const std::string& problem) {
  const Selection rows = tables.rows("consistency", problem).where(is_midpoint).usable();
  for (const Row& row : rows) static_cast<void>(row.needed("tolerance"));
  const Selection tightest = rows.where("tolerance", rows.sorted_by("tolerance").front().text("tolerance"));
  const Selection dmoc = tightest.where("method", "dmoc").sorted_by("intervals");
  Selection finest;
  for (const Row& row : dmoc) {
    const Selection same = tightest.where("method", "hamiltonian").matching(row, {"intervals"});
    if (same.empty()) continue;
    finest = Selection();
    finest.append(row);
    finest.append(same.front());
  }
  require(!finest.empty(), "consistency.csv has no grid of {} solved by dmoc and hamiltonian to a stated tolerance",
          problem);
  return found(ClaimVerdict::measured,
               "largest defect of the momentum balance at N = {}: dmoc {:.1e}, hamiltonian {:.1e}, ratio {:.1f}",
               finest.front().text("intervals"),
               Measurement{"largest defect of an interval", finest.front().needed("momentum_defect_max"), "dmoc"},
               Measurement{"largest defect of an interval", finest.back().needed("momentum_defect_max"), "hamiltonian"},
               Measurement{"ratio of the defects", quotient(finest.front(), finest.back(), "momentum_defect_max")});
}

/// The sample in which Ipopt is the referee of interior_point: the same programs by both.
Finding interior_point_beside_ipopt(const ResultTables& tables, const std::string& problem) {
  const Selection by_ipopt = tables.rows("convergence", problem).where(is_midpoint).where("solver", "ipopt");
  const Selection ours =
      tables.rows("convergence_stages", problem).where(is_midpoint).where("solver", "interior_point");
  double largest = 0.0;
  std::size_t compared = 0;
  for (const Row& row : ours) {
    const Selection partner = by_ipopt.matching(row, {"method", "intervals"});
    if (partner.empty() || !is_usable(row) || !is_usable(partner.front())) continue;
    largest = std::max(largest, std::abs(quotient(row, partner.front(), "objective") - 1.0));
    ++compared;
  }
  require(compared > 1,
          "convergence.csv and convergence_stages.csv have {} programs of {} solved by both solvers; two are needed",
          compared, problem);
  constexpr double equal = 1e-9;
  return found(largest < equal,
               "costs of {} programs from interior_point and Ipopt have relative differences of at most {:.0e}",
               compared, Measurement{"largest relative difference of the costs", largest});
}

}  // namespace

/// Claims about replay errors and rounding.
Claims accuracy_claims() {
  return {
      {.id = "replay_beside_tangent",
       .where = "section 1",
       .states = "in the limit of fine grids, DMOC's controls, replayed on the continuous equations, miss the final "
                 "state by less than the controls of tangent-space collocation",
       .judge = replay_beside_tangent,
       .condition = "the paper motivates DMOC with the control effort, which is meaningful only if the system responds "
                    "to the forces as computed; it does not compare responses; controls are constant over an interval; "
                    "on coarse grids either method may have the smaller error",
       .cause = "the discrete momentum balance does not bound the error of the trajectory: the errors of both methods "
                "are of order h^2, with constants that depend on the trajectory",
       .evidence = {"convergence.csv"},
       .headline = true},
      {.id = "rounding_floor",
       .where = "section 3.3, Implementation",
       .states = "round-off in the momentum balance of DMOC, whose states lie in Q x Q, on the finest grid",
       .judge = rounding_floor,
       .condition = "DMOC's momenta are differences of positions divided by h, so their round-off grows as 1/h",
       .evidence = {"consistency.csv", "figures/{}_momentum.svg"},
       .has_verdict = false},
      {.id = "interior_point_beside_ipopt",
       .where = "section 4.1, SQP Method",
       .states = "interior_point, the solver where none are compared, finds the same minima as Ipopt",
       .judge = interior_point_beside_ipopt,
       .condition =
           "warm starts from a common trajectory; the solutions of both solvers are refined by Newton steps, so "
           "the claim concerns the branch, not the digits",
       .evidence = {"convergence.csv", "convergence_stages.csv"}}};
}

}  // namespace dmocbench
