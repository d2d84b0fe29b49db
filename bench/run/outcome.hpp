#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// How the solves of an experiment's table ended.
struct Outcome {
  std::ptrdiff_t failures = 0;      ///< neither solved nor too coarse
  std::ptrdiff_t too_coarse = 0;    ///< rows whose answers are no motions
  std::ptrdiff_t other_branch = 0;  ///< rows whose answers are on another branch than their start
  std::string coarse_by_method;     ///< ", 3 too coarse (dmoc 1, tangent 2)"; nothing where no answer is
};

/// How the rows of a table ended, by their columns `status` and `branch`.
[[nodiscard]] Outcome outcome_of(const Table& table);

/// Adds the numbers of rows that ended so to the metadata of the run.
void describe(const Outcome& outcome, nlohmann::ordered_json& metadata);

}  // namespace dmocbench
