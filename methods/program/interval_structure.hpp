#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmocbench {

/// Where an unknown or a row of a transcribed program belongs: to a node k = 0 .. N, to an interval k = 0 .. N - 1, or
/// to the border (a quantity of the whole horizon).
struct Place {
  enum class Kind : std::uint8_t { node, interval, border };
  Kind kind = Kind::border;
  std::size_t index = 0;
};

/// The structure that solvers by intervals need: a row of interval k reads unknowns of nodes k and k + 1, of interval k
/// and of the border only; a row of node k those of intervals k - 1 and k.
struct IntervalStructure {
  std::size_t intervals = 0;
  std::vector<Place> unknowns;  ///< one per variable
  std::vector<Place> rows;      ///< one per constraint
};

}  // namespace dmocbench
