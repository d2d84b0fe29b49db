// Motions of several phases with free switching times: what DMOC and collocation keep across a switch.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/ranges.h>

#include "bench/claims/claim.hpp"

namespace dmocbench {

namespace {

Finding equal_across_switches(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double rounding = 1e-11;
  const Selection all = tables.rows("equivalence_phases").where("method", "hamiltonian");
  const Selection rows = all.usable();
  require(rows.group_by({"stages"}).size() > 1, "equivalence_phases.csv needs solved rows with two numbers of stages");
  double largest = 0.0;
  for (const char* column :
       {"configuration_difference", "momentum_difference", "control_difference", "objective_difference"}) {
    largest = std::max(largest, rows.max(column));
  }
  return found(largest < rounding, "{} grids of {}, largest relative difference of q, p, u and J: {:.0e}", rows.size(),
               fmt::join(rows.distinct("problem"), ", "),
               Measurement{"largest relative difference of q, p, u and J", largest})
      .also(worded("largest relative difference of the costates: {:.0e}",
                   Measurement{"largest relative difference of the costates", rows.max("costate_difference")}))
      .also(left_out(all, rows));
}

Finding momentum_across_impacts(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double rounding = 1e-13;
  const Selection rows = tables.rows("consistency_phases").usable();
  const auto largest = [&](const char* method) {
    const Selection of_method = rows.where("method", method);
    require(!of_method.empty(), "consistency_phases.csv has no solved row of {}", method);
    return Measurement{"momentum minus work over the whole trajectory", of_method.max("momentum_defect_total"), method};
  };
  const bool balances = largest("dmoc").value < rounding && largest("hamiltonian").value < rounding;
  const ClaimVerdict verdict = !balances                             ? ClaimVerdict::differs
                               : largest("tangent").value > rounding ? ClaimVerdict::reproduced
                                                                     : ClaimVerdict::undecided;
  return found(verdict,
               "momentum minus work over the whole trajectory: dmoc {:.0e}, hamiltonian {:.0e}, tangent {:.0e}",
               largest("dmoc"), largest("hamiltonian"), largest("tangent"));
}

Finding orders_with_free_times(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double tolerance = 0.2;
  const Selection rows = tables.rows("convergence_phases_slopes").where([](const Row& row) {
    return row.text("verdict") == "slope" && row.text("quantity") != "control" && row.text("quantity") != "replay";
  });
  require(rows.group_by({"stages"}).size() > 1, "convergence_phases_slopes.csv needs orders for two numbers of stages");
  const auto deviation = [](const Row& row) { return std::abs(row.needed("slope") - 2.0 * row.needed("stages")); };
  return found(rows.max(deviation) < tolerance, "{} orders of {} differ from 2s by at most {:.2f}", rows.size(),
               fmt::join(rows.distinct("problem"), ", "),
               Measurement{"largest distance of an order from 2s", rows.max(deviation)});
}

/// Of the state after an impact: the method's, and without it 1 where the energies of neighbouring steps lack the work
/// of the forces, 2 where half of their work is added.
double order_of_impact(const Row& impact) {
  const std::string& condition = impact.text("condition");
  if (impact.text("force") == "none" || condition == "momenta") return 2.0 * impact.needed("stages");
  return condition == "steps" ? 1.0 : 2.0;
}

Finding energy_at_impacts(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double rounding = 1e-12;
  constexpr double near = 0.2;
  const Selection orders = tables.rows("invariants_impacts_slopes").where("quantity", "state_error");
  const Selection kept = tables.rows("invariants_impacts").where("condition", "momenta");
  const auto in_words = [&](const char* force, const char* condition) {
    const Selection rows = orders.where("force", force).where("condition", condition);
    require(rows.group_by({"stages"}).size() > 1,
            "invariants_impacts_slopes.csv needs orders of {} with force {} for two numbers of stages", condition,
            force);
    return joined(rows, ", ", [](const Row& row) {
      return worded("{:.2f}", Measurement{"order of the state", row.needed("slope"), "dmoc", row.text("condition")});
    });
  };
  const ClaimVerdict of_orders =
      verdict_on_all(orders, [](const Row& row) { return verdict_on_order(row, order_of_impact(row), near); });
  return found(verdict_on_all({of_orders, verdict_on(kept.max("energy_change") < rounding)}),
               "orders with drag, s = 1, 2: energies of the steps {}, with half of the work {}, momenta {}",
               in_words("drag", "steps"), in_words("drag", "steps_and_work"), in_words("drag", "momenta"))
      .also(worded("without force: energies of the steps {}, momenta {}", in_words("none", "steps"),
                   in_words("none", "momenta")))
      .also(worded("with the impact law for momenta, the energy changes by at most {:.0e}",
                   Measurement{"largest change of energy at an impact", kept.max("energy_change")}));
}

}  // namespace

/// Phases.
Claims phase_claims() {
  const Problems phases{"phases"};
  return about(
      phases, Whose::extension,
      {{.id = "equal_solutions",
        .where = "section 1, hybrid systems; th:equi",
        .states = "across switches with free switching times, DMOC and Hamiltonian collocation have equal solutions",
        .judge = equal_across_switches,
        .evidence = {"equivalence_phases.csv"}},
       {.id = "momentum",
        .where = "section 1, nonsmooth integrators; eq:noether_force_d",
        .states = "across an impact whose guard has the symmetry, the change in momentum equals the work of the forces "
                  "for DMOC and Hamiltonian collocation, not for tangent-space collocation",
        .judge = momentum_across_impacts,
        .evidence = {"consistency_phases.csv"}},
       {.id = "orders",
        .where = "section 1, hybrid systems; main_theorem",
        .states = "with free switching times, states, momenta, costates and cost keep the order 2s",
        .judge = orders_with_free_times,
        .evidence = {"convergence_phases_slopes.csv"}},
       {.id = "energy_at_impacts",
        .where = "section 1, nonsmooth integrators",
        .states = "as soon as forces act, the condition of variational collision integrators, equal discrete energies "
                  "of the two steps next to an elastic impact, has order 1, and with half of the forces' work it has "
                  "order 2; the impact law for the Legendre-transformed momenta has order 2s and conserves the energy",
        .judge = energy_at_impacts,
        .condition = "without forces, equal energies of the steps are a correct condition, of order 2s",
        .evidence = {"invariants_impacts.csv", "invariants_impacts_slopes.csv"}}});
}

}  // namespace dmocbench
