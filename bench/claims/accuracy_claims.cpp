// Whether the system responds to the forces as computed (section 1: "minimal effort is only meaningful if ..."), and
// what staying on Q x Q costs in rounding.
#include <cmath>

#include "bench/claims/claim.hpp"
#include "bench/run/solve_case.hpp"

namespace dmocbench {

namespace {

/// A larger error than that times the other is worse.
constexpr double worse = 1.05;
/// Rounding that is larger than that times the other is a price.
constexpr double a_price = 10.0;

/// The controls of DMOC, integrated on the continuous equations, miss the final state by no more than those of
/// tangent-space collocation, on every grid.
Finding replay_beside_tangent(const ResultTables& tables, const std::string& problem) {
  const Selection rows = tables.rows("convergence", problem);
  const Selection all = midpoint(rows, "dmoc");
  Selection used;
  std::vector<std::string> ratios;
  double largest = 0.0;
  for (const Row& row : all.usable()) {
    const Selection tangent = midpoint(rows, "tangent").usable().matching(row, {"intervals"});
    if (tangent.empty()) continue;
    const double ratio = quotient(row, tangent.front(), "replay_error");
    largest = std::max(largest, ratio);
    ratios.push_back(fmt::format("{:.3f}", ratio));
    used.append(row);
  }
  require(used.size() > 1, "convergence.csv has less than two grids of {} solved by dmoc and tangent", problem);
  return found(largest < worse, "replay error of dmoc to that of tangent, N = {} to {}: {}{}",
               used.front().text("intervals"), used.back().text("intervals"), fmt::join(ratios, ", "),
               left_out(all, used, "not solved by both, in favour of"));
}

/// What rounding leaves of the momentum balance on the finest grid.
Finding rounding_floor(const ResultTables& tables, const std::string& problem) {
  const Selection rows = tables.rows("consistency", problem).where(is_midpoint).usable();
  for (const Row& row : rows) static_cast<void>(row.needed("tolerance"));
  const Selection tightest = rows.where("tolerance", rows.sorted_by("tolerance").front().text("tolerance"));
  const auto finest = [&](const char* method) {
    const Selection of_method = tightest.where("method", method).sorted_by("intervals");
    require(!of_method.empty(), "consistency.csv has no solved row of {} by {} with a tolerance", problem, method);
    return of_method.back();
  };
  const Row dmoc = finest("dmoc");
  const Row hamiltonian = finest("hamiltonian");
  const double ratio = quotient(dmoc, hamiltonian, "momentum_defect_max");
  return found(
      ratio < a_price, "rounding of the momentum balance at N = {}: dmoc {:.1e}, hamiltonian {:.1e}, {:.0f} times",
      dmoc.text("intervals"), dmoc.needed("momentum_defect_max"), hamiltonian.needed("momentum_defect_max"), ratio);
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
    if (partner.empty()) continue;
    require(is_usable(row) && is_usable(partner.front()), "{} and {}: not solved by both", row.place(),
            partner.front().place());
    largest = std::max(largest, std::abs(quotient(row, partner.front(), "objective") - 1.0));
    ++compared;
  }
  require(compared > 1, "convergence.csv and convergence_stages.csv have less than two programs of {} by both solvers",
          problem);
  constexpr double equal = 1e-9;
  return found(largest < equal,
               "costs of {} programs by interior_point and by Ipopt differ by at most {:.0e}, relative", compared,
               largest);
}

}  // namespace

/// Replay, and what rounding costs.
Claims accuracy_claims() {
  return {{.id = "replay_beside_tangent",
           .where = "section 1",
           .whose = Whose::remark,
           .states =
               "effort is meaningful only if the system responds exactly to the forces as computed: DMOC's does so at "
               "least as exactly as that of tangent-space collocation",
           .judge = replay_beside_tangent,
           .condition = "the controls are constant over an interval and integrated on the continuous equations",
           .cause = "the momentum balance of the discrete system says nothing about the error of its motion",
           .evidence = {"convergence.csv"}},
          {.id = "rounding_floor",
           .where = "section 3.3, Implementation",
           .states = "staying on Q x Q costs no digits",
           .judge = rounding_floor,
           .cause = "DMOC's momenta are differences of positions divided by h, so that rounding grows as 1/h",
           .evidence = {"consistency.csv", "figures/{}_momentum.svg"}},
          {.id = "interior_point_beside_ipopt",
           .where = "section 4.1, SQP Method",
           .states = "interior_point, which solves where the solver is not the question, has the answers of Ipopt",
           .judge = interior_point_beside_ipopt,
           .condition = "warm, from a common start; the answers of both are refined by Newton steps",
           .evidence = {"convergence.csv", "convergence_stages.csv"}}};
}

}  // namespace dmocbench
