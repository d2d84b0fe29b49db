#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "methods/expression/tape.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/column_assembly.hpp"

namespace dmocbench {

/// A tape whose outputs are parts of one long array: output e of interval k belongs to entry firsts[e] + k, see
/// `ColumnAssembly`.
class AssembledTape {
 public:
  /// `size` is the length of the array, `intervals` the number of intervals. Throws `Error` if there is not one place
  /// per output.
  AssembledTape(const Schedule& schedule, const std::vector<std::size_t>& firsts, std::size_t size,
                std::size_t intervals);

  /// Writes all `size` entries of `result`. Allocates nothing.
  void evaluate(std::span<const Tape::Input> inputs, VectorOut result);

  [[nodiscard]] const Tape& tape() const noexcept { return tape_; }

 private:
  Tape tape_;
  Tape::Workspace workspace_;
  ColumnAssembly assembly_;
};

/// The pattern of an assembled sparse matrix, and where local entries go in its array of values.
struct AssembledPattern {
  SparsityPattern pattern;
  std::vector<std::size_t> firsts;  ///< per local entry, as AssembledTape wants it
};

/// Merges the local entries of all intervals: entry e of interval k stands at (row_firsts[e] + k, column_firsts[e] +
/// k).
[[nodiscard]] AssembledPattern assemble_pattern(const std::vector<std::size_t>& row_firsts,
                                                const std::vector<std::size_t>& column_firsts, std::size_t intervals);

}  // namespace dmocbench
