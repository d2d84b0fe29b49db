#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "methods/transcription/elements/families.hpp"
#include "tests/bench/challenge_tables_for_claims.hpp"
#include "tests/bench/tables_for_claims.hpp"

// The tables that claims read, as a run that reproduces all of them would write them.
namespace dmocbench::tests {

/// Which rows.
using Where = std::function<bool(const Row&)>;
inline Where has(const std::string& column, const std::string& text) {
  return [=](const Row& row) { return row.text(column) == text; };
}

inline Rows momentum_rows() {
  Rows rows;
  for (const std::string force : {"along", "orthogonal"}) {
    const bool along = force == "along";
    for (const char* stages : {"1", "2"}) {
      rows.push_back(
          row_of_texts({"problem", "method", "tableau", "stages", "force", "steps", "h", "momentum_change", "work",
                        "work_of_discrete_forces", "defect", "defect_in_long_double"},
                       {"radial_thrust", "dmoc", "gauss", stages, force, "400", "0.05", along ? "0.5" : "1e-13",
                        along ? "0.5" : "0", along ? "0.5" : "0", "1e-13", "1e-16"}));
    }
  }
  return rows;
}

inline Rows symplecticity_rows() {
  Rows rows;
  for (const std::string& method : paper_families()) {
    rows.push_back(
        row_of_texts({"problem", "method", "tableau", "stages", "h", "defect", "rounding"},
                     {"kepler", method, "gauss", "1", "0.05", method == "tangent" ? "1e-3" : "2e-15", "1e-15"}));
  }
  return rows;
}

inline Rows flow_momentum_rows() {
  const ColumnNames columns{"problem", "force", "horizon", "tolerance", "momentum_change", "work"};
  return rows_of_texts(columns, {{"radial_thrust", "orthogonal", "10", "1e-12", "1e-13", "0"},
                                 {orbit, "along", "10", "1e-12", "0.5", "0.5"}});
}

inline Rows flow_symplecticity_rows() {
  return rows_of_texts({"problem", "horizon", "defect", "rounding", "printed_change"},
                       {{"kepler", "1", "2e-15", "1e-15", "0"}, {orbit, "1", "3e-15", "1e-15", "0.4"}});
}

inline Rows energy_rows() {
  Rows rows;
  for (const std::string method : {"dmoc", "explicit_midpoint", "runge_kutta_4"}) {
    rows.push_back(row_of_texts(
        {"problem", "method", "tableau", "stages", "order", "steps_per_period", "periods", "oscillation", "range",
         "change"},
        {"kepler", method, "gauss", "1", "2", "64", "10000", "1e-3", "1e-3", method == "dmoc" ? "1e-6" : "0.5"}));
  }
  return rows;
}

inline Rows consistency_order_rows() {
  Rows rows;
  for (const char* quantity : {"lagrangian", "map", "left_force", "right_force", "left_legendre", "right_legendre"}) {
    rows.push_back(row_of_texts({"problem", "tableau", "stages", "order", "quantity", "slope", "standard_error"},
                                {orbit, "gauss", "1", "2", quantity, "3.01", "0.01"}));
  }
  return rows;
}

/// Slopes of three truncations; tangent-space collocation has order 2 whatever the truncation.
inline Rows truncation_rows(const char* problem, const std::vector<std::string>& quantities, const char* method) {
  Rows rows;
  for (const std::string& quantity : quantities) {
    for (const char* truncation : {"2", "4", "6"}) {
      const bool is_tangent = std::string(method) == "tangent" || quantity == "gap_to_work";
      rows.push_back(row_of_texts(
          {"problem", "method", "tableau", "stages", "quantity", "truncation", "slope", "standard_error", "mass"},
          {problem, method, "gauss", "1", quantity, truncation, is_tangent ? "2" : truncation, "0.01", "moving"}));
    }
  }
  return rows;
}

inline Rows drift_rows() {
  Rows rows = truncation_rows("radial_thrust", {"drift"}, "dmoc");
  std::ranges::copy(truncation_rows("radial_thrust", {"drift"}, "tangent"), std::back_inserter(rows));
  return rows;
}

inline Rows energy_work_rows() {
  return rows_of_texts({"problem", "method", "tableau", "stages", "intervals", "largest_gap"},
                       {{orbit, "dmoc", "gauss", "1", "32", "4e-9"},
                        {orbit, "tangent", "gauss", "1", "32", "4e-8"},
                        {orbit, "dmoc", "gauss", "1", "64", "1e-9"},
                        {orbit, "tangent", "gauss", "1", "64", "1e-8"}});
}

inline Rows orthogonal_rows() {
  const ColumnNames columns{"problem", "method", "tableau", "stages", "intervals", "momentum_deviation", "rounding"};
  return rows_of_texts(columns, {{"radial_thrust", "dmoc", "gauss", "1", "64", "1e-14", "2e-14"},
                                 {"radial_thrust", "tangent", "gauss", "1", "64", "1e-4", "2e-14"}});
}

inline Rows rotation_rows() {
  Rows rows;
  for (const char* axis : {"1", "2", "3"}) {
    const auto append = [&](const char* action, const char* method, const char* defect) {
      rows.push_back(row_of_texts({"problem", "method", "tableau", "stages", "action", "axis", "work", "defect"},
                                  {action, method, "gauss", "1", action, axis, "-0.01", defect}));
    };
    append("linear", "dmoc", "1e-18");
    append("linear", "tangent", "1e-5");
    append("polar", "dmoc", "1e-3");
  }
  return rows;
}

inline Rows transform_rows() {
  return rows_of_texts(
      {"problem", "h", "left_defect", "right_defect", "largest_momentum", "force_error", "force_error_curl"},
      {{orbit, "0.1", "1e-13", "1e-13", "2", "1e-4", "1e-12"}});
}

inline Rows smoothness_rows() {
  Rows rows;
  const auto append = [&](const char* situation, const char* active, const char* end, const char* stages,
                          const char* quantity, const char* slope) {
    rows.push_back(row_of_texts({"situation", "active", "end", "problem", "method", "tableau", "stages", "order",
                                 "quantity", "slope", "standard_error"},
                                {situation, active, end, "any", "dmoc", "gauss", stages,
                                 std::string(stages) == "1" ? "2" : "4", quantity, slope, "0.01"}));
  };
  for (const char* quantity : {"state", "costate_q", "costate_p", "node_control"}) {
    append("two_link_free_end", "nothing", "free", "1", quantity, "2.01");
    append("two_link_free_end", "nothing", "free", "2", quantity, "4.01");
    append("two_link_bounded", "control", "fixed", "1", quantity, "2.02");
    append("beam", "state", "fixed", "1", quantity, std::string(quantity) == "costate_q" ? "0.01" : "2.03");
  }
  append("two_link_bounded", "control", "fixed", "2", "state", "2.1");
  append("beam", "state", "fixed", "1", "control", "0.98");
  return rows;
}

inline Rows coercivity_rows() {
  Rows rows;
  const auto append = [&](const char* problem, const char* end, const char* intervals, const char* curvature) {
    rows.push_back(
        row_of_texts({"problem", "method", "tableau", "stages", "end", "status", "intervals", "smallest_curvature"},
                     {problem, "dmoc", "gauss", "1", end, "solved", intervals, curvature}));
  };
  for (const char* end : {"stated", "free"}) {
    append(orbit, end, "16", "1.99");
    append(orbit, end, "64", "1.998");
    append(orbit, end, "256", "1.999");
  }
  append("brachistochrone", "stated", "16", "1e-2");
  append("brachistochrone", "stated", "64", "1e-3");
  append("brachistochrone", "stated", "256", "1e-4");
  return rows;
}

inline Rows advantage_rows() {
  Rows rows;
  const auto append = [&](const char* solver, const char* factorisation, const char* quantity) {
    for (const char* intervals : {"64", "128", "256"}) {
      rows.push_back(
          row_of_texts({"problem", "method", "tableau", "stages", "solver", "factorisation", "intervals", "quantity",
                        "ratio_at_equal_intervals"},
                       {orbit, "hamiltonian", "gauss", "1", solver, factorisation, intervals, quantity, "1.5"}));
      rows.back().set("round_ratios", rounds_around(1.5));
    }
  };
  append("ipopt", "", "seconds_per_iteration");
  for (const char* factorisation : {"intervals", "sparse"})
    append("interior_point", factorisation, "seconds_per_linear_system");
  return rows;
}

inline const ColumnNames of_minima{"problem", "tableau", "stages", "solver", "derivatives", "intervals", "minimum"};

inline Rows minima_rows() {
  ColumnNames columns = of_minima;
  columns.insert(columns.end(), {"is_motion", "objective", "dmoc", "hamiltonian", "tangent"});
  Rows rows;
  for (const char* problem : {orbit, two_link}) {
    for (const char* minimum : {"1", "2"}) {
      rows.push_back(row_of_texts(columns, {problem, "gauss", "1", "ipopt", "tape", "48", minimum, "yes",
                                            std::string(minimum) == "1" ? "80.5" : "90.5", "3", "2", "0"}));
    }
  }
  return rows;
}

inline Rows share_rows() {
  Rows rows;
  for (const char* problem : {orbit, two_link}) {
    for (const char* method : {"dmoc", "tangent"}) {
      rows.push_back(row_of_texts(
          {"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals", "starts", "solved"},
          {problem, method, "gauss", "1", "ipopt", "tape", "48", "100", "90"}));
    }
  }
  return rows;
}

inline Rows inequality_rows() {
  Rows rows;
  for (const char* problem : {"container_crane", "robot_arm"}) {
    for (Row& row : equivalence_rows()) {
      if (row.text("method") != "hamiltonian") continue;
      row.set("problem", problem);
      row.set("horizon_difference", 1e-16);
      row.set("polish_steps", 2LL);
      rows.push_back(row);
    }
  }
  return rows;
}

/// Answers of Hamiltonian collocation with constraints g(q) = 0, by Gauss or by Lobatto.
inline Rows constrained_rows(const std::string& tableau) {
  Rows rows;
  for (Row& row : equivalence_rows()) {
    if (row.text("method") != "hamiltonian" || row.text("tableau") != tableau) continue;
    row.set("problem", "cart_pole_cartesian");
    rows.push_back(row);
  }
  return rows;
}

/// The same of phases, with one stage and with two.
inline Rows phase_rows() {
  Rows rows;
  for (const long long stages : {1LL, 2LL}) {
    for (Row& row : constrained_rows("gauss")) {
      row.set("problem", "bouncing_hopper");
      row.set("stages", stages);
      rows.push_back(row);
    }
  }
  return rows;
}

/// Impacts with and without force by all conditions, or their orders.
inline Rows impact_rows(bool are_orders) {
  Rows rows;
  for (const char* force : {"none", "drag"}) {
    for (const char* condition : {"momenta", "steps", "steps_and_work"}) {
      for (const char* stages : {"1", "2"}) {
        const bool has_full_order = force == std::string("none") || condition == std::string("momenta");
        const std::string order = has_full_order                      ? stages == std::string("1") ? "2.01" : "4.01"
                                  : condition == std::string("steps") ? "0.99"
                                                                      : "1.97";
        rows.push_back(are_orders ? row_of_texts({"problem", "method", "tableau", "stages", "force", "condition",
                                                  "quantity", "slope", "standard_error"},
                                                 {"bouncing_particle", "dmoc", "gauss", stages, force, condition,
                                                  "state_error", order, "0.01"})
                                  : row_of_texts({"problem", "method", "tableau", "stages", "force", "condition",
                                                  "steps", "energy_change"},
                                                 {"bouncing_particle", "dmoc", "gauss", stages, force, condition, "64",
                                                  condition == std::string("momenta") ? "1e-16" : "1e-3"}));
      }
    }
  }
  return rows;
}

/// Costs of order 4 in both statements of four problems.
inline Rows constrained_cost_rows() {
  Rows rows;
  for (const char* problem :
       {"spherical_pendulum", "cart_pole", "two_link_manipulator", "link_chain", "spherical_pendulum_cartesian",
        "cart_pole_cartesian", "two_link_maximal", "link_chain_maximal"}) {
    for (const long long intervals : {256LL, 2048LL}) {
      Row row = solved_row("dmoc", intervals);
      const bool is_redundant = rows.size() >= 8;
      row.set("problem", problem);
      row.set("tableau", "lobatto");
      row.set("stages", 3LL);
      row.set("objective", 1.0 + (is_redundant ? 100.0 : 0.0) / std::pow(static_cast<double>(intervals), 4));
      rows.push_back(row);
    }
  }
  return rows;
}

/// Four mechanisms by multipliers, by embedding and in minimal coordinates.
inline Rows constraint_form_rows() {
  Rows rows;
  const auto add = [&](const std::string& problem, long long unknowns, const char* condition) {
    Row row = solved_row("dmoc", 64);
    row.set("problem", problem);
    row.set("objective", 1.0);
    row.set("free_variables", unknowns);
    row.set("constraints", unknowns - 64);
    row.set("major_iterations", 9LL);
    row.set("condition", condition);
    rows.push_back(row);
  };
  for (const char* problem : {"spherical_pendulum", "cart_pole", "two_link_manipulator", "link_chain"}) {
    add(problem, 192, "1e4");
  }
  for (const std::string problem :
       {"spherical_pendulum_cartesian", "cart_pole_cartesian", "two_link_maximal", "link_chain_maximal"}) {
    add(problem, 320, "1e6");
    add(problem + "_embedded", 192, "1e4");
  }
  return rows;
}

inline Rows symmetric_rows() {
  return rows_on_grids([](Row& row, bool /*tangent*/, double /*h*/) { row.set("costate_momentum_spread", 1e-13); });
}

inline Rows jump_rows() {
  return rows_of_texts({"problem", "method", "tableau", "stages", "error_of_jumps_coarsest", "error_of_jumps_finest",
                        "coarsest", "finest", "verdict"},
                       {{orbit, "dmoc", "gauss", "1", "0.19", "0.21", "20", "512", "slope"}});
}

inline Rows currency_rows() {
  const ColumnNames columns{"problem",
                            "method",
                            "tableau",
                            "stages",
                            "derivatives",
                            "tolerance",
                            "intervals",
                            "currency",
                            "ratio_at_equal_intervals",
                            "ratio_at_equal_accuracy"};
  return rows_of_texts(columns,
                       {{orbit, "tangent", "gauss", "1", "tape", "1e-06", "64", "ipopt_iterations", "1", "1.2"},
                        {orbit, "hamiltonian", "gauss", "1", "tape", "1e-06", "64", "factor_nonzeros", "2.1", ""},
                        {orbit, "hamiltonian", "gauss", "1", "tape", "1e-06", "128", "factor_nonzeros", "2.2", ""},
                        {orbit, "hamiltonian", "gauss", "1", "tape", "1e-06", "64", "kkt_nonzeros", "1.9", ""}});
}

inline Rows cold_start_rows() {
  Rows rows;
  for (const std::string& method : paper_families()) {
    rows.push_back(
        row_of_texts({"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals", "start_kind",
                      "starts", "confirmed", "best"},
                     {orbit, method, "gauss", "1", "interior_point", "tape", "64", "cold", "1000", "950", "900"}));
  }
  return rows;
}

/// Steps of both sequences, with more iterations and more time by collocation.
inline Rows sequence_rows() {
  Rows rows;
  for (const char* sequence : {"receding_horizon", "homotopy"}) {
    for (const std::string& method : methods) {
      for (int step = 1; step <= 12; ++step) {
        const bool is_dmoc = method == "dmoc";
        rows.push_back(row_of_texts({"problem", "method", "tableau", "stages", "intervals", "sequence", "step",
                                     "status", "iterations", "microseconds"},
                                    {orbit, method, "gauss", "1", "64", sequence, std::to_string(step), "solved",
                                     is_dmoc ? "4" : "5", is_dmoc ? "100" : "150"}));
      }
    }
  }
  return rows;
}

inline Rows profile_rows() {
  Rows rows;
  for (const std::string method : {"dmoc", "hamiltonian"}) {
    const char* const effort = method == "dmoc" ? "10" : "20";
    rows.push_back(row_of_texts(
        {"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals", "status", "success",
         "objective", "seconds", "evaluations", "major_iterations"},
        {"cart_pole", method, "gauss", "1", "ipopt", "tape", "32", "solved", "yes", "1.5", effort, effort, effort}));
  }
  return rows;
}

/// One problem where DMOC's steps are shortened, one where they are not.
inline Rows three_stages_rows() {
  const ColumnNames columns{"problem",     "method",      "tableau",         "stages", "solver",
                            "derivatives", "intervals",   "status",          "branch", "variables",
                            "objective",   "evaluations", "major_iterations"};
  const auto row = [&](const char* problem, const char* method, const char* variables, const char* evaluations,
                       const char* iterations) {
    return row_of_texts(columns, {problem, method, "gauss", "3", "interior_point", "tape", "128", "solved", "same",
                                  variables, "1.5", evaluations, iterations});
  };
  return {row("cart_pole", "dmoc", "100", "300", "30"), row("cart_pole", "hamiltonian", "160", "60", "10"),
          row("beam", "dmoc", "100", "60", "10"), row("beam", "hamiltonian", "150", "60", "10")};
}

/// Programs of one and two stages as (rem:savings) counts them.
inline Rows stages_rows() {
  Rows rows;
  for (const std::string method : {"dmoc", "hamiltonian"}) {
    for (const long long stages : {1LL, 2LL}) {
      Row row = solved_row(method, 16);
      const long long of_interval = 16 * stages;
      row.set("stages", stages);
      row.set("variables", (method == "dmoc" ? 2 : 4) * (of_interval + 1) + of_interval);
      row.set("constraints", method == "dmoc" ? 2 * (of_interval - 1) + 4 : 4 * of_interval);
      rows.push_back(row);
    }
  }
  return rows;
}

inline Rows equal_accuracy_rows() {
  Rows rows;
  for (const std::string& method : methods) {
    for (const char* quantity : {"state", "replay"}) {
      rows.push_back(row_of_texts({"problem", "method", "tableau", "stages", "quantity", "error", "variables_ratio"},
                                  {orbit, method, "gauss", "1", quantity, "0.001", method == "dmoc" ? "1" : "1.65"}));
    }
  }
  return rows;
}

/// The rows that a claim about another problem reads, made of those of the orbit.
inline void add_rows_of(Rows& rows, const char* problem, const std::function<bool(const Row&)>& wanted) {
  Rows more;
  std::ranges::copy_if(rows, std::back_inserter(more), wanted);
  for (Row& row : more) {
    row.set("problem", problem);
    rows.push_back(row);
  }
}

/// Orders of problems with first-order states.
inline Rows first_order_rows() {
  Rows rows;
  for (const char* problem : {"two_link_with_motors", "orbital_transfer_with_mass"}) {
    for (const std::string& method : methods) {
      for (const std::string quantity :
           {"state", "momentum", "costate", "first_order", "first_order_costate", "control_from_costate", "control"}) {
        for (Row& row : rows_by_tableau(scheme_row(method), [&](Row& row, double order) {
               const double s = row.needed("stages");
               const double of_stage = row.text("tableau") == "gauss" ? s + 1.0 : s - 1.0;
               row.set("problem", problem);
               row.set("quantity", quantity);
               row.set("verdict", "slope");
               row.set("slope", quantity == "control" ? of_stage : order);
               row.set("standard_error", 0.01);
             })) {
          rows.push_back(row);
        }
      }
    }
  }
  return rows;
}

inline TableRows all_rows() {
  TableRows rows = rows_of_tables();
  rows["convergence_512_slopes"] = rows["convergence_slopes"];
  for (Row& row : rows["convergence_512_slopes"]) row.set("problem", two_link);
  add_rows_of(rows["convergence_indirect_slopes"], two_link,
              [](const Row& row) { return row.text("method") == "dmoc" && row.text("quantity") == "control"; });
  rows["convergence_first_order_slopes"] = first_order_rows();
  rows["convergence_stage_controls_slopes"] = rows["convergence_first_order_slopes"];
  for (Row& row : rows["equivalence"]) {
    if (row.text("method") == "tangent") row.set("adjoint_residual", 1e-12);
  }
  add_rows_of(rows["equivalence"], oscillator, [](const Row& row) { return row.text("method") == "hamiltonian"; });
  for (Row& row : rows["equivalence"]) {
    if (row.text("problem") == oscillator) row.set("method", "tangent");
  }
  for (Row& row : rows["iterations"]) row.set("major_iterations", 4LL);
  rows["iterations_limited_memory"] = rows["iterations"];
  rows["iterations_limited_memory_by_cost"] = rows["iterations"];
  rows["iterations_bounds"] = rows["iterations"];
  for (Row& row : rows["iterations_bounds"]) row.set("predicted_minors", row.needed("minor_iterations") - 1.0);
  add_rows_of(rows["iterations_bounds"], oscillator, [](const Row& row) { return row.text("problem") == orbit; });
  rows["iterations_slsqp"] = rows["iterations"];
  for (Row& row : rows["iterations_slsqp"]) {
    row.set("solver", "nlopt");
    row.set("evaluations", row.needed("minor_iterations"));
    row.set("minor_iterations", Cell());
  }
  std::erase_if(rows["iterations_slsqp"], [](const Row& row) { return row.text("crash") == "basis"; });
  rows["convergence_stages"] = stages_rows();
  for (Row& row : rows["convergence_stages"]) {
    row.set("solver", "interior_point");
    row.set("objective", 4e-5);
  }
  for (Row& row : rows["convergence"]) {
    row.set("solver", "ipopt");
    row.set("objective", 4e-5);
  }
  rows["convergence_equal_accuracy"] = equal_accuracy_rows();
  rows["convergence_512"] = rows["convergence"];
  for (Row& row : rows["convergence_512"]) {
    row.set("problem", two_link);
    if (row.text("intervals") == "1024") row.set("intervals", 512LL);
  }
  rows["invariants_momentum"] = momentum_rows();
  rows["invariants_symplecticity"] = symplecticity_rows();
  rows["invariants_flow_momentum"] = flow_momentum_rows();
  rows["invariants_flow_symplecticity"] = flow_symplecticity_rows();
  rows["invariants_energy_behaviour"] = energy_rows();
  rows["consistency_order_slopes"] = consistency_order_rows();
  rows["invariants_modified_energy_slopes"] = drift_rows();
  rows["invariants_energy_work"] = energy_work_rows();
  rows["invariants_energy_work_slopes"] = truncation_rows(orbit, {"gap_to_work", "gap_to_modified_work"}, "dmoc");
  rows["invariants_orthogonal_forces"] = orthogonal_rows();
  rows["invariants_rotations"] = rotation_rows();
  rows["consistency_order_transforms"] = transform_rows();
  rows["smoothness_slopes"] = smoothness_rows();
  rows["low_thrust"] = low_thrust_rows();
  rows["primitives"] = primitives_rows();
  rows["step_control_symplecticity"] = step_control_rows(
      {"defect", "rounding"},
      {{"variational", {"2e-15", "1e-15"}}, {"imposed", {"1e-3", "1e-15"}}, {"from_left", {"1e-2", "1e-15"}}});
  rows["step_control_momentum"] = step_control_rows(
      {"work", "defect"},
      {{"variational", {"0.1", "1e-14"}}, {"imposed", {"0.1", "1e-14"}}, {"from_left", {"0.1", "1e-14"}}});
  rows["step_control_energy_behaviour"] = step_control_rows({"oscillation", "range", "change", "standard_error"},
                                                            {{"variational", {"1e-4", "1e-4", "1e-9", "1e-9"}},
                                                             {"imposed", {"1e-4", "1e-4", "1e-9", "1e-9"}},
                                                             {"from_left", {"1e-3", "1e-1", "1e-1", "1e-5"}}});
  rows["step_control"] =
      step_control_rows({"steps_per_period", "status", "state_error"},
                        {{"variational", {"128", "solved", "1e-3"}}, {"imposed", {"128", "solved", "1e-2"}}});
  rows["step_control_transfer"] = step_control_rows(
      {"intervals", "status", "cost_error", "variables"},
      {{"variational", {"64", "solved", "1e-3", "388"}}, {"imposed", {"64", "solved", "1e-2", "258"}}});
  rows["step_control_slopes"] = step_control_rows({"operations"}, {{"variational", {"240"}}, {"imposed", {"104"}}});
  rows["equivalence_inequalities"] = inequality_rows();
  rows["equivalence_symmetric"] = symmetric_rows();
  rows["equivalence_constrained"] = constrained_rows("gauss");
  rows["equivalence_constrained_lobatto"] = constrained_rows("lobatto");
  rows["consistency_constrained"] = rows["consistency"];
  rows["equivalence_velocity_constraints"] = constrained_rows("gauss");
  rows["consistency_velocity_constraints"] = rows["consistency"];
  rows["convergence_velocity_constraints_slopes"] =
      galerkin_slope_rows("gauss", {{"dmoc", "1", "2.01"}, {"tangent", "1", "1.98"}});
  rows["equivalence_phases"] = phase_rows();
  rows["consistency_phases"] = rows["consistency"];
  rows["invariants_impacts"] = impact_rows(false);
  rows["invariants_impacts_slopes"] = impact_rows(true);
  rows["convergence_phases_slopes"] =
      galerkin_slope_rows("gauss", {{"dmoc", "1", "2.01"}, {"dmoc", "2", "3.99"}, {"tangent", "2", "4.0"}});
  rows["objective_mayer"] = rows["objective"];
  rows["objective_constrained"] = constrained_cost_rows();
  rows["objective_forms"] = constraint_form_rows();
  rows["convergence_indirect_jumps"] = jump_rows();
  rows["iterations_common_ratios"] = currency_rows();
  rows["coercivity"] = coercivity_rows();
  rows["savings_by_solver_ratios"] = advantage_rows();
  rows["local_minima_minima"] = minima_rows();
  rows["local_minima_shares"] = share_rows();
  rows["cold_start_shares"] = cold_start_rows();
  rows["sequence"] = sequence_rows();
  rows["adaptive"] = adaptive_rows();
  rows["adaptive_effectivity"] = effectivity_rows();
  rows["shooting"] = shooting_rows();
  rows["convergence_shooting_slopes"] = shooting_slope_rows("1");
  rows["convergence_shooting_two_stages_slopes"] = shooting_slope_rows("2");
  rows["convergence_galerkin"] = galerkin_rows();
  rows["convergence_galerkin_slopes"] = galerkin_slope_rows(
      "gauss", {{"galerkin_1_1", "1", "2.01"}, {"galerkin_2_1", "3", "2.0"}, {"galerkin_2_3", "3", "3.97"}});
  rows["convergence_galerkin_shared_slopes"] = galerkin_slope_rows("gauss", {{"galerkin_2_2_shared", "3", "4.04"}});
  rows["convergence_galerkin_lobatto_slopes"] = galerkin_slope_rows("lobatto", {{"galerkin_2_1", "3", "2.02"}});
  rows["consistency_galerkin"] = galerkin_momentum_rows();
  rows["equivalence_galerkin"] = galerkin_form_rows();
  rows["equivalence_galerkin_lobatto"] = galerkin_form_rows();
  rows["closed_loop"] = loop_rows();
  rows["error_constants_limits"] = limit_rows("1");
  rows["error_constants_two_stages_limits"] = limit_rows("2");
  for (const std::string slew : {"rigid_body_coordinates", "rigid_body_coordinates_near_singularity"}) {
    rows[slew] = rigid_body_rows(slew.ends_with("singularity") ? 0.3 : 0.01);
    rows[slew + "_slopes"] = rigid_body_slope_rows();
    rows[slew + "_reference"] = rows_of_texts({"problem", "certified_digits"},
                                              {{"satellite_angles", "13"}, {"satellite_quaternion_embedded", "12"}});
  }
  rows["cold_start_shooting_shares"] = shooting_cold_rows();
  rows["savings_by_solver_shooting"] = shooting_cost_rows();
  rows["profile"] = profile_rows();
  rows["profile_three_stages"] = three_stages_rows();
  return rows;
}

}  // namespace dmocbench::tests
