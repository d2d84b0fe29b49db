#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/experiment/table.hpp"

namespace dmocbench {

/// Error and cost of one grid, as decimal logarithms.
struct ErrorCostPoint {
  double error = 0.0;
  double cost = 0.0;
};

/// The points of usable rows (solved, on the wanted branch) that have both columns above zero, in the order of the
/// rows.
[[nodiscard]] std::vector<ErrorCostPoint> error_cost_points(const std::vector<const Row*>& rows,
                                                            const std::string& error_column,
                                                            const std::string& cost_column);

/// The cost at which a curve reaches an error, by straight lines in logarithms between its grids; none outside of them.
[[nodiscard]] std::optional<double> cost_at_error(const std::vector<ErrorCostPoint>& points, double error);

}  // namespace dmocbench
