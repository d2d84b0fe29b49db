#pragma once

#include <memory>
#include <string>
#include <vector>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/grid.hpp"

namespace dmocbench {

/// One solve: a problem, a method with its tableau, a solver and a grid.
struct Case {
  std::shared_ptr<const Problem> problem;
  std::string method;
  std::string tableau;
  int stages = 1;
  std::string solver;
  Grid grid = Grid::uniform(1);

  [[nodiscard]] std::size_t intervals() const { return grid.intervals(); }
  /// "orbital_transfer dmoc gauss 1 ipopt N = 64".
  [[nodiscard]] std::string label() const;
  /// The same as part of a file's name: "orbital_transfer_dmoc_gauss1_64".
  [[nodiscard]] std::string file_label() const;
  /// True if both differ in their grid only: points of one curve.
  [[nodiscard]] bool same_curve(const Case& other) const;
};

}  // namespace dmocbench
