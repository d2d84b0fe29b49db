#pragma once

#include <optional>
#include <string>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// A point of a motion where a formula of its problem is not a finite number.
struct UndefinedPoint {
  std::string quantity;       ///< as `FormulaCheck` names it
  Eigen::Index interval = 0;  ///< k
  double time = 0.0;          ///< t, where it is

  /// "The motion leaves the set where its formulas are defined: lagrangian is not a number in interval 3 (t = 0.41)."
  [[nodiscard]] std::string words() const;
};

/// The first of eight points in every interval, evenly spaced between its nodes, where L, f, C, h or one of their first
/// derivatives is not a number on the element's polynomial of q and the stage polynomial of u. A program evaluates
/// derivatives at stages alone, and may step over a singularity: an answer with such a point does not solve the
/// problem.
[[nodiscard]] std::optional<UndefinedPoint> undefined_point(const Problem& problem, const Trajectory& trajectory);
/// The same of one interval k = `interval`, its two nodes, where the motion may begin or end at a singularity, first.
[[nodiscard]] std::optional<UndefinedPoint> undefined_point(const Problem& problem, const Trajectory& trajectory,
                                                            Eigen::Index interval);

}  // namespace dmocbench
