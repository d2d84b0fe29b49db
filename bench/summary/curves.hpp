#pragma once

#include <string>
#include <vector>

#include "bench/experiment/table.hpp"

namespace dmocbench {

/// The rows of a table that differ in their grid only, in the order of the table.
struct Curve {
  std::string problem;
  std::string method;
  std::string tableau;
  std::string stages;
  std::string solver;
  std::string derivatives;
  std::vector<const Row*> rows;

  [[nodiscard]] std::string label() const { return problem + " " + method + " " + tableau + " " + stages; }
};

/// All curves of a table; they point into it.
[[nodiscard]] std::vector<Curve> curves_of(const Table& table);

}  // namespace dmocbench
