#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::interior_point {

/// A symmetric order of the KKT matrix of a program with an interval structure in which all but a few dense lines lie
/// in a narrow band: rows and unknowns of node 0, unknowns and rows of interval 0, rows and unknowns of node 1, ...
/// Lines of the KKT matrix are numbered unknowns first, then rows.
struct NodeOrder {
  /// Where a line goes: to position `at` of the band, or of the border.
  struct Line {
    bool in_border = false;
    std::size_t at = 0;
  };
  std::vector<Line> lines;         ///< variable_count() + constraint_count()
  std::size_t band_size = 0;       ///< lines of the band
  std::size_t border_size = 0;     ///< lines of the border: unknowns of the whole horizon, rows that couple its ends
  std::size_t half_bandwidth = 0;  ///< largest distance of an entry of the band from the diagonal
};

/// Bandwidth and border are found from the program's patterns. None, with the reason in `why`, if the program has no
/// interval structure.
[[nodiscard]] std::optional<NodeOrder> node_order(const NonlinearProgram& program, std::string& why);

}  // namespace dmocbench::interior_point
