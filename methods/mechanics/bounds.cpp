#include "methods/mechanics/bounds.hpp"

#include <cmath>
#include <limits>

#include "methods/error.hpp"

namespace dmocbench {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
}

Bounds Bounds::none(Eigen::Index size) {
  return {Eigen::VectorXd::Constant(size, -infinity), Eigen::VectorXd::Constant(size, infinity)};
}

Bounds Bounds::fixed(const Eigen::VectorXd& value) { return {value, value}; }

bool Bounds::is_bounded(Eigen::Index i) const { return lower[i] > -infinity || upper[i] < infinity; }

bool Bounds::any() const { return (lower.array() > -infinity).any() || (upper.array() < infinity).any(); }

EndBounds EndBounds::fixed(const BoundaryState& state) { return {Bounds::fixed(state.q), Bounds::fixed(state.v)}; }

EndBounds& EndBounds::free_configuration(Eigen::Index i) {
  q.lower[i] = -infinity;
  q.upper[i] = infinity;
  return *this;
}

EndBounds& EndBounds::free_velocity(Eigen::Index i) {
  v.lower[i] = -infinity;
  v.upper[i] = infinity;
  return *this;
}

Bounds checked_bounds(const Bounds& bounds, Eigen::Index size, const std::string& what) {
  if (bounds.empty()) return Bounds::none(size);
  for (const Eigen::VectorXd* side : {&bounds.lower, &bounds.upper}) {
    if (side->size() != size) {
      throw Error(what + " have " + std::to_string(side->size()) + " entries, expected " + std::to_string(size));
    }
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::string entry = what + ": entry " + std::to_string(i);
    if (std::isnan(bounds.lower[i]) || std::isnan(bounds.upper[i])) throw Error(entry + " is not a number");
    if (bounds.lower[i] > bounds.upper[i]) {
      throw Error(entry + " has the lower bound " + std::to_string(bounds.lower[i]) + " above the upper bound " +
                  std::to_string(bounds.upper[i]));
    }
  }
  return bounds;
}

}  // namespace dmocbench
