// Energy and modified energy, without forces and against their work along optimal motions.
#include <algorithm>
#include <limits>

#include "bench/claims/claim.hpp"

namespace dmocbench {

namespace {

constexpr const char* in_paper = "section 3.3, Conservation of a Modified Energy";
const std::vector<std::string> truncations{"2", "4", "6"};

/// Slopes of the truncations 2, 4 and 6 of a quantity, by their texts.
Selection of_truncations(const Selection& slopes, const std::string& quantity, std::string_view table) {
  Selection rows;
  for (const std::string& truncation : truncations) {
    const Selection found = slopes.where("quantity", quantity).where("truncation", truncation);
    require(!found.empty(), "{}.csv has no slope of {} for truncation {}", table, quantity, truncation);
    rows.append(found);
  }
  return rows;
}

ClaimVerdict has_order_of_its_truncation(const Row& row) { return verdict_on_order(row, row.needed("truncation")); }

Words slope_in_words(const Row& row) {
  return worded("{:.2f}", Measurement{"slope of " + row.text("quantity"), row.needed("slope"), row.text("method"),
                                      fmt::format("{}, truncation {}", row.text("problem"), row.text("truncation"))});
}

Finding gap_beside_tangent(const ResultTables& tables, const std::string& problem) {
  const Selection rows = tables.rows("invariants_energy_work", problem);
  const Selection dmoc = rows.where("method", "dmoc");
  std::vector<Measurement> ratios;
  for (const Row& row : dmoc) {
    const Selection other = rows.where("method", "tangent").matching(row, {"intervals"});
    require(!other.empty(), "invariants_energy_work.csv has no row of tangent with {} intervals",
            row.text("intervals"));
    ratios.push_back({"ratio of the largest gaps (tangent to DMOC)", quotient(other.front(), row, "largest_gap"),
                      "tangent", "N = " + row.text("intervals")});
  }
  require(dmoc.size() > 1, "invariants_energy_work.csv has {} rows of dmoc for {}; two are needed", dmoc.size(),
          problem);
  const auto [least, most] = std::ranges::minmax(ratios, {}, &Measurement::value);
  return found(verdict_on_interval(least.value, most.value, 1.0, std::numeric_limits<double>::infinity()),
               "largest |change of energy - work|: the ratio of tangent to DMOC on {} grids lies between {:.2f} ({}) "
               "and {:.2f} ({})",
               dmoc.size(), least, least.at, most, most.at);
}

Finding drifts_by_orders_2_4_6(const ResultTables& tables, const std::string& /*problem*/) {
  const char* const table = "invariants_modified_energy_slopes";
  const Selection slopes = of_truncations(tables.rows(table), "drift", table);
  const Selection structured = slopes.where([](const Row& row) { return row.text("method") != "tangent"; });
  // With a constant mass tangent-space collocation is the same rule.
  const Selection tangent = slopes.where("method", "tangent").where("mass", "moving");
  require(!structured.empty() && !tangent.empty(),
          "{}.csv needs rows of dmoc and of tangent with a mass matrix that depends on q", table);
  const auto stays_at_2 = [](const Row& row) { return verdict_on_order(row, 2.0); };
  return found(verdict_on_all(
                   {verdict_on_all(structured, has_order_of_its_truncation), verdict_on_all(tangent, stays_at_2)}),
               "slopes of the drift, DMOC and Hamiltonian on {} systems: {}", structured.group_by({"problem"}).size(),
               joined(structured, ", ", slope_in_words))
      .also(worded("tangent-space collocation with a mass matrix that depends on q: {}",
                   joined(tangent, ", ", slope_in_words)));
}

Finding balances_modified_work(const ResultTables& tables, const std::string& problem) {
  const char* const table = "invariants_energy_work_slopes";
  const Selection dmoc = tables.rows(table, problem).where("method", "dmoc");
  const Selection modified = of_truncations(dmoc, "gap_to_modified_work", table);
  const Selection plain = of_truncations(dmoc, "gap_to_work", table);
  return found(verdict_on_all(modified, has_order_of_its_truncation), "slopes of the gap to the modified work: {}",
               joined(modified, ", ", slope_in_words))
      .also(worded("slopes of the gap to the virtual work: {}", joined(plain, ", ", slope_in_words)));
}

}  // namespace

/// Energies against work along optimal motions.
Claims energy_claims() {
  return {{.id = "energy_against_work",
           .where = in_paper,
           .states = "along the optimal trajectory, the energy change of DMOC differs less from the virtual work than "
                     "the energy change of tangent-space collocation",
           .judge = gap_beside_tangent,
           .condition = "both gaps are of order h^2, and their factors depend on the trajectory",
           .evidence = {"invariants_energy_work.csv", "figures/{}_energy_work.svg"}},
          {.id = "modified_energy_and_work",
           .where = in_paper,
           .states = "along optimal trajectories, H, H + h^2 H_2 and H + h^2 H_2 + h^4 H_4 of the midpoint rule change "
                     "by the modified work up to errors of order h^2, h^4 and h^6",
           .judge = balances_modified_work,
           .condition = "the work must be modified as well, by terms that vanish with the force: compared with the "
                        "virtual work alone, every truncation keeps a gap of order 2",
           .evidence = {"invariants_energy_work_slopes.csv", "figures/{}_energy_work.svg"}}};
}

/// The modified energy without forces.
Claims modified_energy_claims() {
  return {{.id = "modified_energy_by_orders",
           .problems = simulated,
           .where = in_paper,
           .whose = Whose::paper,
           .states = "a certain modified energy is conserved: without forces, H, H + h^2 H_2 and H + h^2 H_2 + h^4 H_4 "
                     "of the midpoint rule drift with orders 2, 4 and 6; tangent-space collocation has no such energy "
                     "if the mass matrix depends on q",
           .judge = drifts_by_orders_2_4_6,
           .condition = "the paper refers to backward error analysis of symplectic methods and gives no formula; here "
                        "the modified energy of the midpoint rule is truncated",
           .evidence = {"invariants_modified_energy_slopes.csv", "figures/radial_thrust_modified_energy.svg"}}};
}

}  // namespace dmocbench
