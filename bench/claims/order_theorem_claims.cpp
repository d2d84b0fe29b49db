// The Lemma on exact Legendre transforms, and (th:ordercalculation) as a whole.

#include "bench/claims/claim.hpp"

namespace dmocbench {

namespace {

Finding exact_transforms_agree(const ResultTables& tables, const std::string& problem) {
  constexpr double rounding_of_differences = 1e-9;
  const Selection rows = tables.rows("consistency_order_transforms", problem);
  const auto defect = [](const Row& row) {
    require(row.needed("largest_momentum") > 0.0, "{}, column largest_momentum: the value must be positive",
            row.place());
    return std::max(row.needed("left_defect"), row.needed("right_defect")) / row.needed("largest_momentum");
  };
  return found(rows.max(defect) < rounding_of_differences,
               "largest difference over 8 trajectories and {} steps, relative to the largest momentum: {:.1e}",
               rows.size(), Measurement{"largest relative difference", rows.max(defect)});
}

/// A quantity and its order of error in (th:ordercalculation).
struct Statement {
  const char* name;
  std::vector<const char*> quantities;
  int more;  ///< than the order r, in the exponent of h
};

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
      const char* const outcome = verdicts.back() == ClaimVerdict::reproduced ? "holds"
                                  : verdicts.back() == ClaimVerdict::differs  ? "fails"
                                                                              : "is undecided";
      words.push_back(worded("{} {} ({})", statement.name, outcome, listed("{:.1f}", slopes)));
    }
    return found(verdict_on_all(verdicts), "slopes over h by Gauss of order 2, 4, 6: {}", joined(words, "; "));
  };
}

}  // namespace

/// The theorem on it, and the exact Legendre transforms.
Claims order_theorem_claims() {
  const std::vector<std::string> evidence{"consistency_order_slopes.csv", "figures/{}_consistency_order.svg"};
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
       .states =
           "(i) the map, (ii) the Legendre transforms and (iii) L_d and f_d have order r together, with errors of "
           "h^(r + 1)",
       .judge = all_hold_with_one_order({{"(i) map", {"map"}, 1},
                                         {"(ii) transforms", transforms, 1},
                                         {"(iii) L_d", {"lagrangian"}, 1},
                                         {"(iii) f_d", forces, 1}}),
       .cause = "(i) holds and (ii) and (iii) do not, because the definitions (eq:DMOC_orderf) and (eq:DMOC_orderLeg) "
                "require one power too many of f_d and of the transforms: at fixed end points the derivative of h^(r + "
                "1) e((q_0 + q_1)/2, (q_1 - q_0)/h) by q_1 loses one power, so that their exact order is h^r while L_d "
                "and the map keep h^(r + 1) (methods/diagnostics/README.md, \"Order of consistency\"); Patrick and "
                "Cuell, whom the paper cites for another proof, find it for the unforced theorem: divisions by the "
                "time step cost one order, which a symmetry between past and future repairs for the map (Error "
                "analysis of variational integrators of unconstrained Lagrangian systems, Numer. Math. 113, 2009)",
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
