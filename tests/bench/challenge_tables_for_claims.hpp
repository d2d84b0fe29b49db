#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "tests/bench/tables_for_claims.hpp"

// The tables of what the paper leaves open: shooting beside DMOC, low thrust over many revolutions, steps tied to the
// motion.
namespace dmocbench::tests {

/// Cost errors 1 (DMOC and tangent), 3 (explicit midpoint) and 1/10 (rk4), at any number of steps.
inline Rows low_thrust_rows() {
  const std::map<std::string, const char*> cost_errors{{"dmoc", "1e-4"},
                                                       {"tangent", "1e-4"},
                                                       {"multiple_shooting_midpoint_1", "3e-4"},
                                                       {"multiple_shooting_rk4_1", "1e-5"}};
  Rows rows;
  for (const char* revolutions : {"10", "20"}) {
    for (const auto& [method, cost_error] : cost_errors) {
      for (const char* steps : {"8", "16", "32"}) {
        rows.push_back(row_of_texts(
            {"problem", "method", "tableau", "stages", "revolutions", "steps_per_revolution", "status", "branch",
             "reference_digits", "cost_error", "state_error", "replay_error", "momentum_balance"},
            {orbit, method, "gauss", "1", revolutions, steps, "solved", "same", "12", cost_error, cost_error, "1e-3",
             method == "tangent" ? "1e-9" : "1e-13"}));
      }
    }
  }
  return rows;
}

/// Roadmaps that lead to the best known optimum, 5 % dearer before the full solve.
inline Rows primitives_rows() {
  return rows_of_texts({"problem", "status", "reference_cost", "excess_before", "excess_after", "start_motions",
                        "excess_of_starts", "plan_lower", "plan_upper", "rounds"},
                       {{orbit, "solved", "4e-5", "0.05", "1e-6", "1", "1e-6", "0.9", "1.1", "21"},
                        {"hovercraft", "solved", "0.9", "0.05", "1e-6", "1", "0.4", "1.9", "2.1", "21"}});
}

/// Rows of rules of steps along three ellipses, with the texts of some further columns by rule.
inline Rows step_control_rows(const ColumnNames& more, const std::map<std::string, std::vector<std::string>>& texts) {
  ColumnNames columns{"problem", "eccentricity", "rule", "sigma", "stages"};
  columns.insert(columns.end(), more.begin(), more.end());
  Rows rows;
  for (const char* eccentricity : {"0.3", "0.6", "0.8"}) {
    for (const auto& [rule, of_rule] : texts) {
      std::vector<std::string> all{"kepler", eccentricity, rule, "distance", "1"};
      all.insert(all.end(), of_rule.begin(), of_rule.end());
      rows.push_back(row_of_texts(columns, all));
    }
  }
  return rows;
}

inline Rows shooting_rows() {
  return rows_of_texts({"problem", "method", "tableau", "stages", "status", "intervals", "unknowns", "condition"},
                       {{orbit, "dmoc", "gauss", "1", "solved", "64", "190", "1e3"},
                        {orbit, "multiple_shooting_rk4_1", "gauss", "1", "solved", "64", "316", "1e4"},
                        {orbit, "single_shooting_rk4_1", "gauss", "1", "solved", "64", "64", "1e5"}});
}

inline Rows shooting_slope_rows(const char* stages) {
  const ColumnNames columns{"problem", "method", "tableau", "stages", "quantity", "verdict", "slope", "standard_error"};
  if (stages == std::string("2")) {
    return rows_of_texts(columns, {{orbit, "multiple_shooting_rk4_1", "gauss", "2", "state", "slope", "4.01", "0.01"}});
  }
  return rows_of_texts(columns,
                       {{orbit, "multiple_shooting_rk4_1", "gauss", "1", "state", "slope", "2.01", "0.01"},
                        {orbit, "multiple_shooting_midpoint_1", "gauss", "1", "state", "slope", "1.99", "0.01"}});
}

/// Methods, quadrature points and slopes of the state.
inline Rows galerkin_slope_rows(const char* tableau,
                                const std::vector<std::tuple<const char*, const char*, const char*>>& curves) {
  const ColumnNames columns{"problem", "method", "tableau",        "stages",  "quantity",
                            "verdict", "slope",  "standard_error", "fine_end"};
  Rows rows;
  for (const auto& [method, points, slope] : curves) {
    for (const char* quantity : {"state", "costate"}) {
      rows.push_back(
          row_of_texts(columns, {orbit, method, tableau, points, quantity, "slope", slope, "0.01", "grids"}));
    }
  }
  return rows;
}

/// The same solutions by DMOC and by galerkin with r = s = m, and the balance of momentum with other controls.
inline Rows galerkin_rows() {
  Rows rows;
  for (const char* method : {"dmoc", "galerkin_1_1", "galerkin_1_2"}) {
    for (const long long intervals : {16LL, 32LL}) {
      Row row = solved_row(method, intervals);
      const bool is_other = method == std::string("galerkin_1_2");
      row.set("objective", is_other ? 4.1e-5 : 4e-5);
      row.set("state_error", is_other ? 2e-3 : 1e-3);
      rows.push_back(row);
    }
  }
  return rows;
}

/// Limits of errors, the predictions a hundredth of their uncertainty away.
inline Rows limit_rows(const char* stages) {
  Rows rows;
  for (const char* problem : {orbit, two_link, "kepler_cartesian"}) {
    for (const auto& [method, constant] : {std::pair("dmoc", 1.2), {"tangent", 1.3}, {"second_order", 4.1}}) {
      for (const std::string quantity :
           {"state_error", "replay_error", "predicted_replay_error", "objective_error", "predicted_objective_error"}) {
        Row row = row_of_texts({"problem", "method", "tableau", "stages", "quantity", "finest", "uncertainty"},
                               {problem, method, "gauss", stages, quantity, "512", "1e-3"});
        row.set("constant", constant + (quantity.starts_with("predicted") ? 1e-5 : 0.0));
        rows.push_back(row);
      }
    }
  }
  return rows;
}

/// Loops on grids with equal intervals and with equal unknowns: DMOC ends nearest, and disturbances matter more.
inline Rows loop_rows() {
  Rows rows;
  struct Plans {
    const char* method;
    const char* intervals;
    const char* variables;
    double error;
  };
  for (const Plans& plans :
       {Plans{"dmoc", "32", "94", 1.0}, Plans{"hamiltonian", "32", "156", 1.0}, Plans{"hamiltonian", "19", "91", 2.8},
        Plans{"tangent", "32", "156", 1.1}, Plans{"tangent", "19", "91", 2.9}}) {
    for (const std::string feedback : {"open", "closed"}) {
      for (int draw = 0; draw <= 10; ++draw) {
        Row row = row_of_texts({"problem", "method", "tableau", "stages", "intervals", "feedback", "variables"},
                               {orbit, plans.method, "gauss", "1", plans.intervals, feedback, plans.variables});
        const double error = (feedback == "open" ? 1e-3 : 1e-5) * plans.error;
        row.set("draw", static_cast<long long>(draw));
        row.set("plans", 13LL);
        row.set("failed", 0LL);
        row.set("cost", 4e-5 * (1.0 + 0.1 * draw + error));
        row.set("momentum_defect", plans.method == std::string("tangent") ? 1e-5 : 1e-15);
        row.set("momentum_miss", 1e-3 * (1.0 + 0.1 * draw) * plans.error);
        row.set("final_distance", 1e-3 * draw + error);
        rows.push_back(row);
      }
    }
  }
  return rows;
}

constexpr std::array coordinates_of_attitudes{"satellite_angles", "satellite_directors", "satellite_directors_embedded",
                                              "satellite_quaternion", "satellite_quaternion_embedded"};

/// One slew in five systems of coordinates, with this error of the attitude in Euler angles.
inline Rows rigid_body_rows(double error_of_angles) {
  Rows rows;
  for (const std::string problem : coordinates_of_attitudes) {
    const bool has_multipliers = problem == "satellite_directors" || problem == "satellite_quaternion";
    Row row = solved_row("dmoc", 64);
    row.set("problem", problem);
    row.set("free_variables", has_multipliers ? 510LL : 381LL);
    row.set("objective", 8.0);
    row.set("state_error", problem == "satellite_angles" ? error_of_angles : 0.004);
    row.set("objective_error", 0.02);
    row.set("replay_error", 0.01);
    if (problem == "satellite_quaternion_embedded") {
      row.set("optimum_state_difference", 1e-15);
      row.set("optimum_objective_difference", 1e-15);
    }
    rows.push_back(row);
  }
  return rows;
}

inline Rows rigid_body_slope_rows() {
  Rows rows;
  for (const char* problem : coordinates_of_attitudes) {
    for (const char* quantity : {"state", "objective", "replay"}) {
      rows.push_back(
          row_of_texts({"problem", "method", "tableau", "stages", "quantity", "slope", "standard_error", "verdict"},
                       {problem, "dmoc", "gauss", "1", quantity, "2.01", "0.01", "slope"}));
    }
  }
  return rows;
}

/// Lagrangians of programs equal to the discrete action of the control Lagrangian, by a multiplier of the right degree.
inline Rows galerkin_form_rows() {
  Rows rows;
  for (const char* method : {"dmoc", "galerkin_2_1", "galerkin_2_2"}) {
    Row row = solved_row(method, 16);
    row.set("stages", 3LL);
    row.set("galerkin_form_difference", 1e-15);
    row.set("straight_form_difference", 0.1);
    rows.push_back(row);
  }
  return rows;
}

inline Rows galerkin_momentum_rows() {
  Rows rows;
  for (const char* method : {"galerkin_1_1", "galerkin_2_1"}) {
    Row row = solved_row(method, 16);
    row.set("momentum_defect_max", 1e-15);
    row.set("largest_force", 1.0);
    rows.push_back(row);
  }
  return rows;
}

inline Rows shooting_cold_rows() {
  const ColumnNames columns{"problem",   "method",     "tableau", "stages", "solver",    "derivatives",
                            "intervals", "start_kind", "starts",  "solved", "confirmed", "too_coarse"};
  return rows_of_texts(
      columns, {{orbit, "dmoc", "gauss", "1", "ipopt", "tape", "32", "cold", "50", "49", "48", "1"},
                {orbit, "multiple_shooting_rk4_1", "gauss", "1", "ipopt", "tape", "32", "cold", "50", "38", "35", "3"},
                {orbit, "single_shooting_rk4_1", "gauss", "1", "ipopt", "tape", "32", "cold", "50", "12", "10", "2"}});
}

/// Errors of the cost fall as 1/N²; those of shooting are twice DMOC's, and its solves take longer.
inline Rows shooting_cost_rows() {
  Rows rows;
  for (const char* method : {"dmoc", "multiple_shooting_rk4_1", "single_shooting_rk4_1"}) {
    const bool is_dmoc = method == std::string("dmoc");
    for (const long long intervals : {16LL, 32LL, 64LL}) {
      Row row = solved_row(method, intervals);
      const auto count = static_cast<double>(intervals);
      row.set("tolerance", Cell());
      row.set("solver", "ipopt");
      row.set("objective_error", (is_dmoc ? 1.0 : 2.0) / (count * count));
      row.set("round_seconds", rounds_around((is_dmoc ? 1e-4 : 2e-4) * count));
      rows.push_back(row);
    }
  }
  return rows;
}

/// Uniform and adapted grids of every method; collocation needs twice DMOC's variables.
inline Rows adaptive_rows() {
  Rows rows;
  for (const std::string& method : methods) {
    for (const char* grid : {"uniform", "adapted"}) {
      rows.push_back(row_of_texts(
          {"problem", "method", "tableau", "stages", "grid", "status", "intervals", "variables_at_accuracy", "grids",
           "seconds", "round_seconds"},
          {"hypersensitive", method, "gauss", "2", grid, "solved", grid == std::string("uniform") ? "900" : "150",
           method == "dmoc" ? "100" : "200", "4", "0.01", rounds_around(0.01)}));
    }
  }
  return rows;
}

inline Rows effectivity_rows() {
  Rows rows;
  for (const std::string& method : methods) {
    rows.push_back(row_of_texts(
        {"problem", "method", "tableau", "stages", "grid", "intervals", "quantity", "status", "effectivity",
         "relative_error", "verdict"},
        {"hypersensitive", method, "gauss", "2", "uniform", "32", "state", "solved", "1.1", "1e-4", "measured"}));
  }
  return rows;
}

}  // namespace dmocbench::tests
