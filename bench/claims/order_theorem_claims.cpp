// The Lemma on exact Legendre transforms, and (th:ordercalculation) as a whole.

#include <algorithm>

#include "bench/claims/claim.hpp"

namespace dmocbench {

namespace {

/// One column over another.
double quotient_of(const Row& row, const char* numerator, const char* denominator) {
  require(row.needed(denominator) > 0.0, "{}, column {}: the value must be positive", row.place(), denominator);
  return row.needed(numerator) / row.needed(denominator);
}

Finding exact_transforms_agree(const ResultTables& tables, const std::string& problem) {
  constexpr double rounding_of_differences = 1e-9;
  const Selection rows = tables.rows("consistency_order_transforms", problem);
  const auto defect = [](const Row& row) {
    return std::max(quotient_of(row, "left_defect", "largest_momentum"),
                    quotient_of(row, "right_defect", "largest_momentum"));
  };
  return found(rows.max(defect) < rounding_of_differences,
               "largest difference over 8 trajectories and {} step sizes, relative to the largest momentum: {:.1e}",
               rows.size(), Measurement{"largest relative difference", rows.max(defect)});
}

/// A quantity and its order of error in (th:ordercalculation).
struct Statement {
  const char* name;
  std::vector<const char*> quantities;
  int more;  ///< than the order r, in the exponent of h
};

const char* outcome_in_words(ClaimVerdict verdict) {
  if (verdict == ClaimVerdict::reproduced) return "holds";
  return verdict == ClaimVerdict::differs ? "fails" : "is undecided";
}

/// Slopes by Gauss with up to three stages; beyond, rounding comes first.
Predicate all_hold_with_one_order(std::vector<Statement> statements) {
  return [statements = std::move(statements)](const ResultTables& tables, const std::string& problem) -> Finding {
    const Selection rows =
        tables.rows("consistency_order_slopes", problem).where("tableau", "gauss").where([](const Row& row) {
          return row.needed("stages") <= 3.0;
        });
    std::vector<ClaimVerdict> verdicts;
    std::vector<Words> words;
    for (const Statement& statement : statements) {
      std::vector<Measurement> slopes;
      std::vector<ClaimVerdict> of_statement;
      for (const char* quantity : statement.quantities) {
        const Selection of_quantity = rows.where("quantity", quantity);
        require(!of_quantity.empty(), "consistency_order_slopes.csv has no slope of {} for {}", quantity, problem);
        for (const Row& row : of_quantity) {
          of_statement.push_back(verdict_on_order(row, row.needed("order") + statement.more));
          slopes.push_back(
              {std::string("slope of ") + quantity, row.needed("slope"), "", "gauss " + row.text("stages")});
        }
      }
      verdicts.push_back(verdict_on_all(of_statement));
      words.push_back(
          worded("{}: {} ({})", statement.name, outcome_in_words(verdicts.back()), listed("{:.1f}", slopes)));
    }
    return found(verdict_on_all(verdicts), "slopes over h, Gauss schemes of orders 2, 4, 6: {}", joined(words, "; "));
  };
}

/// (iii) asks for an equivalent pair. (L_d + S, f_d - dS) has the transforms of (L_d, f_d) for every S, and errors of
/// h^(r + 1) if L_d has and ω = f_d - f_d^E is a differential dS up to h^(r + 1). Then h dω is small against ω.
Finding theorem_as_printed(const ResultTables& tables, const std::string& problem) {
  constexpr double rounding_of_differences = 1e-3;
  Finding finding = all_hold_with_one_order({{"(i) map", {"map"}, 1},
                                             {"(ii) transforms", {"left_legendre", "right_legendre"}, 1},
                                             {"(iii) L_d", {"lagrangian"}, 1}})(tables, problem);
  std::vector<Measurement> shares;
  for (const Row& row : tables.rows("consistency_order_transforms", problem)) {
    shares.push_back({"ratio of h d(f_d - f_d^E) to f_d - f_d^E", quotient_of(row, "force_error_curl", "force_error"),
                      "dmoc", "h = " + row.text("h")});
  }
  const auto [least, most] = std::ranges::minmax(shares, {}, &Measurement::value);
  const ClaimVerdict has_pair = verdict_on_interval(least.value, most.value, -1.0, rounding_of_differences);
  finding.verdict = verdict_on_all({finding.verdict, has_pair});
  return std::move(finding).also(worded(
      "(iii) f_d: {}; with the midpoint rule its error {} a differential, and h d(f_d - f_d^E) is {} of f_d - f_d^E",
      outcome_in_words(has_pair), has_pair == ClaimVerdict::reproduced ? "is" : "is not", listed("{:.0e}", shares)));
}

}  // namespace

/// The theorem on it, and the exact Legendre transforms.
Claims order_theorem_claims() {
  const std::vector<std::string> evidence{"consistency_order_slopes.csv", "consistency_order_transforms.csv",
                                          "figures/{}_consistency_order.svg"};
  const std::vector<const char*> transforms{"left_legendre", "right_legendre"};
  const std::vector<const char*> forces{"left_force", "right_force"};
  return {
      {.id = "exact_legendre_transform",
       .where = "section 2.3, the Lemma",
       .whose = Whose::paper,
       .states = "the forced discrete Legendre transforms of L_d^E equal the transforms of L at the ends of the exact "
                 "trajectory",
       .judge = exact_transforms_agree,
       .evidence = {"consistency_order_transforms.csv"}},
      {.id = "order_theorem",
       .where = "section 2.3, th:ordercalculation",
       .whose = Whose::paper,
       .states = "these are equivalent: (i) the map is of order r, (ii) the Legendre transforms are of order r, (iii) "
                 "(L_d, f_d) is equivalent to a pair of order r; all with errors of h^(r + 1)",
       .judge = theorem_as_printed,
       .condition = "the transforms lose a power: at fixed end points the derivative of h^(r + 1) e((q_0 + q_1)/2, "
                    "(q_1 - q_0)/h) with respect to q_1 is of order h^r, while L_d and the map keep h^(r + 1) "
                    "(methods/diagnostics/README.md, \"Order of consistency\"); Patrick and Cuell, whom the paper "
                    "cites for another proof, find this for the unforced theorem: divisions by the time step cost one "
                    "order, which a symmetry between past and future repairs for the map (Error analysis of "
                    "variational integrators of unconstrained Lagrangian systems, Numer. Math. 113, 2009)",
       .cause = Wording("(i) holds, (ii) and (iii) do not: the force (0, r u) depends on the state, and the error of "
                        "order h^r of f_d is not a differential, so no equivalent pair has forces of order r",
                        "(i) and (iii) hold, (ii) does not: the force does not depend on the state, so f_d and f_d^E "
                        "are the differentials of W_d and W^E, the work sum and integral of f q, and (L_d + W_d - W^E, "
                        "f_d - d(W_d - W^E)) is an equivalent pair of order r"),
       .evidence = evidence},
      {.id = "order_theorem_with_one_power_less",
       .where = "section 2.3, th:ordercalculation",
       .states = "with errors of h^r in eq:DMOC_orderf and eq:DMOC_orderLeg, (i), (ii) and (iii) hold with the same r",
       .judge = all_hold_with_one_order({{"(i) map", {"map"}, 1},
                                         {"(ii) transforms", transforms, 0},
                                         {"(iii) L_d", {"lagrangian"}, 1},
                                         {"(iii) f_d", forces, 0}}),
       .evidence = evidence}};
}

}  // namespace dmocbench
