#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/claims/claim.hpp"
#include "methods/transcription/elements/families.hpp"
#include "tests/bench/declared_tables.hpp"

namespace dmocbench::tests {

inline const std::vector<std::string> methods = paper_families();

inline Row solved_row(const std::string& method, long long intervals) {
  Row row = scheme_row(method);
  row.set("intervals", intervals);
  row.set("status", "solved");
  row.set("branch", "same");
  row.set("tolerance", "1e-10");
  return row;
}

inline const std::vector<std::string> differences{
    "configuration_difference", "momentum_difference",       "control_difference",    "costate_difference",
    "objective_difference",     "violation_in_rows_of_dmoc", "violation_of_dmoc_here"};

inline Rows slope_rows() {
  Rows rows;
  for (const std::string& method : methods) {
    for (const char* quantity : {"state", "control"}) {
      Row row = scheme_row(method);
      row.set("quantity", quantity);
      row.set("slope", 2.03);
      row.set("standard_error", 0.01);
      row.set("coarsest", 32LL);
      row.set("finest", 256LL);
      row.set("points", 4LL);
      rows.push_back(row);
    }
  }
  return rows;
}

/// Both grids of every method, filled by a function of row, method and step.
template <class Fill>
Rows rows_on_grids(const Fill& fill) {
  Rows rows;
  for (const std::string& method : methods) {
    for (const long long intervals : {16LL, 1024LL}) {
      Row row = solved_row(method, intervals);
      fill(row, method == "tangent", 1.0 / static_cast<double>(intervals));
      rows.push_back(row);
    }
  }
  return rows;
}

inline long long free_variables(const std::string& method, long long intervals) {
  return method == "dmoc" ? 3 * intervals - 2 : 5 * intervals - 4;
}

/// A row like one for every tableau with two and three stages.
template <class Fill>
Rows rows_by_tableau(const Row& like, const Fill& fill) {
  Rows rows;
  for (const std::string tableau : {"gauss", "lobatto"}) {
    for (const long long stages : {2LL, 3LL}) {
      Row row = like;
      row.set("tableau", tableau);
      row.set("stages", stages);
      fill(row, tableau == "gauss" ? 2.0 * static_cast<double>(stages) : 2.0 * static_cast<double>(stages) - 2.0);
      rows.push_back(row);
    }
  }
  return rows;
}

inline Rows equivalence_rows() {
  Rows rows;
  const auto set_differences = [](Row& row, double value) {
    for (const std::string& column : differences) row.set(column, value);
    for (const char* rounding : {"rounding_in_rows_of_dmoc", "rounding_here"}) row.set(rounding, 1e-16);
  };
  for (Row& row : rows_on_grids([&](Row& row, bool tangent, double h) {
         if (row.text("method") != "dmoc") set_differences(row, tangent ? h * h : 1e-13);
         if (row.text("method") == "hamiltonian") row.set("adjoint_residual", 1e-12);
         row.set("forced_form_residual", tangent ? h * h : 1e-11);
         row.set("acceleration_form_residual", tangent ? 1e-11 : h * h);
       })) {
    if (row.text("method") != "dmoc") rows.push_back(row);
  }
  for (const std::string method : {"dmoc", "hamiltonian"}) {
    for (Row& row : rows_by_tableau(solved_row(method, 64), [&](Row& row, double /*order*/) {
           if (method == "hamiltonian") set_differences(row, 1e-13);
           row.set("adjoint_residual", 1e-12);
           row.set("adjoint_residual_by_plain_coefficients", row.text("tableau") == "gauss" ? 1e-12 : 1e-2);
         })) {
      rows.push_back(row);
    }
  }
  return rows;
}

inline Rows indirect_slope_rows() {
  Rows rows;
  for (const char* method : {"dmoc", "hamiltonian"}) {
    for (const char* quantity : {"state", "momentum", "costate", "control_from_costate", "control"}) {
      for (Row& row : rows_by_tableau(scheme_row(method), [&](Row& row, double order) {
             row.set("quantity", quantity);
             row.set("verdict", "slope");
             row.set("slope", quantity == std::string("control") ? row.needed("stages") + 1.0 : order + 0.05);
             row.set("standard_error", 0.01);
           })) {
        rows.push_back(row);
      }
      Row four_stages = rows.front();
      four_stages.set("method", method);
      four_stages.set("quantity", quantity);
      four_stages.set("stages", 4LL);
      four_stages.set("slope", quantity == std::string("control") ? 5.0 : 8.02);
      rows.push_back(four_stages);
    }
  }
  return rows;
}

inline Rows iteration_rows() {
  Rows rows;
  for (const std::string& method : methods) {
    for (const long long intervals : {32LL, 64LL, 128LL}) {
      for (const std::string crash : {"none", "basis"}) {
        Row row = solved_row(method, intervals);
        const long long free = free_variables(method, intervals);
        row.set("solver", "sqp");
        row.set("crash", crash);
        row.set("free_variables", free);
        row.set("minor_iterations", (crash == "none" ? free : intervals - 4) + 3);
        row.set("predicted_minors", row.needed("minor_iterations"));
        rows.push_back(row);
      }
    }
  }
  return rows;
}

/// Times of eleven rounds that scatter by a few percent around a number; those of another phase scatter otherwise.
inline std::string rounds_around(double seconds, double phase = 0.0) {
  std::vector<double> times(11);
  for (std::size_t round = 0; round < times.size(); ++round) {
    times[round] = seconds * (1.0 + 0.03 * std::sin(7.0 * static_cast<double>(round) + phase));
  }
  return joined_numbers(times);
}

/// Solves by every back end of derivatives to a tolerance; differences fail on the finer grid.
inline Rows derivative_rows(const std::string& tolerance) {
  Rows rows;
  for (const std::string back_end :
       {"tape", "adolc", "adolc_whole", "finite_differences", "forward_differences", "dense_differences"}) {
    for (Row& row : rows_on_grids([&](Row& row, bool /*tangent*/, double /*h*/) {
           const bool exact = !back_end.ends_with("differences");
           row.set("solver", "ipopt");
           row.set("derivatives", back_end);
           row.set("hessian", "exact");
           if (!exact && row.text("intervals") == "1024") row.set("status", "acceptable");
           row.set("tolerance", tolerance);
           row.set("round_seconds", rounds_around(exact ? 0.01 : 0.03));
           row.set("variables", 50LL);
           row.set("major_iterations", exact ? 10LL : 12LL);
           row.set("jacobian_over_residual", exact ? 1.5 : 10.0);
           row.set("hessian_over_residual", exact ? 2.0 : 40.0);
           row.set("jacobian_error", exact ? 1e-16 : 1e-8);
         })) {
      rows.push_back(row);
    }
  }
  return rows;
}

/// The same with first derivatives alone, with one and two stages; differences solve a quarter of the programs.
inline Rows quasi_newton_rows() {
  Rows rows;
  for (Row& row : derivative_rows("1e-08")) {
    if (row.text("derivatives") == "finite_differences") continue;
    row.set("hessian", "limited_memory");
    rows.push_back(row);
    row.set("stages", 2LL);
    if (row.text("derivatives").ends_with("differences")) row.set("status", "step failed");
    rows.push_back(row);
  }
  return rows;
}

/// The same from the guess to three tolerances.
inline Rows cold_derivative_rows() {
  Rows rows;
  for (const char* tolerance : {"1e-06", "1e-08", "1e-10"}) {
    const Rows more = derivative_rows(tolerance);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

inline Rows reference_rows() {
  Row row;
  row.set("problem", orbit);
  row.set("cost", 4e-5);
  row.set("certified_digits", 13.4);
  return {row};
}

/// Tables as a run that reproduces the paper writes them.
inline TableRows rows_of_tables() {
  return {{"convergence_slopes", slope_rows()},
          {"consistency", rows_on_grids([](Row& row, bool tangent, double h) {
             row.set("largest_force", 1.0);
             row.set("momentum_defect_max", tangent ? 1e-4 * h * h * h : 1e-15);
             row.set("momentum_defect_total", tangent ? 1e-4 * h * h : 1e-16);
           })},
          {"convergence", rows_on_grids([](Row& row, bool tangent, double h) {
             row.set("free_variables", free_variables(row.text("method"), std::lround(1.0 / h)));
             row.set("step", 2.9316 * h);
             row.set("replay_error", (tangent ? 1.0 : 0.9) * h * h);
           })},
          {"convergence_indirect_reference", reference_rows()},
          {"objective", rows_on_grids([](Row& row, bool tangent, double h) {
             row.set("objective", 4e-5 * (1.0 + (tangent ? 0.9 : 1.0) * h * h));
           })},
          {"equivalence", equivalence_rows()},
          {"equivalence_slopes", rows_by_tableau(scheme_row("tangent"),
                                                 [](Row& row, double order) {
                                                   row.set("verdict", "slope");
                                                   row.set("slope", order);
                                                   row.set("standard_error", 0.01);
                                                 })},
          {"convergence_indirect_slopes", indirect_slope_rows()},
          {"iterations", iteration_rows()},
          {"derivatives", derivative_rows("1e-08")},
          {"derivatives_quasi_newton", quasi_newton_rows()},
          {"derivatives_cold", cold_derivative_rows()}};
}

/// These tables; `change` doctors every row of the named one.
inline ResultTables tables(const std::string& doctored = "", const std::function<void(Row&)>& change = {}) {
  return results_of(rows_of_tables(), [&](const std::string& table, Row& row) {
    if (table == doctored) change(row);
  });
}

/// A row from texts in the order of columns.
inline Row row_of_texts(const ColumnNames& columns, const std::vector<std::string>& texts) {
  Row row;
  for (std::size_t i = 0; i < columns.size(); ++i) row.set(columns[i], texts.at(i));
  return row;
}

inline Rows rows_of_texts(const ColumnNames& columns, const std::vector<std::vector<std::string>>& texts) {
  Rows rows;
  for (const std::vector<std::string>& row : texts) rows.push_back(row_of_texts(columns, row));
  return rows;
}

}  // namespace dmocbench::tests
