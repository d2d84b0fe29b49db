#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "methods/tables/table.hpp"
#include "tests/bench/declared_tables.hpp"

namespace dmocbench::tests {

inline const std::vector<long long> sixteen_to_1024{16, 32, 64, 128, 256, 512, 1024};

/// Errors and costs of a made-up method on N intervals.
struct MadeUpMethod {
  std::string name = "dmoc";
  std::string stages = "1";
  std::function<double(double)> error;  ///< state and control error on N intervals
  std::function<double(double)> seconds = [](double n) { return 1e-3 * n; };  ///< of a solve on N intervals
  std::string solver = "ipopt";
  std::string derivatives = "tape";
};

/// A convergence table of made-up methods; step 1/N, 10 N free variables, solved on the same branch.
inline Table convergence_of(const std::vector<MadeUpMethod>& methods, const std::vector<long long>& intervals) {
  Table table({"problem", "method", "tableau", "stages", "solver", "derivatives", "intervals", "step", "free_variables",
               "status", "branch", "objective", "seconds", "state_error", "control_error"});
  for (const MadeUpMethod& method : methods) {
    for (const long long count : intervals) {
      const auto n = static_cast<double>(count);
      Row row = scheme_row(method.name, "pendulum", method.stages);
      row.set("solver", Cell(method.solver));
      row.set("derivatives", Cell(method.derivatives));
      row.set("intervals", count);
      row.set("step", 1.0 / n);
      row.set("free_variables", 10 * count);
      row.set("status", "solved");
      row.set("branch", "same");
      row.set("objective", 1.0);
      row.set("seconds", method.seconds(n));
      row.set("state_error", method.error(n));
      row.set("control_error", method.error(n));
      table.append(row);
    }
  }
  return table;
}

/// The error c h^p on N intervals, h = 1/N.
inline std::function<double(double)> power_law(double c, double p) {
  return [c, p](double n) { return c * std::pow(n, -p); };
}

}  // namespace dmocbench::tests
