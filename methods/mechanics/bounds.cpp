#include "methods/mechanics/bounds.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "methods/error.hpp"

namespace dmocbench {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
}

Bounds Bounds::none(Eigen::Index size) { return all(size, -infinity, infinity); }

Bounds Bounds::all(Eigen::Index size, double lower, double upper) {
  return {Eigen::VectorXd::Constant(size, lower), Eigen::VectorXd::Constant(size, upper)};
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

std::vector<Eigen::Index> ProblemBounds::bounded_velocities() const {
  std::vector<Eigen::Index> bounded;
  for (Eigen::Index i = 0; i < v.lower.size(); ++i) {
    if (v.is_bounded(i)) bounded.push_back(i);
  }
  return bounded;
}

Bounds checked_bounds(const Bounds& bounds, Eigen::Index size, const std::string& what) {
  if (bounds.empty()) return Bounds::none(size);
  for (const Eigen::VectorXd* side : {&bounds.lower, &bounds.upper}) {
    if (side->size() != size) {
      throw Error(fmt::format("{} has {} entries, expected {}", what, side->size(), size));
    }
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::string entry = fmt::format("{}: entry {}", what, i);
    if (std::isnan(bounds.lower[i]) || std::isnan(bounds.upper[i])) throw Error(entry + " is not a number");
    if (bounds.lower[i] > bounds.upper[i]) {
      throw Error(fmt::format("{} has the lower bound {:g} above the upper bound {:g}", entry, bounds.lower[i],
                              bounds.upper[i]));
    }
  }
  return bounds;
}

}  // namespace dmocbench
