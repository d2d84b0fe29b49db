#include "methods/solvers/interior_point/bound_list.hpp"

#include <algorithm>
#include <cmath>

namespace dmocbench::interior_point {

namespace {

/// Calls action(b, entry, distance) for every bound.
template <class Action>
void for_each_bound(const Eigen::VectorXd& vector, const BoundList& bounds, double side, const Action& action) {
  for (std::size_t b = 0; b < bounds.entries.size(); ++b) {
    action(static_cast<Eigen::Index>(b), bounds.entries[b], bounds.distance(vector, side, b));
  }
}

}  // namespace

BoundList bounds_of(const Eigen::VectorXd& bounds, const Eigen::VectorXd& others) {
  BoundList list;
  std::vector<double> values;
  for (Eigen::Index i = 0; i < bounds.size(); ++i) {
    if (!std::isfinite(bounds[i]) || bounds[i] == others[i]) continue;
    list.entries.push_back(i);
    values.push_back(bounds[i]);
  }
  list.values = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return list;
}

double barrier_of(const Eigen::VectorXd& vector, const BoundList& bounds, double side) {
  double sum = 0.0;
  for_each_bound(vector, bounds, side, [&](auto, auto, double distance) { sum -= std::log(distance); });
  return sum;
}

double barrier_slope(const Eigen::VectorXd& vector, const Eigen::VectorXd& step, const BoundList& bounds) {
  double sum = 0.0;  // of -ln(x - l), and of -ln(u - x) alike
  for_each_bound(vector, bounds, 1.0,
                 [&](auto, Eigen::Index entry, double signed_distance) { sum -= step[entry] / signed_distance; });
  return sum;
}

void add_barrier(const Eigen::VectorXd& vector, const BoundList& bounds, const Eigen::VectorXd& z, double side,
                 double mu, Eigen::VectorXd& diagonal, Eigen::VectorXd& slope) {
  for_each_bound(vector, bounds, side, [&](Eigen::Index b, Eigen::Index entry, double distance) {
    diagonal[entry] += z[b] / distance;
    slope[entry] -= side * mu / distance;
  });
}

void add_nearness(const Eigen::VectorXd& vector, const BoundList& bounds, double mu, Eigen::VectorXd& diagonal) {
  for_each_bound(vector, bounds, 1.0, [&](auto, Eigen::Index entry, double signed_distance) {
    diagonal[entry] += mu / (signed_distance * signed_distance);
  });
}

void subtract_multipliers(const BoundList& bounds, const Eigen::VectorXd& z, double side, Eigen::VectorXd& slope) {
  for (std::size_t b = 0; b < bounds.entries.size(); ++b) {
    slope[bounds.entries[b]] -= side * z[static_cast<Eigen::Index>(b)];
  }
}

Eigen::VectorXd bound_step(const Eigen::VectorXd& vector, const Eigen::VectorXd& step, const BoundList& bounds,
                           const Eigen::VectorXd& z, double side, double mu) {
  Eigen::VectorXd result(z.size());
  for_each_bound(vector, bounds, side, [&](Eigen::Index b, Eigen::Index entry, double distance) {
    result[b] = mu / distance - z[b] - z[b] / distance * side * step[entry];
  });
  return result;
}

double longest_step(const Eigen::VectorXd& vector, const Eigen::VectorXd& step, const BoundList& bounds, double side,
                    double share) {
  double length = 1.0;
  for_each_bound(vector, bounds, side, [&](auto, Eigen::Index entry, double distance) {
    const double change = side * step[entry];
    if (change < 0.0) length = std::min(length, -share * distance / change);
  });
  return length;
}

double longest_step(const Eigen::VectorXd& z, const Eigen::VectorXd& step, double share) {
  double length = 1.0;
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    if (step[i] < 0.0) length = std::min(length, -share * z[i] / step[i]);
  }
  return length;
}

double complementarity(const Eigen::VectorXd& vector, const BoundList& bounds, const Eigen::VectorXd& z, double side,
                       double mu) {
  double largest = 0.0;
  for_each_bound(vector, bounds, side, [&](Eigen::Index b, auto, double distance) {
    largest = std::max(largest, std::abs(distance * z[b] - mu));
  });
  return largest;
}

void keep_near_barrier(const Eigen::VectorXd& vector, const BoundList& bounds, double side, double mu,
                       Eigen::VectorXd& z) {
  constexpr double kappa_sigma = 1e10;  // of Wächter and Biegler
  for_each_bound(vector, bounds, side, [&](Eigen::Index b, auto, double distance) {
    z[b] = std::clamp(z[b], mu / distance / kappa_sigma, mu / distance * kappa_sigma);
  });
}

}  // namespace dmocbench::interior_point
