// Galerkin variational integrators: which control space (section 2.2) costs order, and what they keep of DMOC.
#include <algorithm>
#include <cmath>

#include "bench/claims/claim.hpp"
#include "methods/transcription/elements/galerkin_element.hpp"

namespace dmocbench {

namespace {

/// Degree s of q and number m of control nodes.
struct Spaces {
  int degree = 0;
  int nodes = 0;
};

/// The spaces of a row by galerkin; none of another method.
Spaces spaces_of(const Row& row) {
  for (const int degree : {1, 2, 3, 4}) {
    for (const int nodes : {1, 2, 3, 4}) {
      for (const bool is_continuous : {false, true}) {
        if (row.text("method") == galerkin_name(degree, nodes, is_continuous)) return {degree, nodes};
      }
    }
  }
  return {};
}

bool has_any(const Spaces& spaces) { return spaces.degree > 0; }
bool is_too_small(const Spaces& spaces) { return spaces.nodes < spaces.degree; }
bool is_large_enough(const Spaces& spaces) { return has_any(spaces) && !is_too_small(spaces); }

double expected_order_of(const Row& row) {
  const Spaces spaces = spaces_of(row);
  return 2.0 * std::min(spaces.degree, spaces.nodes);
}

/// State and costates at the nodes have the order 2 min(s, m), of the spaces that are meant; `floor` if less than half
/// of their orders were fitted.
Predicate have_the_order_of_spaces(std::string table, bool (*is_meant)(const Spaces&)) {
  return [table = std::move(table), is_meant](const ResultTables& tables, const std::string& problem) -> Finding {
    const Selection rows = tables.rows(table + "_slopes", problem).where([&](const Row& row) {
      return is_meant(spaces_of(row)) && (row.text("quantity") == "state" || row.text("quantity") == "costate");
    });
    require(!rows.empty(), "{}_slopes.csv has no order of a galerkin method for {}", table, problem);
    const Selection fitted = rows.where(has_order);
    const ClaimVerdict of_fitted =
        verdict_on_all(fitted, [](const Row& row) { return verdict_on_order(row, expected_order_of(row)); });
    const bool are_few = 2 * fitted.size() < rows.size();
    const auto order_in_words = [](const Row& row) {
      const std::string& quantity = row.text("quantity");
      const std::string points = "r = " + row.text("stages");
      const Words order = has_order(row) ? worded("{:.2f}", Measurement{"slope of the " + quantity, row.needed("slope"),
                                                                        row.text("method"), points})
                                         : worded("{}", why_without_order(row));
      return worded("{} {} {} {}", row.text("method"), points, quantity, order);
    };
    return found(are_few && of_fitted == ClaimVerdict::reproduced ? ClaimVerdict::floor : of_fitted,
                 "slopes of errors relative to the indirect solution: {}", joined(rows, "; ", order_in_words))
        .also(unsolved_behind(tables, table, {{"problem", problem}}));
  };
}

/// Cost and error of the state of galerkin with r = s = m next to DMOC's.
Finding galerkin_is_dmoc(const ResultTables& tables, const std::string& problem) {
  constexpr double equal_solutions = 1e-9;
  const Selection rows = tables.rows("convergence_galerkin", problem).usable();
  double of_cost = 0.0;
  double of_state = 0.0;
  std::size_t pairs = 0;
  for (const Row& dmoc : rows.where("method", "dmoc")) {
    const int s = static_cast<int>(dmoc.needed("stages"));
    for (const Row& row :
         rows.matching(dmoc, {"tableau", "stages", "intervals"}).where("method", galerkin_name(s, s, false))) {
      const double cost = dmoc.needed("objective");
      of_cost = std::max(of_cost, std::abs(row.needed("objective") - cost) / std::abs(cost));
      of_state = std::max(of_state, std::abs(row.needed("state_error") - dmoc.needed("state_error")));
      ++pairs;
    }
  }
  require(pairs > 0, "convergence_galerkin.csv has no solve of {} by both dmoc and galerkin with r = s = m", problem);
  return found(std::max(of_cost, of_state) < equal_solutions,
               "{} pairs of solves: largest relative difference of the cost {:.1e}, of the errors of q {:.1e}", pairs,
               Measurement{"largest relative difference of the cost", of_cost},
               Measurement{"largest difference of the errors of q", of_state});
}

/// The change of momentum less the work of the forces, relative to the largest force or absolute.
Finding galerkin_keeps_momentum(const ResultTables& tables, const std::string& problem) {
  constexpr double rounding_of_balance = 1e-11;
  const Selection all = tables.rows("consistency_galerkin", problem);
  const Selection rows = all.usable();
  require(!rows.empty(), "consistency_galerkin.csv has no solved row of {}", problem);
  const double largest = rows.max(
      [](const Row& row) { return row.needed("momentum_defect_max") / std::max(1.0, row.needed("largest_force")); });
  return found(largest < rounding_of_balance,
               "largest defect of an interval in {} solves with {} pairs of s and m: {:.1e}", rows.size(),
               rows.group_by({"method"}).size(), Measurement{"largest defect of an interval", largest})
      .also(left_out(all, rows));
}

/// The Lagrangian of the program, at unknowns that satisfy no equation, next to the discrete action of the control
/// Lagrangian. Whether that finds a mistake is seen by a multiplier of too low a degree.
Finding variation_commutes(const ResultTables& tables, const std::string& problem) {
  constexpr double rounding_of_sums = 1e-12;
  constexpr double multiple_of_rounding = 100.0;  // times the differences that are round-off
  Selection all = tables.rows("equivalence_galerkin", problem);
  all.append(tables.rows("equivalence_galerkin_lobatto", problem));
  const Selection rows = all.usable();
  const Selection curved = rows.where([](const Row& row) {
    const Spaces spaces = spaces_of(row);
    return (has_any(spaces) ? spaces.degree : row.needed("stages")) > 1.0;
  });
  require(!curved.empty(),
          "equivalence_galerkin.csv and equivalence_galerkin_lobatto.csv have {} solved rows of {}, but none with q of "
          "degree two or more",
          rows.size(), problem);
  const double largest = rows.max("galerkin_form_difference");
  const double least = curved.min("straight_form_difference");
  const bool finds_mistakes = least > multiple_of_rounding * largest;
  return found(largest >= rounding_of_sums ? ClaimVerdict::differs
               : finds_mistakes            ? ClaimVerdict::reproduced
                                           : ClaimVerdict::undecided,
               "largest relative difference for {} triples of s, m and quadrature on {} solves: {:.0e}",
               rows.group_by({"method", "tableau", "stages"}).size(), rows.size(),
               Measurement{"largest relative difference", largest})
      .also(worded("with xi linear in time on every interval, for s > 1, at least {:.0e}",
                   Measurement{"least relative difference with xi linear in time", least}))
      .also(left_out(all, rows));
}

}  // namespace

/// Control spaces of their own.
Claims galerkin_claims() {
  const auto order = [](const char* id, const char* table, bool (*is_meant)(const Spaces&), const char* states) {
    return Claim{.id = id,
                 .where = "section 2.2, discrete control path space",
                 .states = states,
                 .judge = have_the_order_of_spaces(table, is_meant),
                 .condition =
                     "ends are fixed and no bound is active; s is the degree of q, m the number of control nodes per "
                     "interval, r the number of quadrature points",
                 .evidence = {std::string(table) + "_slopes.csv"}};
  };
  return {order("control_space_large_enough", "convergence_galerkin", is_large_enough,
                "with m >= s and any Gauss quadrature of r >= s points, state and costates at the nodes have order 2s: "
                "neither more control nodes nor more quadrature points raise the order"),
          order("control_space_too_small", "convergence_galerkin", is_too_small,
                "with m < s, the order of state and costates at the nodes is 2m"),
          order("control_space_continuous", "convergence_galerkin_shared", has_any,
                "continuous controls through m Lobatto nodes, m >= 2, have order 2 min(s, m) as well"),
          order("control_space_by_lobatto_quadrature", "convergence_galerkin_lobatto", has_any,
                "with a quadrature of s + 1 Lobatto points, the order is 2 min(s, m) as well"),
          {.id = "galerkin_is_dmoc",
           .where = "section 3.4, eq:DMOC_RK_L",
           .states = "with r = s = m and Gauss quadrature, the Galerkin integrator has the same solutions as DMOC",
           .judge = galerkin_is_dmoc,
           .evidence = {"convergence_galerkin.csv"}},
          {.id = "variation_and_discretisation_commute",
           .where = "section 3.5",
           .states = "for every degree s of q, every quadrature and every control space, the Lagrangian of the "
                     "nonlinear program is the Galerkin form of the control Lagrangian C + xi (L_q + f) + xi' L_v: "
                     "variation and discretisation commute",
           .judge = variation_commutes,
           .condition =
               "xi is the polynomial of degree s through the multipliers; a single triple with a difference above "
               "round-off would refute the statement; Campos et al. (2015) prove it for their families, and Konopik et "
               "al. (arXiv 2502.04742) construct direct methods that are equivalent to schemes of low order",
           .evidence = {"equivalence_galerkin.csv", "equivalence_galerkin_lobatto.csv"}},
          {.id = "galerkin_momentum",
           .where = "section 2.2, eq:noether_force_d",
           .states = "for every control space, the change of momentum equals the work of the forces to round-off",
           .judge = galerkin_keeps_momentum,
           .evidence = {"consistency_galerkin.csv"}}};
}

}  // namespace dmocbench
