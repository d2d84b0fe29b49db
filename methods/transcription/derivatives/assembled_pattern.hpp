#pragma once

#include <cstddef>
#include <vector>

#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/derivatives/series_assembly.hpp"

namespace dmocbench {

/// Where the local entries of a part of a program stand in its matrix: entry e of interval k at (rows[e].at(k),
/// columns[e].at(k)).
struct LocalEntries {
  std::vector<SeriesPlace> rows;     ///< of every entry of an interval
  std::vector<SeriesPlace> columns;  ///< of every entry of an interval
  std::size_t intervals = 0;         ///< N
};

/// The pattern of an assembled sparse matrix, and where local entries go in its array of values.
struct AssembledPattern {
  BlockPattern pattern;             ///< where entries lie
  std::vector<SeriesPlace> places;  ///< per local entry, as `SeriesAssembly` wants it
};

/// Merges the local entries of all intervals.
[[nodiscard]] AssembledPattern assemble_pattern(const LocalEntries& entries);

/// Adds the few entries of a part with one interval to a pattern, and returns the place of each.
[[nodiscard]] std::vector<SeriesPlace> extend_pattern(BlockPattern& pattern, const LocalEntries& entries);

}  // namespace dmocbench
