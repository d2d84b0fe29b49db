#include "methods/solvers/sqp/quadratic/pricing.hpp"

#include <algorithm>
#include <cmath>

namespace dmocbench::sqp {

PricedColumn Pricing::choose(const std::vector<PricedColumn>& candidates) {
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
  return *std::max_element(candidates.begin(), candidates.end(), [](const PricedColumn& a, const PricedColumn& b) {
    return std::abs(a.rate) < std::abs(b.rate);
  });
}

}  // namespace dmocbench::sqp
