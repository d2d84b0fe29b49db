#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// A violated inequality that moving an unknown to either side would repair, although its derivative by it vanishes.
struct FlatRow {
  std::size_t row = 0;      ///< number of the constraint
  std::size_t unknown = 0;  ///< number of the unknown
};

/// All of them at a point (variable_count() entries), as where a guess leads straight through the middle of an
/// obstacle: linearised constraints do not show which way round there is. Empty if a number is not finite.
[[nodiscard]] std::vector<FlatRow> flat_rows(NonlinearProgram& program, const Eigen::VectorXd& point);

/// The point with the unknowns of nodes among them (`flat_rows`) moved a little to one side, along a bump over all
/// nodes, by a hundredth of the largest value of a node; empty if there are none.
[[nodiscard]] Eigen::VectorXd moved_off_flat_rows(NonlinearProgram& program, const Eigen::VectorXd& point);

}  // namespace dmocbench
