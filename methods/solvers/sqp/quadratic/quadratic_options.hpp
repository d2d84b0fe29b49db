#pragma once

#include <cstdint>

namespace dmocbench::sqp {

/// Where the first quadratic program starts.
enum class Crash : std::uint8_t {
  none,   ///< all slacks basic: phase 1 has to bring every constraint in
  basis,  ///< a well-conditioned basis of variables, chosen for free: the constraints hold from the start
};

/// Which of the columns that would lower the objective may move next.
enum class PricingRule : std::uint8_t {
  largest,  ///< the one with the largest reduced gradient
  lowest,   ///< the one with the lowest index
  last,     ///< the one with the highest index
  random,   ///< any of them, by a seeded generator
};

/// How quadratic programs are begun and priced.
struct QuadraticOptions {
  double tolerance = 1e-9;    ///< for bounds and reduced gradients
  Crash crash = Crash::none;  ///< the basis to begin with
};

}  // namespace dmocbench::sqp
