#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// One --over: a quantity of a problem and the values that it takes.
struct SweptQuantity {
  std::string
      name;  ///< of a parameter, or initial_q1, initial_v1, ..., final_q1, final_v1, ...: an entry of an end state
  double lower = 0.0;
  double upper = 0.0;
  std::optional<int> count = std::nullopt;  ///< of a grid from `lower` to `upper`, both included; empty for samples
};

/// Reads NAME=LOWER:UPPER:COUNT, or NAME=LOWER:UPPER where values are drawn at random. Throws `Error` that quotes
/// unreadable text, and if a count is missing or superfluous.
[[nodiscard]] SweptQuantity parse_over(const std::string& text, bool is_sampled);

/// The instances of a sweep, a value per quantity each: the Cartesian product of the grids, the first quantity slowest;
/// or `samples` points drawn evenly from the ranges, the same for the same seed on every machine. Throws `Error` if a
/// name occurs twice, or there are more than `most_instances`.
[[nodiscard]] std::vector<std::vector<double>> instances_of(const std::vector<SweptQuantity>& quantities,
                                                            std::optional<long long> samples, std::uint64_t seed);
/// The largest number of instances of a sweep.
inline constexpr long long most_instances = 100000;

/// Throws `Error` unless a problem has all these quantities: parameters, or entries of an end state that are fixed.
void require_quantities(const Problem& problem, const std::vector<SweptQuantity>& quantities);

/// The names of the quantities that are parameters of the problem, and not entries of an end state.
[[nodiscard]] std::vector<std::string> varied_parameters(const Problem& problem,
                                                         const std::vector<SweptQuantity>& quantities);
/// All parameters of the problem, in its order, where these quantities have these values.
[[nodiscard]] Eigen::VectorXd parameters_of_instance(const Problem& problem,
                                                     const std::vector<SweptQuantity>& quantities,
                                                     const std::vector<double>& values);

/// The problem with these values of its quantities, its cost scaled like the base's. `settings` ("parameter=value") are
/// set first. Throws `Error` if a parameter does not allow its value.
[[nodiscard]] std::shared_ptr<const Problem> instance_of(const std::shared_ptr<const Problem>& base,
                                                         const std::vector<std::string>& settings,
                                                         const std::vector<SweptQuantity>& quantities,
                                                         const std::vector<double>& values);

}  // namespace dmocbench
