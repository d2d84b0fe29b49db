#include "methods/solvers/sqp/quadratic/pricing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dmocbench::sqp {

namespace {

constexpr std::array<std::pair<std::string_view, PricingRule>, 4> rules{{{"largest", PricingRule::largest},
                                                                         {"lowest", PricingRule::lowest},
                                                                         {"last", PricingRule::last},
                                                                         {"random", PricingRule::random}}};

}  // namespace

std::vector<std::string> pricing_names() {
  std::vector<std::string> names;
  names.reserve(rules.size());
  for (const auto& [name, rule] : rules) names.emplace_back(name);
  return names;
}

std::optional<PricingRule> pricing_named(std::string_view name) {
  for (const auto& [known, rule] : rules) {
    if (known == name) return rule;
  }
  return std::nullopt;
}

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
