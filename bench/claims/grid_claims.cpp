// Section 4.2 over the grids: "for all three methods the convergence rate ... is O(h^2)", "DMOC only uses 3/5 (2/3) of
// the number of variables", the optimal cost over N, and the reference grids.
#include <cmath>

#include "bench/claims/claim.hpp"
#include "bench/experiment/solve_case.hpp"

namespace dmocbench {

namespace {

constexpr double lowest_order = 1.9;
constexpr double highest_order = 2.1;
constexpr double fewest_points = 3;

/// Boundary values make the ratio of a finite grid differ from the limit by a few over N.
constexpr double nodes_at_the_ends = 4.0;

constexpr double equally_well = 2.0;
constexpr double identical_costs = 1e-9;

/// Judges the slopes NAME_slopes that were fitted to a table of solves.
Predicate is_of_order_two(const std::string& solves, const char* quantity) {
  return [=](const ResultTables& tables, const std::string& problem) -> Finding {
    const Selection slopes = tables.rows(solves + "_slopes", problem).where("quantity", quantity);
    Selection orders;
    for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
      const Selection order = midpoint(slopes, method);
      require(!order.empty(), "{}_slopes.csv has no slope of {}, {}, {}", solves, problem, method, quantity);
      orders.append(order);
    }
    const auto is_two = [](const Row& row) {
      const double order = row.needed("slope");
      return order > lowest_order && order < highest_order && row.needed("points") >= fewest_points;
    };
    const auto words = [](const Row& row) { return fmt::format("{} {:.3f}", row.text("method"), row.needed("slope")); };
    return found(std::ranges::all_of(orders, is_two) && orders.size() == 3, "slopes {}{}", orders.in_words(", ", words),
                 unsolved_behind(tables, solves, {{"problem", problem}, {"tableau", "gauss"}, {"stages", "1"}}));
  };
}

Finding objective_evolution(const ResultTables& tables, const std::string& problem) {
  const Selection rows = tables.rows("objective", problem);
  const Selection dmoc = midpoint(rows, "dmoc");
  require(dmoc.size() > 1, "objective.csv has less than two grids of {} by dmoc", problem);
  const auto objective = [](const Row& row) { return row.needed("objective"); };
  double difference = 0.0;
  double error_ratio = 0.0;
  for (const Row& row : dmoc) {
    const Selection hamiltonian = midpoint(rows, "hamiltonian").usable().matching(row, {"intervals"});
    const Selection tangent = midpoint(rows, "tangent").usable().matching(row, {"intervals"});
    if (hamiltonian.empty() || tangent.empty() || !is_usable(row)) {
      return found(false, "not all methods are solved on the same branch at N = {}", row.text("intervals"));
    }
    difference = std::max(difference, std::abs(quotient(hamiltonian.front(), row, "objective") - 1.0));
    const double limit = objective(dmoc.back());
    const double error = std::max(std::abs(objective(row) - limit), 1e-6 * std::abs(limit));
    error_ratio = std::max(error_ratio, std::abs(objective(tangent.front()) - limit) / error);
  }
  return found(
      difference < identical_costs && error_ratio < equally_well,
      "J of dmoc and hamiltonian differ by {:.0e} relative; error of tangent at most {:.2f} times that of dmoc",
      difference, error_ratio);
}

Finding variable_ratio(const ResultTables& tables, const std::string& problem) {
  const double stated = problem == orbit ? 3.0 / 5.0 : 2.0 / 3.0;
  const Selection rows = tables.rows("convergence", problem);
  const Row& dmoc = midpoint(rows, "dmoc").back();
  Selection collocation;
  for (const char* method : {"hamiltonian", "tangent"}) {
    const Selection finest = midpoint(rows, method).usable().matching(dmoc, {"intervals"});
    require(!finest.empty(), "convergence.csv: {} by {} is not solved at N = {}, where dmoc is", problem, method,
            dmoc.text("intervals"));
    collocation.append(finest.front());
  }
  const auto ratio_to_dmoc = [&](const Row& row) { return quotient(dmoc, row, "free_variables"); };
  const auto is_as_stated = [&](const Row& row) {
    return std::abs(ratio_to_dmoc(row) - stated) < nodes_at_the_ends / dmoc.needed("intervals");
  };
  const auto in_words = [&](const Row& row) {
    return fmt::format("{:.4f} of {}", ratio_to_dmoc(row), row.text("method"));
  };
  return found(std::ranges::all_of(collocation, is_as_stated), "free variables at N = {}: {}", dmoc.text("intervals"),
               collocation.in_words(", ", in_words));
}

Finding reference_step(const ResultTables& tables, const std::string& problem) {
  constexpr double last_digit = 1e-4;
  const bool is_orbit = problem == orbit;
  const char* const intervals = is_orbit ? "1024" : "512";
  const Selection grid = midpoint(tables.rows("convergence", problem), "dmoc").usable().where("intervals", intervals);
  require(!grid.empty(), "convergence.csv: {} by dmoc is not solved at N = {}", problem, intervals);
  const double step = grid.front().needed("step");
  return found(std::abs(step - (is_orbit ? 2.9e-3 : 1.9e-3)) < last_digit, "h = {:.4e} {}", step,
               is_orbit ? "h" : "s (1.9 if cut, 2.0 if rounded)");
}

}  // namespace

Claims grid_claims() {
  const Wording section{"section 4.2.1", "section 4.2.2"};
  const Wording figure{"fig:kepler_error", "fig:twolink_error"};
  const char* const second_order = "O(h^2) for all three methods";
  const char* const against_512 = "O(h^2) for all three methods, against N = 512";
  const char* const too_large = "an error against N_ref is c(h^2 - h_ref^2): slopes come out too large";
  const auto objective = [](Problems problems, Wording where, Wording shown_in, Whose whose) {
    return Claim{.id = "objective_evolution",
                 .problems = std::move(problems),
                 .where = where,
                 .figure = shown_in,
                 .whose = whose,
                 .states = "DMOC and Hamiltonian have identical cost; tangent-space collocation performs equally well",
                 .judge = objective_evolution,
                 .evidence = {"objective.csv", "figures/{}_objective.svg"}};
  };
  return {
      {.id = "state_slope",
       .problems = of_paper,
       .where = section,
       .figure = figure,
       .whose = Whose::paper,
       .states = second_order,
       .judge = is_of_order_two("convergence", "state"),
       .evidence = {"convergence_slopes.csv", "convergence.csv", "figures/{}_state_error.svg"}},
      {.id = "control_slope",
       .problems = of_paper,
       .where = section,
       .figure = figure,
       .whose = Whose::paper,
       .states = second_order,
       .judge = is_of_order_two("convergence", "control"),
       .evidence = {"convergence_slopes.csv", "convergence.csv", "figures/{}_control_error.svg"}},
      {.id = "state_slope_against_512",
       .problems = only_two_link,
       .where = section,
       .figure = figure,
       .whose = Whose::paper,
       .states = against_512,
       .judge = is_of_order_two("convergence_512", "state"),
       .cause = too_large,
       .evidence = {"convergence_512_slopes.csv", "convergence_512.csv", "figures/{}_state_error_512.svg"}},
      {.id = "control_slope_against_512",
       .problems = only_two_link,
       .where = section,
       .figure = figure,
       .whose = Whose::paper,
       .states = against_512,
       .judge = is_of_order_two("convergence_512", "control"),
       .cause = too_large,
       .evidence = {"convergence_512_slopes.csv", "convergence_512.csv", "figures/{}_control_error_512.svg"}},
      objective(only_orbit, "section 4.2.2, for the other problem", "", Whose::ours),
      objective(only_two_link, "section 4.2.2", "fig:twolink_obj a)", Whose::paper),
      {.id = "variable_ratio",
       .problems = of_paper,
       .where = Wording("section 4.2.1, rem:savings", "section 4.2.2, rem:savings"),
       .whose = Whose::paper,
       .states = Wording("DMOC uses 3/5 of the variables of collocation", "DMOC uses 2/3 of the variables"),
       .judge = variable_ratio,
       .evidence = {"convergence.csv"}},
      {.id = "reference_step",
       .problems = of_paper,
       .where = section,
       .whose = Whose::paper,
       .states = Wording("h = 2.9e-3 at N = 1024", "h = 1.9e-3 at N = 512"),
       .judge = reference_step,
       .condition = Wording("the paper prints neither the number of revolutions nor the unit of time; two revolutions "
                            "and hours are chosen so that this holds",
                            "it follows from the horizon of 1 s"),
       .evidence = {"convergence.csv"}},
  };
}

}  // namespace dmocbench
