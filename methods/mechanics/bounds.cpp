#include "methods/mechanics/bounds.hpp"

#include <limits>

namespace dmocbench {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
}

Bounds Bounds::none(Eigen::Index size) { return all(size, -infinity, infinity); }

Bounds Bounds::all(Eigen::Index size, double lower, double upper) {
  return {Eigen::VectorXd::Constant(size, lower), Eigen::VectorXd::Constant(size, upper)};
}

Bounds Bounds::fixed(const Eigen::VectorXd& value) { return {value, value}; }

void Bounds::free(Eigen::Index i) {
  lower[i] = -infinity;
  upper[i] = infinity;
}

bool Bounds::is_bounded(Eigen::Index i) const { return lower[i] > -infinity || upper[i] < infinity; }

bool Bounds::any() const { return (lower.array() > -infinity).any() || (upper.array() < infinity).any(); }

EndBounds EndBounds::fixed(const BoundaryState& state) {
  return {Bounds::fixed(state.q), Bounds::fixed(state.v), Bounds::fixed(state.y)};
}

EndBounds& EndBounds::free_configuration(Eigen::Index i) {
  q.free(i);
  return *this;
}

EndBounds& EndBounds::free_velocity(Eigen::Index i) {
  v.free(i);
  return *this;
}

EndBounds& EndBounds::free_first_order(Eigen::Index i) {
  y.free(i);
  return *this;
}

Bounds ProblemBounds::of_path(Eigen::Index count) const {
  return path.empty() ? Bounds::all(count, 0.0, std::numeric_limits<double>::infinity()) : path;
}

std::vector<Eigen::Index> ProblemBounds::bounded_velocities() const {
  std::vector<Eigen::Index> bounded;
  for (Eigen::Index i = 0; i < v.lower.size(); ++i) {
    if (v.is_bounded(i)) bounded.push_back(i);
  }
  return bounded;
}

}  // namespace dmocbench
