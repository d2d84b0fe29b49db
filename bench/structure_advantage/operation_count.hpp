#pragma once

#include <optional>
#include <string>

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"

namespace dmocbench {

/// What one factorisation of the KKT matrix takes: multiplications, each with an addition, and divisions.
struct OperationCount {
  /// Of the elimination; none where a solver does not tell.
  std::optional<double> elimination;
  /// Of a band: the largest distance of an entry from the diagonal.
  std::optional<long long> half_bandwidth;
};

/// Factorises the KKT matrix at a solution, without bounds' terms but with a unit shift if it needs one, by one of
/// `interior_point`'s ways and counts: "intervals" by running the elimination on numbers that count, "banded" from the
/// rows that LAPACK exchanged, "sparse" as MUMPS says. Empty for another name, and where the matrix cannot be
/// factorised in that way. For the whole grid.
[[nodiscard]] OperationCount count_operations(NonlinearProgram& program, const Solution& solution,
                                              const std::string& factorisation);

}  // namespace dmocbench
