#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Core>

#include "methods/solvers/sqp/quadratic/quadratic_options.hpp"

namespace dmocbench::sqp {

/// A column and the rate at which the objective changes with it.
struct PricedColumn {
  Eigen::Index column = 0;
  double rate = 0.0;
};

/// Carries out a rule.
class Pricing {
 public:
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

}  // namespace dmocbench::sqp
