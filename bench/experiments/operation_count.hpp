#pragma once

#include <optional>
#include <string>

#include "methods/kkt/intervals/segment_kernel.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"

namespace dmocbench {

/// The cost of one factorisation of the KKT matrix, for the whole grid.
struct OperationCount {
  /// Multiplications, each with an addition, and divisions; none where a solver does not tell.
  std::optional<double> elimination;
  /// Of a band: the largest distance of an entry from the diagonal.
  std::optional<long long> half_bandwidth;
};

/// Factorises the KKT matrix at a solution, without the terms of bounds and with a unit shift if it needs one, and
/// counts: "intervals" by running the elimination on numbers that count, "banded" from the rows that LAPACK exchanged,
/// "sparse" as MUMPS says. Empty for another name, and where the matrix cannot be factorised in that way.
[[nodiscard]] OperationCount count_operations(NonlinearProgram& program, const Solution& solution,
                                              const std::string& factorisation);

/// The kernels of the elimination by intervals for a number type that counts: the same source, slow. Not for two
/// threads.
[[nodiscard]] kkt::SegmentKernel counting_segment_kernel(const kkt::Shape& shape);
/// Multiplications and divisions per interval of the last backward sweep by such a kernel.
[[nodiscard]] double counted_operations_per_interval();

}  // namespace dmocbench
