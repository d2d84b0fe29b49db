#pragma once

#include <cstdint>

namespace dmocbench::sqp {

/// The start of the first quadratic program.
enum class Crash : std::uint8_t {
  none,   ///< all slacks basic: phase 1 has to bring every constraint in
  basis,  ///< a well-conditioned basis of variables, chosen for free: the constraints hold from the start
};

/// The choice of the next column to move, of those that would lower the objective.
enum class PricingRule : std::uint8_t {
  largest,  ///< the one with the largest reduced gradient
  lowest,   ///< the one with the lowest index
  last,     ///< the one with the highest index
  random,   ///< any of them, by a seeded generator
};

/// Options for starting and pricing quadratic programs.
struct QuadraticOptions {
  double tolerance = 1e-9;    ///< for bounds and reduced gradients
  Crash crash = Crash::none;  ///< the basis to begin with
};

}  // namespace dmocbench::sqp
