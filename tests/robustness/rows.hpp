#pragma once

#include <string>
#include <vector>

#include "methods/diagnostics/accuracy.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench::tests {

/// A discretisation, and what is expected of the six rows that it has: three families of elements, two solvers.
struct Setting {
  int stages = 1;
  int intervals = 1;
  double accuracy = 0.0;     ///< of the cost of a motion, relative to a minimum's
  int least_at_minimum = 0;  ///< rows that are motions and have a known minimum's cost to this accuracy
};

/// One solve from the problem's own guess and what its replay says.
struct Row {
  std::string label;
  Solution solution;
  double cost = 0.0;
  Accuracy replay;
};

/// The largest jump of an interval's replay, relative to the state's range, of what counts as a motion.
constexpr double largest_relative_jump = 0.05;

/// True if the answer says of itself that it is no motion, although its program is solved. This is the one place that
/// decides. Until "solved, but not a motion" is a status of its own, the replay decides, which whoever reads the status
/// alone cannot do; from then on it is the status, and `expect_rows` holds it against the replay.
[[nodiscard]] bool told_apart(const Solution& solution, const Accuracy& replay);

/// Solves a setting's six rows and expects of them that
/// - none is given as a motion (solved, and not told apart) whose replay jumps beyond the limit;
/// - no motion is cheaper than the cheapest of the known `minima`, but for the accuracy of the setting;
/// - enough of them have the cost of a minimum.
/// Prints the table of rows.
void expect_rows(const Problem& problem, const std::vector<double>& minima, const Setting& setting);

/// Expects of a problem that has no motion at all that no row is given as one.
void expect_no_motion(const Problem& problem, const Setting& setting);

}  // namespace dmocbench::tests
