#pragma once

#include <cstddef>
#include <vector>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::interior_point {

/// A symmetric order of the KKT matrix of a program with an interval structure in which all but a few dense lines lie
/// in a narrow band: rows and unknowns of node 0, unknowns and rows of interval 0, rows and unknowns of node 1, ...
/// Lines of the KKT matrix are numbered unknowns first, then rows.
///
/// An unknown of the whole horizon (T) would be a dense line, and the band without it singular where time is minimal.
/// So every interval has a copy of it, and further rows, the ties, say that neighbouring copies are equal.
struct NodeOrder {
  /// Where a line goes: to position `at` of the band, or of the border.
  struct Line {
    bool in_border = false;
    std::size_t at = 0;
  };
  /// Positions in the band.
  struct Copies {
    std::size_t unknown = 0;
    std::vector<std::size_t> of_intervals;
    std::vector<std::size_t> ties;  ///< tie k: copy k + 1 - copy k = 0
  };

  /// Where `line` stands in an entry of the matrix that it has with the line `other`.
  [[nodiscard]] Line place(std::size_t line, std::size_t other) const;

  std::vector<Line> lines;             ///< variable_count() + constraint_count(); copied ones by their first copies
  std::vector<Copies> copies;          ///< one per unknown of the whole horizon
  std::vector<std::size_t> intervals;  ///< the interval that a line belongs to, or begins
  std::size_t band_size = 0;           ///< lines of the band, copies and ties included
  std::size_t border_size = 0;         ///< lines of the border: rows that couple both ends
  std::size_t half_bandwidth = 0;      ///< largest distance of an entry of the band from the diagonal
};

/// Bandwidth and border are found from the program's patterns. Throws `Error` if the program has no interval structure.
[[nodiscard]] NodeOrder node_order(const NonlinearProgram& program);

}  // namespace dmocbench::interior_point
