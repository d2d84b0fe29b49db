#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace dmocbench::sqp {

/// Which of the columns that would lower the objective is allowed to move next.
enum class PricingRule : std::uint8_t {
  largest,  ///< the one with the largest reduced gradient
  lowest,   ///< the one with the lowest index
  last,     ///< the one with the highest index
  random,   ///< any of them, by a seeded generator
};

/// Names of the rules: largest, lowest, last, random.
[[nodiscard]] std::vector<std::string> pricing_names();
/// The rule of that name; none if there is none.
[[nodiscard]] std::optional<PricingRule> pricing_named(std::string_view name);

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
  [[nodiscard]] PricedColumn choose(const std::vector<PricedColumn>& candidates);

 private:
  PricingRule rule_;
  std::mt19937 generator_;
};

}  // namespace dmocbench::sqp
