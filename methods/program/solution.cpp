#include "methods/program/solution.hpp"

#include <cmath>

#include "methods/error.hpp"

namespace dmocbench {

void SolverOptions::validate() const {
  if (!(tolerance > 0.0) || !(tolerance < 1.0)) {
    throw Error("the tolerance must lie between 0 and 1, got {}", tolerance);
  }
  if (most_iterations < 1) {
    throw Error("the maximum number of iterations must be at least 1, got {}", most_iterations);
  }
  if (!(most_seconds >= 0.0) || std::isinf(most_seconds)) {
    throw Error("the time limit must be a number of seconds, or 0 for no limit, got {}", most_seconds);
  }
}

}  // namespace dmocbench
