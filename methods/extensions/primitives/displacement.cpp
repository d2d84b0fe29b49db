#include "methods/extensions/primitives/displacement.hpp"

#include <algorithm>
#include <utility>

namespace dmocbench {

Displacement Displacement::identity(Eigen::Index n) { return translation(Eigen::VectorXd::Zero(n)); }

Displacement Displacement::translation(Eigen::VectorXd b) {
  const Eigen::Index n = b.size();
  return {.linear = Eigen::MatrixXd::Identity(n, n), .shift = std::move(b)};
}

Displacement Displacement::after(const Displacement& other) const {
  return {.linear = linear * other.linear, .shift = configuration(other.shift)};
}

double Displacement::distance(const Displacement& other) const {
  return std::max((linear - other.linear).lpNorm<Eigen::Infinity>(), (shift - other.shift).lpNorm<Eigen::Infinity>());
}

}  // namespace dmocbench
