// Mechanisms in redundant coordinates: what DMOC and collocation keep there, and the costs of the minimal statements.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/ranges.h>

#include "bench/claims/claim.hpp"

namespace dmocbench {

namespace {

/// In the place of a problem.
const Problems constrained{"constrained"};

/// Statements with constraints g(q) = 0 and the same in minimal coordinates.
constexpr std::array statements{
    std::pair{"spherical_pendulum_cartesian", "spherical_pendulum"}, std::pair{"cart_pole_cartesian", "cart_pole"},
    std::pair{"two_link_maximal", "two_link_manipulator"}, std::pair{"link_chain_maximal", "link_chain"}};

Finding equal_under_constraints(const Selection& all, double rounding) {
  const Selection rows = all.usable();
  require(!rows.empty(), "no table has a grid with constraints that both dmoc and hamiltonian solved");
  double largest = 0.0;
  for (const char* column :
       {"configuration_difference", "momentum_difference", "control_difference", "objective_difference"}) {
    largest = std::max(largest, rows.max(column));
  }
  return found(largest < rounding,
               "{} grids of {} with {}, largest relative difference of q, projected p, u and J: {:.0e}", rows.size(),
               fmt::join(rows.distinct("problem"), ", "), fmt::join(rows.distinct("tableau"), " and "),
               Measurement{"largest relative difference of q, p, u and J", largest})
      .also(worded("largest relative difference of the costates: {:.0e}",
                   Measurement{"largest relative difference of the costates", rows.max("costate_difference")}))
      .also(left_out(all, rows));
}

Finding equal_with_constraints(const ResultTables& tables, const std::string& /*problem*/) {
  Selection all = tables.rows("equivalence_constrained").where("method", "hamiltonian");
  all.append(tables.rows("equivalence_constrained_lobatto").where("method", "hamiltonian"));
  const std::size_t tableaus = all.usable().group_by({"tableau", "stages"}).size();
  require(tableaus > 1,
          "equivalence_constrained.csv and equivalence_constrained_lobatto.csv have solved rows of {} tableaus; two "
          "are needed",
          tableaus);
  return equal_under_constraints(all, 1e-9);
}

Finding equal_with_velocity_constraints(const ResultTables& tables, const std::string& /*problem*/) {
  return equal_under_constraints(tables.rows("equivalence_velocity_constraints").where("method", "hamiltonian"), 1e-12);
}

Finding balance_of_momentum(const ResultTables& tables, const std::string& table) {
  constexpr double rounding = 1e-10;  // of a solver's tolerance
  const Selection rows = tables.rows(table).usable();
  const auto of = [&](const char* method) { return rows.where("method", method); };
  require(!of("dmoc").empty() && !of("hamiltonian").empty() && !of("tangent").empty(),
          "{}.csv needs solved rows of all three methods", table);
  const auto largest = [&](const char* method) {
    return Measurement{"largest defect of an interval", of(method).max("momentum_defect_max"), method};
  };
  const bool balances = largest("dmoc").value < rounding && largest("hamiltonian").value < rounding;
  // A defect that is rounding on the grids that were solved shows nothing about the others.
  const ClaimVerdict verdict = !balances                             ? ClaimVerdict::differs
                               : largest("tangent").value > rounding ? ClaimVerdict::reproduced
                                                                     : ClaimVerdict::undecided;
  return found(verdict,
               "largest defect of an interval on {} grids of {}: dmoc {:.0e}, hamiltonian {:.0e}, tangent {:.0e}",
               of("dmoc").size(), fmt::join(rows.distinct("problem"), ", "), largest("dmoc"), largest("hamiltonian"),
               largest("tangent"));
}

Finding momentum_with_constraints(const ResultTables& tables, const std::string& /*problem*/) {
  return balance_of_momentum(tables, "consistency_constrained");
}

Finding momentum_with_velocity_constraints(const ResultTables& tables, const std::string& /*problem*/) {
  return balance_of_momentum(tables, "consistency_velocity_constraints");
}

Finding orders_with_velocity_constraints(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double tolerance = 0.2;
  const Selection rows = tables.rows("convergence_velocity_constraints_slopes").where([](const Row& row) {
    return row.text("verdict") == "slope" && row.text("quantity") != "control" && row.text("quantity") != "replay";
  });
  require(!rows.empty(), "convergence_velocity_constraints_slopes.csv has no fitted order");
  const auto deviation = [](const Row& row) { return std::abs(row.needed("slope") - 2.0); };
  return found(rows.max(deviation) < tolerance, "{} orders of {} differ from 2 by at most {:.2f}", rows.size(),
               fmt::join(rows.distinct("problem"), ", "),
               Measurement{"largest distance of an order from 2", rows.max(deviation)});
}

/// The relative difference of the costs of both statements on a grid.
double cost_difference(const Selection& redundant, const Selection& minimal, const std::string& intervals) {
  const double of_minimal = minimal.where("intervals", intervals).max("objective");
  return std::abs(redundant.where("intervals", intervals).max("objective") / of_minimal - 1.0);
}

Finding costs_with_constraints(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double ten_digits = 1e-10;
  constexpr double least_order = 3.5;
  const Selection rows = tables.rows("objective_constrained").usable();
  bool agree = true;
  std::vector<Words> words;
  for (const auto& [redundant_name, minimal_name] : statements) {
    const Selection redundant = rows.where("problem", redundant_name).sorted_by("intervals");
    const Selection minimal = rows.where("problem", minimal_name);
    require(redundant.size() > 1, "objective_constrained.csv has {} solved grids of {}; two are needed",
            redundant.size(), redundant_name);
    const Row& coarse = redundant.front();
    const Row& fine = redundant.back();
    for (const Row* row : {&coarse, &fine}) {
      require(!minimal.where("intervals", row->text("intervals")).empty(),
              "objective_constrained.csv has no solved row of {} with N = {}", minimal_name, row->text("intervals"));
    }
    const double at_coarse = cost_difference(redundant, minimal, coarse.text("intervals"));
    const double at_fine = cost_difference(redundant, minimal, fine.text("intervals"));
    const double order =
        std::log(at_coarse / at_fine) / std::log(fine.needed("intervals") / coarse.needed("intervals"));
    // What is equal to rounding on the finest grid has no order left.
    agree = agree && at_fine < ten_digits && (order > least_order || at_fine < 0.01 * ten_digits);
    words.push_back(worded("{} {:.0e} at N = {} (order {:.1f})", redundant_name,
                           Measurement{"relative difference of the costs", at_fine, "", redundant_name},
                           fine.text("intervals"), Measurement{"order", order, "", redundant_name}));
  }
  return found(agree, "relative difference of the optimal costs with three Lobatto stages: {}", joined(words, ", "));
}

/// A statement of a problem on the grid of `row`, if it was solved.
const Row& same_grid(const Selection& rows, const std::string& problem, const Row& row) {
  const Selection same = rows.where("problem", problem).where("intervals", row.text("intervals"));
  require(same.size() == 1, "objective_forms.csv needs one solved row of {} with N = {}, but has {}", problem,
          row.text("intervals"), same.size());
  return same.front();
}

Finding embedding_with_constraints(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double rounding = 1e-10;
  const Selection rows = tables.rows("objective_forms").usable();
  bool holds = true;
  std::vector<Words> words;
  for (const auto& [redundant_name, minimal_name] : statements) {
    const Selection redundant = rows.where("problem", redundant_name).sorted_by("intervals");
    require(!redundant.empty(), "objective_forms.csv has no solved row of {}", redundant_name);
    double difference = 0.0;
    for (const Row& row : redundant) {
      const Row& embedded = same_grid(rows, std::string(redundant_name) + "_embedded", row);
      difference = std::max(difference, std::abs(embedded.needed("objective") / row.needed("objective") - 1.0));
      holds = holds && embedded.needed("free_variables") < row.needed("free_variables") &&
              embedded.needed("constraints") < row.needed("constraints");
    }
    holds = holds && difference < rounding;
    const Row& fine = redundant.back();
    const Row& embedded = same_grid(rows, std::string(redundant_name) + "_embedded", fine);
    const Row& minimal = same_grid(rows, minimal_name, fine);
    const auto three = [&](const char* column, const char* format) {
      return listed(format, {{column, fine.needed(column), "", redundant_name},
                             {column, embedded.needed(column), "", redundant_name + std::string("_embedded")},
                             {column, minimal.needed(column), "", minimal_name}});
    };
    words.push_back(worded("{} {:.0e} (N = {}: unknowns {}; constraints {}; iterations {}; condition {})",
                           redundant_name,
                           Measurement{"largest relative difference of the costs", difference, "", redundant_name},
                           fine.text("intervals"), three("free_variables", "{:.0f}"), three("constraints", "{:.0f}"),
                           three("major_iterations", "{:.0f}"), three("condition", "{:.0e}")));
  }
  return found(
      holds, "largest relative difference of the costs; numbers for multipliers, embedding and minimal coordinates: {}",
      joined(words, "; "));
}

}  // namespace

/// Holonomic constraints g(q) = 0 (DMOCC), velocity constraints A(q) q̇ = 0.
Claims constraint_claims() {
  return about(
      constrained, Whose::extension,
      {{.id = "equal_solutions",
        .where = "section 1, DMOCC; th:equi",
        .states = "with constraints g(q) = 0, DMOC and Hamiltonian collocation have equal solutions",
        .judge = equal_with_constraints,
        .condition = "momenta are projected; the tableaus are Gauss with one stage and Lobatto",
        .evidence = {"equivalence_constrained.csv", "equivalence_constrained_lobatto.csv"}},
       {.id = "momentum",
        .where = "section 1, DMOCC; eq:noether_force_d",
        .states = "with constraints g(q) = 0, the change in momentum equals the work of the forces for DMOC and "
                  "Hamiltonian collocation, not for tangent-space collocation",
        .judge = momentum_with_constraints,
        .condition = "off the constraint manifold, too, the force along the symmetry is the intended force",
        .evidence = {"consistency_constrained.csv"}},
       {.id = "costs",
        .where = "section 1, DMOCC",
        .states = "the optimal costs in redundant and in minimal coordinates agree to ten digits",
        .judge = costs_with_constraints,
        .evidence = {"objective_constrained.csv"}},
       {.id = "embedding",
        .where = "section 1, DMOCC",
        .states = "for DMOC with one Gauss stage, an embedding q = Φ(θ) at the nodes has the same optimal costs as "
                  "multipliers, with fewer unknowns and constraints",
        .judge = embedding_with_constraints,
        .evidence = {"objective_forms.csv", "figures/constraint_forms.svg"}},
       {.id = "velocity_equal_solutions",
        .where = "section 1, nonholonomic constraints; th:equi",
        .states = "with velocity constraints A(q) q̇ = 0, DMOC and Hamiltonian collocation have equal solutions",
        .judge = equal_with_velocity_constraints,
        .condition = "momenta are projected; the tableau is Gauss with one stage",
        .evidence = {"equivalence_velocity_constraints.csv"}},
       {.id = "velocity_momentum",
        .where = "section 1, nonholonomic constraints; eq:noether_force_d",
        .states = "with velocity constraints, the change in momentum equals the work of the forces and the impulses of "
                  "the forces of constraint for DMOC and Hamiltonian collocation, not for tangent-space collocation",
        .judge = momentum_with_velocity_constraints,
        .condition = "L_vv depends on q; where L_vv is constant, tangent-space collocation with one Gauss stage keeps "
                     "this balance, too",
        .evidence = {"consistency_velocity_constraints.csv"}},
       {.id = "velocity_orders",
        .where = "section 1, nonholonomic constraints; main_theorem",
        .states = "for velocity constraints and one Gauss stage, states, momenta, costates and cost have order 2",
        .judge = orders_with_velocity_constraints,
        .evidence = {"convergence_velocity_constraints_slopes.csv"}}});
}

}  // namespace dmocbench
