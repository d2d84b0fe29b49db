#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/report/results_folder.hpp"

namespace dmocbench {

/// The distance of a method from the optimum of a problem in the rows of all runs that solve it as it is stated.
struct ReachedOptimum {
  std::string method;
  std::size_t rows = 0;
  std::size_t solved = 0;
  std::size_t near = 0;                       ///< solved, and no farther than `near_enough`
  std::optional<double> smallest_difference;  ///< of the cost from the optimum, relative, among solved rows
};

/// The relative difference of a cost from the optimum up to which a method has reached it: coarse grids differ by less,
/// other minima by more.
inline constexpr double near_enough = 0.01;

/// The lowest cost of a problem in all solved rows; empty if there are no solved rows.
[[nodiscard]] std::optional<double> lowest_cost(const ResultsFolder& results, const std::string& problem);

/// The methods that tried a problem, in the order of their names. Runs that set parameters are left out: their optimum
/// is another one.
[[nodiscard]] std::vector<ReachedOptimum> reached_optima(const ResultsFolder& results, const std::string& problem,
                                                         double optimum);

}  // namespace dmocbench
