#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <Eigen/Core>

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

/// A column and the rate at which the objective changes with it.
struct PricedColumn {
  Eigen::Index column = 0;  ///< number of the column
  double rate = 0.0;        ///< of the objective, per unit of the column
};

/// Carries out a rule.
class Pricing {
 public:
  /// `seed`: of `PricingRule::random`.
  explicit Pricing(PricingRule rule = PricingRule::largest, std::uint32_t seed = 1) : rule_(rule), generator_(seed) {}

  /// One of the candidates (in ascending order of their index, not empty).
  [[nodiscard]] PricedColumn choose(const std::vector<PricedColumn>& candidates) {
    switch (rule_) {
      case PricingRule::lowest:
        return candidates.front();
      case PricingRule::last:
        return candidates.back();
      case PricingRule::random:
        return candidates[generator_() % candidates.size()];  // the same sequence with every standard library
      case PricingRule::largest:
        break;
    }
    return *std::ranges::max_element(candidates, {}, [](const PricedColumn& priced) { return std::abs(priced.rate); });
  }

 private:
  PricingRule rule_;
  std::mt19937 generator_;
};

/// A column that moves along a direction.
struct MovingColumn {
  double value = 0.0;  ///< of the column at the start of the step
  double rate = 0.0;   ///< change of the value per unit step
  double lower = 0.0;  ///< its lower bound
  double upper = 0.0;  ///< its upper bound
};

/// The distance by which a direction may be followed.
struct RatioTest {
  double step = 0.0;                         ///< the largest step
  std::optional<std::size_t> blocking = {};  ///< place in the list of the column that stops it; none if the limit does
};

/// The largest step up to `limit` before a column that is within its bounds (up to `tolerance`) leaves them, or one
/// outside reaches the bound that it violates. Of columns that block within the tolerance of each other, the one with
/// the largest rate does (Harris): small pivots make an ill-conditioned basis. A column that is passed violates its
/// bound by no more than `tolerance`.
[[nodiscard]] RatioTest ratio_test(const std::vector<MovingColumn>& columns, double limit, double tolerance);

}  // namespace dmocbench::sqp
