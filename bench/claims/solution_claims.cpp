// Momentum-force consistency "to numerical accuracy", and which methods have equal solutions.
#include <cmath>
#include <utility>

#include "bench/claims/claim.hpp"

namespace dmocbench {

namespace {

/// Rounding of a momentum difference, relative to the work of the forces over one interval or absolute.
constexpr double rounding_of_balance = 1e-11;
/// Tangent-space collocation has to miss the balance by this factor on the coarsest grid to "fail to capture" it.
constexpr double clearly_larger = 1e3;

constexpr double equal_solutions_tolerance = 1e-9;
constexpr double equal_costates_tolerance = 1e-8;
constexpr double foreign_rows_tolerance = 1e-10;

Finding momentum_consistency(const ResultTables& tables, const std::string& problem) {
  const Selection all = tables.rows("consistency", problem).where(is_midpoint);
  const Selection rows = all.usable();
  const Selection dmoc = rows.where("method", "dmoc");
  const Selection hamiltonian = rows.where("method", "hamiltonian");
  const Selection tangent = rows.where("method", "tangent");
  require(!dmoc.empty() && !hamiltonian.empty() && !tangent.empty(),
          "consistency.csv has {}, {} and {} solved rows of {} by dmoc, hamiltonian and tangent; all are needed",
          dmoc.size(), hamiltonian.size(), tangent.size(), problem);
  const auto defect = [](const Row& row) { return row.needed("momentum_defect_max"); };
  const auto relative_defect = [&](const Row& row) { return defect(row) / std::max(1.0, row.needed("largest_force")); };
  const double structured = std::max(dmoc.max(relative_defect), hamiltonian.max(relative_defect));
  const double rounding = std::max(defect(dmoc.front()), rounding_of_balance * 1e-3);
  return found(
      all.are_usable() && structured < rounding_of_balance && defect(tangent.front()) > clearly_larger * rounding,
      "largest defect of an interval over all N: dmoc {:.1e}, hamiltonian {:.1e}; tangent {:.1e} at N = {} to "
      "{:.1e} at N = {}{}",
      dmoc.max(defect), hamiltonian.max(defect), defect(tangent.front()), tangent.front().text("intervals"),
      defect(tangent.back()), tangent.back().text("intervals"), left_out(all, rows));
}

bool is_answer_of_dmoc(const Row& row) {
  const auto leaves_rounding = [&](const char* violation, const char* rounding) {
    return row.needed(violation) < std::max(foreign_rows_tolerance, row.needed(rounding));
  };
  return leaves_rounding("violation_in_rows_of_dmoc", "rounding_in_rows_of_dmoc") &&
         leaves_rounding("violation_of_dmoc_here", "rounding_here");
}

/// The largest differences from DMOC, relative to each quantity's largest value.
struct Differences {
  std::string words;  ///< by quantity
  double primal = 0.0;
  double costates = 0.0;

  explicit Differences(const Selection& rows) : costates(rows.max("costate_difference")) {
    for (const auto& [column, symbol] :
         {std::pair{"configuration_difference", "q"}, std::pair{"momentum_difference", "p"},
          std::pair{"control_difference", "u"}, std::pair{"objective_difference", "J"}}) {
      const double difference = rows.max(column);
      words += fmt::format("{}{} {:.0e}", words.empty() ? "" : ", ", symbol, difference);
      primal = std::max(primal, difference);
    }
  }
  [[nodiscard]] bool are_rounding() const {
    return primal < equal_solutions_tolerance && costates < equal_costates_tolerance;
  }
};

Finding equal_solutions(const ResultTables& tables, const std::string& problem) {
  const Selection all = tables.rows("equivalence", problem).where("method", "hamiltonian");
  const Selection rows = all.usable();
  require(!rows.empty(), "equivalence.csv has no solved row of {} by hamiltonian", problem);
  const bool rows_agree = std::ranges::all_of(rows, is_answer_of_dmoc);
  const Differences largest(rows);
  return found(largest.are_rounding() && rows_agree && all.are_usable(),
               "{} grids with {} tableaus, largest relative difference: {}, costates {:.0e}; answers in the other's "
               "rows leave {}{}",
               rows.size(), rows.group_by({"tableau", "stages"}).size(), largest.words, largest.costates,
               rows_agree ? "rounding" : "more than rounding", left_out(all, rows));
}

Finding tangent_differs(const ResultTables& tables, const std::string& problem) {
  const Selection all = midpoint(tables.rows("equivalence", problem), "tangent");
  const Selection rows = all.usable();
  require(rows.size() > 1, "equivalence.csv has less than two solved grids of {} by tangent", problem);
  const double coarse = rows.front().needed("configuration_difference");
  const double fine = rows.back().needed("configuration_difference");
  const Selection slopes = tables.rows("equivalence_slopes", problem).where("tableau", "gauss");
  const Selection orders = slopes.where("verdict", "slope");
  const auto is_twice_the_stages = [](const Row& row) { return has_order(row, 2.0 * row.number("stages", 0.0)); };
  const auto words = [](const Row& row) {
    return fmt::format("s = {}: {:.2f}", row.text("stages"), row.needed("slope"));
  };
  return found(
      !orders.empty() && std::ranges::all_of(orders, is_twice_the_stages) && fine > equal_solutions_tolerance / 10.0 &&
          coarse > clearly_larger * equal_solutions_tolerance && fine < coarse && all.are_usable(),
      "relative difference in q {:.1e} at N = {}, {:.1e} at N = {}{}{}{}{}", coarse, rows.front().text("intervals"),
      fine, rows.back().text("intervals"), orders.empty() ? "" : "; slopes ", orders.in_words(", ", words),
      left_out(slopes, orders, "without a fit (few grids above rounding):"), left_out(all, rows));
}

Finding tangent_coincides(const ResultTables& tables, const std::string& problem) {
  const Selection all = tables.rows("equivalence", problem).where("method", "tangent").where("tableau", "gauss");
  const Selection rows = all.usable();
  require(!rows.empty(), "equivalence.csv has no solved row of {} by tangent and Gauss", problem);
  const Differences largest(rows);
  return found(largest.are_rounding() && all.are_usable(),
               "largest relative difference from DMOC on {} grids: {:.0e}, costates {:.0e}{}", rows.size(),
               largest.primal, largest.costates, left_out(all, rows));
}

}  // namespace

Claims solution_claims() {
  const Wording section{"section 4.2.1", "section 4.2.2"};
  const std::vector<std::string> equivalence{"equivalence.csv", "figures/{}_equivalence.svg"};
  return {{.id = "momentum_consistency",
           .problems = of_paper,
           .where = section,
           .figure = Wording("fig:kepler_J", "fig:twolink_obj b)"),
           .whose = Whose::paper,
           .states = "change in momentum equals the forces to numerical accuracy for DMOC and Hamiltonian collocation, "
                     "not for tangent-space collocation",
           .judge = momentum_consistency,
           .evidence = {"consistency.csv", "figures/{}_momentum.svg"}},
          {.id = "equal_solutions",
           .problems = of_paper,
           .where = "section 3.4, th:equi, equ_L_RK, ex:RK",
           .whose = Whose::paper,
           .states = "DMOC and Hamiltonian collocation by the same tableau have equal solutions",
           .judge = equal_solutions,
           .condition = "fixed ends, no inequality is active, answers are refined by Newton steps",
           .evidence = equivalence},
          {.id = "tangent_differs",
           .problems = of_paper,
           .where = section,
           .whose = Whose::ours,
           .states = "collocation on the tangent space is another discretisation: its solutions are not those of DMOC",
           .judge = tangent_differs,
           .evidence = {"equivalence.csv", "equivalence_slopes.csv", "figures/{}_equivalence.svg"}}};
}

Claims coincidence_claims() {
  return {{.id = "tangent_coincides",
           .problems = Problems(1, oscillator),
           .where = "section 3.4, ex:RK",
           .whose = Whose::ours,
           .states = "where L_vv is constant, collocation on the tangent space by Gauss is Hamiltonian collocation",
           .judge = tangent_coincides,
           .evidence = {"equivalence.csv", "figures/{}_equivalence.svg"}}};
}

}  // namespace dmocbench
