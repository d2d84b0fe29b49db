// All predicates, in one place: what must be true of the tables for a claim of the paper to count as reproduced.
#include "bench/claims/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/experiment/solve_case.hpp"

namespace dmocbench {

namespace {

constexpr const char* orbit = "orbital_transfer";
constexpr const char* two_link = "two_link_manipulator";

using Rows = std::vector<const Row*>;

Verdict verdict_of(bool holds) { return holds ? Verdict::reproduced : Verdict::differs; }

bool is_midpoint(const Row& row) { return row.text("tableau") == "gauss" && row.text("stages") == "1"; }

/// Midpoint rows of one method.
Rows midpoint_rows(const Rows& rows, const std::string& method) {
  Rows result;
  for (const Row* row : rows) {
    if (is_midpoint(*row) && row->text("method") == method) result.push_back(row);
  }
  return result;
}

/// The row on a grid, if it was solved on the wanted branch.
const Row* on_grid(const Rows& rows, double intervals) {
  for (const Row* row : rows) {
    if (row->number("intervals") == intervals && is_usable(*row)) return row;
  }
  return nullptr;
}

std::size_t count_unusable(const Rows& rows) {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const Row* row) { return !is_usable(*row); }));
}

/// The largest entry of a column; infinity if one is missing.
double largest(const Rows& rows, const std::string& column) {
  double result = 0.0;
  for (const Row* row : rows) {
    result = std::max(result, row->number(column).value_or(std::numeric_limits<double>::infinity()));
  }
  return result;
}

// --- Convergence: "For all three methods the convergence rate ... is O(h^2)"
// -------------------------------------------

constexpr double lowest_slope_of_order_two = 1.9;
constexpr double highest_slope_of_order_two = 2.1;
constexpr double fewest_points = 3;

Claim slope_claim(const ResultTables& tables, const std::string& problem, const std::string& quantity,
                  const std::string& table) {
  const bool against_paper = table != "convergence_slopes";
  Claim claim{.id = fmt::format("{}/{}_slope{}", problem, quantity, against_paper ? "_against_512" : ""),
              .where = problem == orbit ? "fig:kepler_error" : "fig:twolink_error",
              .paper = against_paper ? "O(h^2) for all three methods, against N = 512" : "O(h^2) for all three methods",
              .measured = "",
              .verdict = Verdict::not_yet};
  std::vector<std::string> found;
  bool holds = true;
  for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
    for (const Row* row : midpoint_rows(tables.rows(table, problem), method)) {
      if (row->text("quantity") != quantity) continue;
      const double slope = row->number("slope").value_or(0.0);
      found.push_back(fmt::format("{} {:.3f}", method, slope));
      holds = holds && slope > lowest_slope_of_order_two && slope < highest_slope_of_order_two &&
              row->number("points").value_or(0.0) >= fewest_points;
    }
  }
  if (found.empty()) return claim;
  claim.measured = fmt::format("slopes {}", fmt::join(found, ", "));
  if (against_paper) claim.measured += " (an error against N_ref is c(h^2 - h_ref^2): slopes come out too large)";
  claim.verdict = verdict_of(holds && found.size() == 3);
  return claim;
}

// --- Momentum-force consistency: "to numerical accuracy" for DMOC and Hamiltonian, not for tangent-space
// ----------------

/// Rounding of a momentum difference, relative to the work of the forces over one interval or absolute.
constexpr double rounding_of_balance = 1e-11;
/// Tangent-space collocation has to miss the balance by this factor on the coarsest grid to "fail to capture" it.
constexpr double clearly_larger = 1e3;

Claim consistency_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{
      .id = problem + "/momentum_consistency",
      .where = problem == orbit ? "fig:kepler_J" : "fig:twolink_obj b)",
      .paper =
          "change in momentum equals the forces to numerical accuracy for DMOC and Hamiltonian collocation, not "
          "for tangent-space collocation",
      .measured = "",
      .verdict = Verdict::not_yet};
  const Rows rows = tables.rows("consistency", problem);
  const Rows dmoc = midpoint_rows(rows, "dmoc");
  const Rows hamiltonian = midpoint_rows(rows, "hamiltonian");
  const Rows tangent = midpoint_rows(rows, "tangent");
  if (dmoc.empty() || hamiltonian.empty() || tangent.empty()) return claim;
  const auto relative_defect = [](const Rows& of_method) {
    double worst = 0.0;
    for (const Row* row : of_method) {
      const double defect = row->number("momentum_defect_max").value_or(std::numeric_limits<double>::infinity());
      worst = std::max(worst, defect / std::max(1.0, row->number("largest_force").value_or(1.0)));
    }
    return worst;
  };
  const double structured = std::max(relative_defect(dmoc), relative_defect(hamiltonian));
  const double defect_of_tangent = largest({tangent.front()}, "momentum_defect_max");
  const double defect_of_dmoc = largest({dmoc.front()}, "momentum_defect_max");
  const std::size_t unusable = count_unusable(dmoc) + count_unusable(hamiltonian) + count_unusable(tangent);
  claim.measured = fmt::format(
      "largest defect of an interval over all N: dmoc {:.1e}, hamiltonian {:.1e}; tangent {:.1e} at N = {} to {:.1e} "
      "at N = "
      "{}",
      largest(dmoc, "momentum_defect_max"), largest(hamiltonian, "momentum_defect_max"), defect_of_tangent,
      tangent.front()->text("intervals"), largest({tangent.back()}, "momentum_defect_max"),
      tangent.back()->text("intervals"));
  claim.verdict = verdict_of(unusable == 0 && structured < rounding_of_balance &&
                             defect_of_tangent > clearly_larger * std::max(defect_of_dmoc, rounding_of_balance * 1e-3));
  return claim;
}

// --- Equal solutions: "Obviously, we obtain equal solutions by applying both methods"
// -----------------------------------

constexpr double equal_solutions_tolerance = 1e-9;
constexpr double foreign_rows_tolerance = 1e-10;

Claim equality_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/equal_solutions",
              .where = "th:equi, ex:RK a)",
              .paper = "DMOC and Hamiltonian midpoint collocation have equal solutions",
              .measured = "",
              .verdict = Verdict::not_yet};
  const Rows rows = midpoint_rows(tables.rows("equivalence", problem), "hamiltonian");
  if (rows.empty()) return claim;
  const double configuration = largest(rows, "configuration_difference");
  const double objective = largest(rows, "objective_difference");
  bool rows_agree = true;
  for (const Row* row : rows) {
    const auto left = [&](const char* violation, const char* rounding) {
      const auto value = row->number(violation);
      return value && *value < std::max(foreign_rows_tolerance, row->number(rounding).value_or(0.0));
    };
    rows_agree = rows_agree && left("violation_in_rows_of_dmoc", "rounding_in_rows_of_dmoc") &&
                 left("violation_of_dmoc_here", "rounding_here");
  }
  claim.measured =
      fmt::format("on {} grids, relative: q {:.0e}, p {:.0e}, u {:.0e}, J {:.0e}; answers in the other's rows leave {}",
                  rows.size(), configuration, largest(rows, "momentum_difference"), largest(rows, "control_difference"),
                  objective, rows_agree ? "rounding" : "more than rounding");
  claim.verdict = verdict_of(configuration < equal_solutions_tolerance && objective < equal_solutions_tolerance &&
                             rows_agree && count_unusable(rows) == 0);
  return claim;
}

Claim difference_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{
      .id = problem + "/tangent_differs",
      .where = "section 4.2",
      .paper = "collocation on the tangent space is another discretisation: its solutions are not those of DMOC",
      .measured = "",
      .verdict = Verdict::not_yet};
  const Rows rows = midpoint_rows(tables.rows("equivalence", problem), "tangent");
  if (rows.size() < 2) return claim;
  const double coarse = largest({rows.front()}, "configuration_difference");
  const double fine = largest({rows.back()}, "configuration_difference");
  claim.measured = fmt::format("relative difference in q {:.1e} at N = {}, {:.1e} at N = {}", coarse,
                               rows.front()->text("intervals"), fine, rows.back()->text("intervals"));
  claim.verdict =
      verdict_of(fine > equal_solutions_tolerance / 10.0 && coarse > clearly_larger * equal_solutions_tolerance &&
                 fine < coarse && count_unusable(rows) == 0);
  return claim;
}

// --- Size: "DMOC only uses 3/5 (2/3) of the number of variables"
// -------------------------------------------------------

/// Boundary values make the ratio of a finite grid differ from the limit by a few over N.
constexpr double nodes_at_the_ends = 4.0;

Claim variable_claim(const ResultTables& tables, const std::string& problem) {
  const double stated = problem == orbit ? 3.0 / 5.0 : 2.0 / 3.0;
  Claim claim{
      .id = problem + "/variable_ratio",
      .where = problem == orbit ? "section 4.2.1, rem:savings" : "section 4.2.2, rem:savings",
      .paper = problem == orbit ? "DMOC uses 3/5 of the variables of collocation" : "DMOC uses 2/3 of the variables",
      .measured = "",
      .verdict = Verdict::not_yet};
  const Rows rows = tables.rows("convergence", problem);
  const Rows dmoc = midpoint_rows(rows, "dmoc");
  if (dmoc.empty()) return claim;
  const Row& finest = *dmoc.back();
  const double intervals = finest.number("intervals").value_or(0.0);
  bool holds = true;
  std::vector<std::string> found;
  for (const char* method : {"hamiltonian", "tangent"}) {
    const Row* other = on_grid(midpoint_rows(rows, method), intervals);
    if (other == nullptr) return claim;
    const double ratio = finest.number("free_variables").value_or(0.0) / other->number("free_variables").value_or(0.0);
    found.push_back(fmt::format("{:.4f} of {}", ratio, method));
    holds = holds && std::abs(ratio - stated) < nodes_at_the_ends / intervals;
  }
  claim.measured = fmt::format("free variables at N = {}: {}", intervals, fmt::join(found, ", "));
  claim.verdict = verdict_of(holds);
  return claim;
}

// --- Cost over N: tangent-space "performs equally well with respect to the objective value evolution"
// --------------------

constexpr double equally_well = 2.0;

Claim objective_claim(const ResultTables& tables, const std::string& problem) {
  Claim claim{.id = problem + "/objective_evolution",
              .where = problem == orbit ? "(not shown in the paper)" : "fig:twolink_obj a)",
              .paper = "DMOC and Hamiltonian have identical cost; tangent-space collocation performs equally well",
              .measured = "",
              .verdict = Verdict::not_yet};
  const Rows rows = tables.rows("objective", problem);
  const Rows dmoc = midpoint_rows(rows, "dmoc");
  if (dmoc.size() < 2) return claim;
  const double limit = dmoc.back()->number("objective").value_or(0.0);
  double identical = 0.0;
  double worst_ratio = 0.0;
  for (const Row* row : dmoc) {
    const double intervals = row->number("intervals").value_or(0.0);
    const Row* hamiltonian = on_grid(midpoint_rows(rows, "hamiltonian"), intervals);
    const Row* tangent = on_grid(midpoint_rows(rows, "tangent"), intervals);
    if (hamiltonian == nullptr || tangent == nullptr || !is_usable(*row)) {
      claim.measured = fmt::format("not all methods are solved on the same branch at N = {}", intervals);
      claim.verdict = Verdict::differs;
      return claim;
    }
    const double of_dmoc = row->number("objective").value_or(0.0);
    identical = std::max(identical, std::abs(hamiltonian->number("objective").value_or(0.0) / of_dmoc - 1.0));
    const double error = std::abs(of_dmoc - limit);
    const double error_of_tangent = std::abs(tangent->number("objective").value_or(0.0) - limit);
    const double scale = std::max(error, 1e-6 * std::abs(limit));
    worst_ratio = std::max(worst_ratio, error_of_tangent / scale);
  }
  claim.measured = fmt::format(
      "J of dmoc and hamiltonian differ by {:.0e} relative; error of tangent at most {:.2f} times that of dmoc",
      identical, worst_ratio);
  claim.verdict = verdict_of(identical < equal_solutions_tolerance && worst_ratio < equally_well);
  return claim;
}

// --- The reference grids' steps, as the paper prints them
// ---------------------------------------------------------------

Claim step_claim(const ResultTables& tables, const std::string& problem) {
  const bool is_orbit = problem == orbit;
  const double printed = is_orbit ? 2.9e-3 : 1.9e-3;
  const double intervals = is_orbit ? 1024.0 : 512.0;
  constexpr double last_digit = 1e-4;
  Claim claim{.id = problem + "/reference_step",
              .where = is_orbit ? "section 4.2.1" : "section 4.2.2",
              .paper = is_orbit ? "h = 2.9e-3 at N = 1024" : "h = 1.9e-3 at N = 512",
              .measured = "",
              .verdict = Verdict::not_yet};
  const Row* row = on_grid(midpoint_rows(tables.rows("convergence", problem), "dmoc"), intervals);
  if (row == nullptr) return claim;
  const double step = row->number("step").value_or(0.0);
  claim.measured = fmt::format("h = {:.4e} {}", step, is_orbit ? "h" : "s (1.9 if cut, 2.0 if rounded)");
  claim.verdict = verdict_of(std::abs(step - printed) < last_digit);
  return claim;
}

// --- Slips: statements of the paper that cannot be meant as printed
// ------------------------------------------------------

/// A slip is confirmed if what is printed differs from what must hold by far more than rounding; the verdict on the
/// printed statement is then "differs".
Claim slip_claim(const Row& row) {
  const double printed = row.number("value_as_printed").value_or(std::numeric_limits<double>::quiet_NaN());
  const double meant = row.number("value_as_meant").value_or(std::numeric_limits<double>::quiet_NaN());
  const double required = row.number("required_value").value_or(std::numeric_limits<double>::quiet_NaN());
  constexpr double tolerance = 1e-6;
  return {.id = row.text("problem") + "/" + row.text("slip"),
          .where = row.text("where"),
          .paper = row.text("printed"),
          .measured = fmt::format("{}: {:.6g} as printed, {:.6g} as meant ({}), {:.6g} required", row.text("quantity"),
                                  printed, meant, row.text("meant"), required),
          .verdict = verdict_of(std::abs(printed - required) < tolerance * std::max(1.0, std::abs(required)))};
}

// --- Statements without an experiment so far
// -----------------------------------------------------------------------------

std::vector<Claim> claims_without_experiment() {
  const auto open = [](const std::string& id, const char* where, const char* paper) {
    return Claim{
        .id = id, .where = where, .paper = paper, .measured = "no experiment yet", .verdict = Verdict::not_yet};
  };
  const std::string o = orbit;
  const std::string t = two_link;
  return {
      open(o + "/minor_iteration_ratio", "fig:kepler_iterations", "DMOC needs about 1.7 times fewer minor iterations"),
      open(t + "/minor_iteration_ratio", "fig:twolink_iterations", "DMOC needs about 1.5 times fewer minor iterations"),
      open(o + "/minor_iterations_equal_variable_ratio", "section 4.2.1",
           "in exact agreement with the number of variables"),
      open(o + "/automatic_differentiation", "section 4.1", "faster and more robust than finite differences"),
      open(t + "/automatic_differentiation", "section 4.1", "faster and more robust than finite differences"),
      open(t + "/order_of_adjoint_scheme", "th:orderapp", "the adjoint scheme has the order of the state scheme"),
      open(t + "/order_of_convergence", "main_theorem", "order kappa for state, costate and u(x, psi) at the nodes"),
      open(t + "/order_of_consistency", "th:ordercalculation",
           "L_d, f_d and the Legendre transforms have the map's order"),
      open(o + "/forced_noether_theorem", "th:discforcNoe",
           "a force orthogonal to the group action keeps the momentum"),
      open(o + "/modified_energy", "section 2.2", "energy oscillates but does not drift"),
      open(t + "/local_minima", "section 4.1", "different initial guesses can lead to different solutions"),
  };
}

}  // namespace

std::vector<Claim> judge_claims(const ResultTables& tables) {
  std::vector<Claim> claims;
  for (const std::string problem : {orbit, two_link}) {
    claims.push_back(consistency_claim(tables, problem));
    claims.push_back(equality_claim(tables, problem));
    claims.push_back(difference_claim(tables, problem));
    claims.push_back(slope_claim(tables, problem, "state", "convergence_slopes"));
    claims.push_back(slope_claim(tables, problem, "control", "convergence_slopes"));
    if (problem == two_link) {
      claims.push_back(slope_claim(tables, problem, "state", "convergence_512_slopes"));
      claims.push_back(slope_claim(tables, problem, "control", "convergence_512_slopes"));
    }
    claims.push_back(objective_claim(tables, problem));
    claims.push_back(variable_claim(tables, problem));
    claims.push_back(step_claim(tables, problem));
  }
  for (const Row* row : tables.rows("slips")) claims.push_back(slip_claim(*row));
  for (Claim& claim : claims_without_experiment()) claims.push_back(std::move(claim));
  return claims;
}

}  // namespace dmocbench
