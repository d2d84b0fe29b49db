#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace dmocbench::sqp {

/// A column that moves along a direction.
struct MovingColumn {
  double value = 0.0;
  double rate = 0.0;  ///< change of the value per unit step
  double lower = 0.0;
  double upper = 0.0;
};

/// The distance by which a direction may be followed.
struct RatioTest {
  double step = 0.0;
  std::optional<std::size_t> blocking;  ///< place in the list of the column that stops it; none if the limit does
};

/// The largest step up to `limit` before a column that is within its bounds (up to `tolerance`) leaves them, or one
/// outside reaches the bound that it violates. Of columns that block within the tolerance of each other, the one with
/// the largest rate does (Harris): small pivots make an ill-conditioned basis. A column that is passed violates its
/// bound by no more than `tolerance`.
[[nodiscard]] RatioTest ratio_test(const std::vector<MovingColumn>& columns, double limit, double tolerance);

}  // namespace dmocbench::sqp
