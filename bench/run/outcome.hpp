#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// How the solves of an experiment's table ended.
struct Outcome {
  std::ptrdiff_t failures = 0;      ///< neither solved nor no motions (`is_no_motion`)
  std::ptrdiff_t too_coarse = 0;    ///< rows whose intervals do not join
  std::ptrdiff_t violating = 0;     ///< rows whose motions violate constraints between stages
  std::ptrdiff_t other_branch = 0;  ///< rows whose answers are on another branch than their start
  /// Curves without a usable row; the rows of a curve agree in problem, method, tableau, stages, solver and back end.
  std::ptrdiff_t unusable_curves = 0;
  /// ", 3 too coarse (dmoc 1, tangent 2)", and the same for answers that violate constraints between stages; empty if
  /// there are no such answers.
  std::string no_motions_by_method;
  std::string first_failure;  ///< case and message of the first row that counts as a failure; empty without one
};

/// How the rows of a table ended, by their columns `status` and `branch`.
[[nodiscard]] Outcome outcome_of(const Table& table);

/// Adds the numbers of rows that ended so to the metadata of the run.
void describe(const Outcome& outcome, nlohmann::ordered_json& metadata);

}  // namespace dmocbench
