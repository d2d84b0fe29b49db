// Momentum-force consistency "to numerical accuracy", and which methods have equal solutions.
#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/claims/claim.hpp"
#include "bench/tables/fitted_orders.hpp"
#include "methods/transcription/elements/families.hpp"

namespace dmocbench {

namespace {

/// Rounding of a momentum difference, relative to the work of the forces over one interval or absolute.
constexpr double rounding_of_balance = 1e-11;
/// Tangent-space collocation has to miss the balance by this factor to "fail to capture" it.
constexpr double clearly_larger = 1e3;

constexpr double equal_solutions_tolerance = 1e-9;
constexpr double equal_costates_tolerance = 1e-8;

double largest_defect(const Row& row) { return row.needed("momentum_defect_max"); }
double accumulated_defect(const Row& row) { return std::abs(row.needed("momentum_defect_total")); }

/// The balance of momentum by the midpoint rule, solved to one tolerance.
struct MomentumBalance {
  Selection all;
  Selection dmoc;
  Selection hamiltonian;
  Selection tangent;

  explicit MomentumBalance(const Selection& rows)
      : all(rows),
        dmoc(rows.usable().where("method", "dmoc")),
        hamiltonian(rows.usable().where("method", "hamiltonian")),
        tangent(rows.usable().where("method", "tangent")) {
    require(dmoc.size() > 1 && hamiltonian.size() > 1 && tangent.size() > 1,
            "consistency.csv has {}, {} and {} solved rows by dmoc, hamiltonian and tangent; two of each are needed",
            dmoc.size(), hamiltonian.size(), tangent.size());
  }
  /// No interval of a structured method misses more than rounding, relative to the force or absolute.
  [[nodiscard]] bool is_kept() const {
    const auto relative = [](const Row& row) {
      return largest_defect(row) / std::max(1.0, row.needed("largest_force"));
    };
    return std::max(dmoc.max(relative), hamiltonian.max(relative)) < rounding_of_balance;
  }
  /// On every grid the defects of tangent-space collocation add up to far more than the defects of the other methods. A
  /// single interval is inconclusive on fine grids, where its defect of order h^3 falls below rounding.
  [[nodiscard]] bool is_missed_by_tangent() const {
    return std::ranges::all_of(tangent, [&](const Row& row) {
      const double rounding = std::max(structured(dmoc, row), structured(hamiltonian, row));
      return accumulated_defect(row) > clearly_larger * std::max(rounding, rounding_of_balance * 1e-3);
    });
  }
  [[nodiscard]] Words largest_of_all_grids() const {
    return by_method("largest defect of an interval", "all N", dmoc.max(largest_defect),
                     hamiltonian.max(largest_defect), tangent.max(largest_defect));
  }
  [[nodiscard]] Words on_finest_grid() const {
    const std::string finest = "N = " + tangent.back().text("intervals");
    return worded("largest defect of an interval at {}: {}", finest,
                  by_method("defect of an interval", finest, largest_defect(dmoc.back()),
                            largest_defect(hamiltonian.back()), largest_defect(tangent.back())));
  }
  [[nodiscard]] Words accumulated() const {
    const std::string finest = "N = " + tangent.back().text("intervals");
    return worded("accumulated defect at {}: {}", finest,
                  by_method("accumulated defect", finest, structured(dmoc, tangent.back()),
                            structured(hamiltonian, tangent.back()), accumulated_defect(tangent.back())));
  }

 private:
  static Words by_method(const std::string& quantity, const std::string& grid, double of_dmoc, double of_hamiltonian,
                         double of_tangent) {
    return worded("dmoc {:.1e}, hamiltonian {:.1e}, tangent {:.1e}", Measurement{quantity, of_dmoc, "dmoc", grid},
                  Measurement{quantity, of_hamiltonian, "hamiltonian", grid},
                  Measurement{quantity, of_tangent, "tangent", grid});
  }
  /// The accumulated defect of a method on the grid of a row.
  [[nodiscard]] static double structured(const Selection& method, const Row& on_grid) {
    const Selection same = method.matching(on_grid, {"intervals"});
    return same.empty() ? 0.0 : accumulated_defect(same.front());
  }
};

/// Judged at the tightest tolerance, which "numerical accuracy" refers to. The others are reported.
Finding momentum_consistency(const ResultTables& tables, const std::string& problem) {
  Selection rows = tables.rows("consistency", problem);
  if (tables.has("consistency_tolerances")) rows.append(tables.rows("consistency_tolerances", problem));
  for (const Row& row : rows) static_cast<void>(row.needed("tolerance"));
  const std::vector<Selection> by_tolerance = rows.where(is_midpoint).sorted_by("tolerance").group_by({"tolerance"});
  require(!by_tolerance.empty(), "consistency.csv has no row of {} with gauss 1 and a tolerance", problem);
  const auto of_grids = [](const Selection& solves) { return MomentumBalance(solves.sorted_by("intervals")); };
  const MomentumBalance balance = of_grids(by_tolerance.front());
  std::vector<Words> others;
  for (std::size_t i = 1; i < by_tolerance.size(); ++i) {
    const MomentumBalance looser = of_grids(by_tolerance[i]);
    const std::string& tolerance = looser.dmoc.front().text("tolerance");
    const auto defect = [&](const Selection& of_method, const char* method) {
      return Measurement{"largest defect of an interval", of_method.max(largest_defect), method,
                         "tolerance " + tolerance};
    };
    others.push_back(worded("at tolerance {}: dmoc {:.1e}, hamiltonian {:.1e}", tolerance, defect(looser.dmoc, "dmoc"),
                            defect(looser.hamiltonian, "hamiltonian")));
  }
  Finding finding = found(balance.is_kept() && balance.is_missed_by_tangent(),
                          "solved to tolerance {}: largest defect of an interval over all N: {}",
                          balance.dmoc.front().text("tolerance"), balance.largest_of_all_grids())
                        .also(balance.on_finest_grid())
                        .also(balance.accumulated())
                        .also(left_out(balance.all, balance.all.usable()));
  if (others.empty()) return finding;
  return std::move(finding).because(worded(
      "the balance is an equation of the program and holds as accurately as the program is solved: largest defects {}",
      joined(others, ", ")));
}

/// The largest differences from DMOC, relative to each quantity's largest value.
struct Differences {
  Words words;  ///< by quantity
  double primal = 0.0;
  double costates = 0.0;

  /// `at` is the case that the numbers are of.
  explicit Differences(const Selection& rows, const std::string& at = "") : costates(rows.max("costate_difference")) {
    std::vector<Words> by_quantity;
    for (const auto& [column, symbol] :
         {std::pair{"configuration_difference", "q"}, std::pair{"momentum_difference", "p"},
          std::pair{"control_difference", "u"}, std::pair{"objective_difference", "J"}}) {
      const double difference = rows.max(column);
      by_quantity.push_back(worded("{} {:.0e}", symbol, of(symbol, difference, at)));
      primal = std::max(primal, difference);
    }
    words = joined(by_quantity, ", ");
  }
  /// The largest relative difference of a quantity.
  static Measurement of(const std::string& symbol, double difference, const std::string& at = "") {
    return {.name = "largest relative difference of " + symbol, .value = difference, .at = at};
  }
  [[nodiscard]] bool are_rounding() const {
    return primal < equal_solutions_tolerance && costates < equal_costates_tolerance;
  }
};

Finding equal_solutions(const ResultTables& tables, const std::string& problem) {
  const Selection all = tables.rows("equivalence", problem).where("method", "hamiltonian");
  const Selection rows = all.usable();
  require(!rows.empty(), "equivalence.csv has no solved row of {} by hamiltonian", problem);
  const bool rows_agree = std::ranges::all_of(rows, has_solution_of_dmoc);
  const Differences largest(rows);
  return found(largest.are_rounding() && rows_agree,
               "{} grids with {} tableaus, largest relative difference: {}, costates {:.0e}", rows.size(),
               rows.group_by({"tableau", "stages"}).size(), largest.words,
               Differences::of("the costates", largest.costates))
      .also(worded("each solution satisfies the other method's equations {} round-off", rows_agree ? "to" : "not to"))
      .also(left_out(all, rows));
}

/// The optimal costs of the same programs with the cost as a sum and as the last value of a further state.
Finding bolza_is_mayer(const ResultTables& tables, const std::string& problem) {
  constexpr double rounding_of_costs = 1e-9;
  const Selection all = tables.rows("objective_mayer", problem);
  const Selection bolza = tables.rows("objective", problem).usable();
  Selection used;
  double largest = 0.0;
  for (const Row& row : all.usable()) {
    const Selection same = bolza.matching(row, {"method", "tableau", "stages", "intervals"});
    if (same.empty()) continue;
    used.append(row);
    largest = std::max(largest, std::abs(quotient(row, same.front(), "objective") - 1.0));
  }
  require(used.size() > 1,
          "objective.csv and objective_mayer.csv have {} programs of {} solved in both forms; two are needed",
          used.size(), problem);
  return found(largest < rounding_of_costs,
               "the costs of {} programs by {} in both forms have relative differences of at most {:.0e}", used.size(),
               fmt::join(used.distinct("method"), ", "),
               Measurement{"largest relative difference of the costs", largest})
      .also(left_out(all, used, "not solved in both forms, which favours"));
}

/// The same where inequalities are active or the horizon is free. An answer that no Newton step could refine differs by
/// the tolerance of its solver.
Finding equal_with_inequalities(const ResultTables& tables, const std::string& /*problem*/) {
  const Selection all = tables.rows("equivalence_inequalities").where("method", "hamiltonian");
  // Where DMOC has no answer on the grid, nothing was compared.
  const Selection rows = all.usable().where([](const Row& row) {
    const bool is_compared = !row.text("objective_difference").empty() || !row.text("configuration_difference").empty();
    return is_compared && row.needed("polish_steps") >= 1.0;
  });
  std::vector<ClaimVerdict> verdicts;
  std::vector<Words> words;
  for (const Selection& of_problem : rows.group_by({"problem"})) {
    const std::string& name = of_problem.front().text("problem");
    const Differences largest(of_problem, name);
    const bool agree = std::ranges::all_of(of_problem, has_solution_of_dmoc);
    verdicts.push_back(verdict_on(agree && largest.are_rounding()));
    words.push_back(worded("{} on {} grids: {}, T {:.0e}, costates {:.0e}", name, of_problem.size(), largest.words,
                           Differences::of("T", of_problem.max("horizon_difference"), name),
                           Differences::of("the costates", largest.costates, name)));
  }
  require(words.size() > 1, "equivalence_inequalities.csv has usable rows of {} problems; two are needed",
          words.size());
  return found(verdict_on_all(verdicts), "largest relative difference: {}", joined(words, "; "))
      .also(left_out(all, rows, "too coarse or not refined by Newton steps, which favours"));
}

/// Noether's theorem of the optimal control problem.
Finding costates_keep_their_momentum(const ResultTables& tables, const std::string& /*problem*/) {
  const Selection all = tables.rows("equivalence_symmetric");
  const Selection rows = all.usable();
  std::vector<Words> words;
  for (const Selection& of_method : rows.group_by({"method"})) {
    const std::string& method = of_method.front().text("method");
    words.push_back(
        worded("{} {:.0e} on {} grids of {}", method,
               Measurement{"spread of the momentum of the costates", of_method.max("costate_momentum_spread"), method},
               of_method.size(), fmt::join(of_method.distinct("problem"), ", ")));
  }
  require(words.size() >= paper_families().size(),
          "equivalence_symmetric.csv has usable rows of {} methods; all three are needed", words.size());
  return found(rows.max("costate_momentum_spread") < equal_costates_tolerance,
               "largest relative spread of the momentum of the costates: {}", joined(words, "; "))
      .also(left_out(all, rows));
}

Finding tangent_differs(const ResultTables& tables, const std::string& problem) {
  const Selection all = midpoint(tables.rows("equivalence", problem), "tangent");
  const Selection rows = all.usable();
  require(rows.size() > 1, "equivalence.csv has fewer than two solved grids of {} by tangent", problem);
  const double coarse = rows.front().needed("configuration_difference");
  const double fine = rows.back().needed("configuration_difference");
  const Selection slopes = tables.rows("equivalence_slopes", problem).where("tableau", "gauss");
  const Selection orders = slopes.where("verdict", "slope");
  require(!orders.empty(), "equivalence_slopes.csv has no fitted slope of {} among {} rows", problem, slopes.size());
  const auto is_twice_the_stages = [](const Row& row) { return verdict_on_order(row, 2.0 * row.needed("stages")); };
  const auto words = [](const Row& row) {
    return worded(
        "s = {}: {:.2f}", row.text("stages"),
        Measurement{"slope of the difference in q", row.needed("slope"), "tangent", "s = " + row.text("stages")});
  };
  const auto difference = [](const Row& row, double value) {
    return Measurement{"relative difference in q", value, "tangent", "N = " + row.text("intervals")};
  };
  const bool is_another =
      fine > equal_solutions_tolerance / 10.0 && coarse > clearly_larger * equal_solutions_tolerance && fine < coarse;
  return found(verdict_on_all({verdict_on(is_another), verdict_on_all(orders, is_twice_the_stages)}),
               "relative difference in q {:.1e} at N = {}, {:.1e} at N = {}", difference(rows.front(), coarse),
               rows.front().text("intervals"), difference(rows.back(), fine), rows.back().text("intervals"))
      .also(worded("slopes {}", joined(orders, ", ", words)))
      .also(left_out(slopes, orders, "no order was fitted (few grids above round-off):"))
      .also(left_out(all, rows));
}

Finding tangent_coincides(const ResultTables& tables, const std::string& problem) {
  const Selection all = tables.rows("equivalence", problem).where("method", "tangent").where("tableau", "gauss");
  const Selection rows = all.usable();
  require(!rows.empty(), "equivalence.csv has no solved row of {} by tangent with Gauss", problem);
  const Differences largest(rows);
  return found(largest.are_rounding(), "largest relative difference from DMOC on {} grids: {:.0e}, costates {:.0e}",
               rows.size(), Differences::of("q, p, u and J", largest.primal),
               Differences::of("the costates", largest.costates))
      .also(left_out(all, rows));
}

/// The solutions of some methods by the midpoint rule in the two forms of the control Lagrangian: residuals in their
/// own form have to be rounding, residuals in the other form far more on every grid.
Finding form_of_control_lagrangian(const ResultTables& tables, const std::string& problem,
                                   const std::vector<std::string>& methods, const char* own, const char* other) {
  const Selection all = tables.rows("equivalence", problem).where([&](const Row& row) {
    return is_midpoint(row) && std::ranges::count(methods, row.text("method")) > 0;
  });
  const Selection rows = all.usable();
  require(rows.size() > 1, "equivalence.csv has {} solved rows of {} by {} with the midpoint rule; two are needed",
          rows.size(), problem, fmt::join(methods, " and "));
  const double rounding = rows.max(own);
  const double least = rows.min(other);
  return found(rounding < equal_costates_tolerance && least > clearly_larger * rounding,
               "residuals on {} grids: in their own form at most {:.0e}, in the other form {:.0e} to {:.0e}",
               rows.size(), Measurement{"largest residual in their own form", rounding},
               Measurement{"least residual in the other form", least},
               Measurement{"largest residual in the other form", rows.max(other)})
      .also(left_out(all, rows));
}

Finding dmoc_is_the_forced_form(const ResultTables& tables, const std::string& problem) {
  return form_of_control_lagrangian(tables, problem, {"dmoc", "hamiltonian"}, "forced_form_residual",
                                    "acceleration_form_residual");
}

Finding tangent_is_the_acceleration_form(const ResultTables& tables, const std::string& problem) {
  return form_of_control_lagrangian(tables, problem, {"tangent"}, "acceleration_form_residual", "forced_form_residual");
}

}  // namespace

/// Momentum-force consistency, methods with equal solutions.
Claims solution_claims() {
  const Wording section{"section 4.2.1", "section 4.2.2"};
  const std::vector<std::string> equivalence{"equivalence.csv", "figures/{}_equivalence.svg"};
  return {
      {.id = "momentum_consistency",
       .where = section,
       .figure = Wording("fig:kepler_J", "fig:twolink_obj b)"),
       .whose = Whose::paper,
       .states = "the change in momentum equals the forces to numerical accuracy for DMOC and Hamiltonian collocation, "
                 "not for tangent-space collocation",
       .judge = momentum_consistency,
       .evidence = {"consistency.csv", "figures/{}_momentum.svg"}},
      {.id = "equal_solutions",
       .where = "section 3.4, th:equi, equ_L_RK, ex:RK",
       .whose = Whose::paper,
       .states = "DMOC and Hamiltonian collocation with the same tableau have equal solutions",
       .judge = equal_solutions,
       .condition = "ends are fixed, no inequality is active, and solutions are refined by Newton steps",
       .evidence = equivalence},
      {.id = "bolza_is_mayer",
       .where = "sections 3.1, 3.2 and 3.4, eq:gDLOCP_mayer, eq:dHOCP1_mayer",
       .whose = Whose::paper,
       .states = "the transformation to Mayer form yields exactly the same problem",
       .judge = bolza_is_mayer,
       .condition = "the statement is judged by the optimal costs of separate solves",
       .evidence = {"objective.csv", "objective_mayer.csv"}},
      {.id = "equal_solutions_with_inequalities",
       .problems = examples,
       .where = "section 3.4, th:equi",
       .whose = Whose::paper,
       .states = "DMOC and Hamiltonian collocation also have equal solutions where inequalities are active and the "
                 "horizon is free",
       .judge = equal_with_inequalities,
       .condition = "N is odd: for even N, the symmetric switches of robot_arm fall on nodes, where no control lies "
                    "between its bounds, so multipliers are not unique",
       .evidence = {"equivalence_inequalities.csv"}},
      {.id = "costates_keep_their_momentum",
       .problems = examples,
       .where = "section 3.5",
       .states = "where L, f and the cost are invariant under a group, the momentum of the costates is constant along "
                 "the discrete optima of all three methods (Noether's theorem of the optimal control problem)",
       .judge = costates_keep_their_momentum,
       .condition = "the group acts linearly on the coordinates, so every method here is equivariant, and this does "
                    "not distinguish the methods",
       .evidence = {"equivalence_symmetric.csv"}},
      {.id = "tangent_differs",
       .where = section,
       .states = "collocation on the tangent space is a different discretisation: its solutions differ from DMOC's",
       .judge = tangent_differs,
       .evidence = {"equivalence.csv", "equivalence_slopes.csv", "figures/{}_equivalence.svg"}},
      {.id = "dmoc_is_the_forced_form",
       .where = "section 3.5",
       .states = "with the midpoint rule, the optimality conditions of DMOC and Hamiltonian collocation are the "
                 "discrete Euler-Lagrange equations of the control Lagrangian C + xi (L_q + f) + xi' L_v",
       .judge = dmoc_is_the_forced_form,
       .condition = "the multiplier xi is the costate of the momentum; ends are fixed and no inequality is active; "
                    "control Lagrangians are the topic of Leyendecker et al. (arXiv 2307.13402) and Konopik et al. "
                    "(arXiv 2502.04742, 2503.04466)",
       .evidence = {"equivalence.csv"}},
      {.id = "tangent_is_the_acceleration_form",
       .where = "section 3.5",
       .states = "the optimality conditions of tangent-space collocation are the discrete equations of another form of "
                 "the control Lagrangian, C + xi q'' + xi' q' with q'' a function of (q, q', u)",
       .judge = tangent_is_the_acceleration_form,
       .condition = "the multiplier xi is L_vv times the costate of the momentum; both forms of the control Lagrangian "
                    "are equal where L_vv and L_vq are constant; this form is the control Lagrangian of Leyendecker et "
                    "al. (arXiv 2307.13402) and Konopik et al. (arXiv 2502.04742, 2503.04466)",
       .evidence = {"equivalence.csv"}}};
}

/// Where tangent-space collocation has the solutions of DMOC.
Claims coincidence_claims() {
  return {
      {.id = "tangent_coincides",
       .problems = Problems(1, oscillator),
       .where = "section 3.4, ex:RK",
       .states = "where L_vv and L_vq are constant, tangent-space collocation with Gauss is Hamiltonian collocation",
       .judge = tangent_coincides,
       .evidence = {"equivalence.csv", "figures/{}_equivalence.svg"}}};
}

}  // namespace dmocbench
