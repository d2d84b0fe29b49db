#include "methods/solvers/interior_point/bound_list.hpp"

#include <algorithm>
#include <cmath>

namespace dmocbench::interior_point {

BoundList bounds_of(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double side) {
  const Eigen::VectorXd& bounds = side > 0.0 ? lower : upper;
  BoundList list;
  std::vector<double> values;
  for_each_bounded(lower, upper, [&](Eigen::Index i) {
    if (!std::isfinite(bounds[i]) || lower[i] == upper[i]) return;
    if (list.stretches.empty() || list.stretches.back().entry + list.stretches.back().length != i) {
      list.stretches.push_back({i, static_cast<Eigen::Index>(values.size()), 0});
    }
    ++list.stretches.back().length;
    values.push_back(bounds[i]);
  });
  list.values = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return list;
}

std::vector<Eigen::Index> fixed_entries(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  std::vector<Eigen::Index> fixed;
  for_each_bounded(lower, upper, [&](Eigen::Index i) {
    if (lower[i] == upper[i]) fixed.push_back(i);
  });
  return fixed;
}

namespace {

/// Σ ln, of eight numbers at a time: to multiply them takes less than their logarithms.
template <class Numbers>
double sum_of_logarithms(const Numbers& numbers) {
  constexpr Eigen::Index at_once = 8;
  constexpr double smallest = 1e-30;  // to the power of eight it is a number still
  constexpr double largest = 1e30;
  double sum = 0.0;
  Eigen::Index i = 0;
  for (; i + at_once <= numbers.size(); i += at_once) {
    const Eigen::Array<double, at_once, 1> some = numbers.template segment<at_once>(i);
    const bool is_usual = some.minCoeff() > smallest && some.maxCoeff() < largest;
    sum += is_usual ? std::log(some.prod()) : some.log().sum();
  }
  return sum + numbers.tail(numbers.size() - i).log().sum();
}

}  // namespace

double barrier_of(const Eigen::VectorXd& vector, const BoundList& bounds, double side) {
  double sum = 0.0;
  for (const BoundList::Stretch& at : bounds.stretches) sum -= sum_of_logarithms(bounds.distances(vector, side, at));
  return sum;
}

double barrier_slope(const Eigen::VectorXd& vector, const Eigen::VectorXd& step, const BoundList& bounds) {
  double sum = 0.0;  // of -ln(x - l), and of -ln(u - x) alike
  for (const BoundList::Stretch& at : bounds.stretches) {
    sum -= (BoundList::entries(step, at) / bounds.distances(vector, 1.0, at)).sum();
  }
  return sum;
}

void add_barrier(const Eigen::VectorXd& vector, const BoundList& bounds, const Eigen::VectorXd& z, double side,
                 double mu, Eigen::VectorXd& diagonal, Eigen::VectorXd& slope) {
  for (const BoundList::Stretch& at : bounds.stretches) {
    const auto distances = bounds.distances(vector, side, at);
    BoundList::entries(diagonal, at) += BoundList::of_bounds(z, at) / distances;
    BoundList::entries(slope, at) -= (side * mu) / distances;
  }
}

void add_nearness(const Eigen::VectorXd& vector, const BoundList& bounds, double mu, Eigen::VectorXd& diagonal) {
  for (const BoundList::Stretch& at : bounds.stretches) {
    BoundList::entries(diagonal, at) += mu / bounds.distances(vector, 1.0, at).square();
  }
}

void subtract_multipliers(const BoundList& bounds, const Eigen::VectorXd& z, double side, Eigen::VectorXd& slope) {
  for (const BoundList::Stretch& at : bounds.stretches) {
    BoundList::entries(slope, at) -= side * BoundList::of_bounds(z, at);
  }
}

void balance_slope(const Eigen::VectorXd& vector, const BoundList& bounds, double side, double mu,
                   const Eigen::VectorXd& slope, Eigen::VectorXd& z) {
  for (const BoundList::Stretch& at : bounds.stretches) {
    const auto of_barrier = mu / bounds.distances(vector, side, at);
    BoundList::of_bounds(z, at) = of_barrier.max(side * BoundList::entries(slope, at));
  }
}

void set_bound_step(const Eigen::VectorXd& vector, const Eigen::VectorXd& step, const BoundList& bounds,
                    const Eigen::VectorXd& z, double side, double mu, Eigen::VectorXd& z_step) {
  z_step.resize(z.size());
  for (const BoundList::Stretch& at : bounds.stretches) {
    const auto of_bounds = BoundList::of_bounds(z, at);
    BoundList::of_bounds(z_step, at) =
        (mu - side * of_bounds * BoundList::entries(step, at)) / bounds.distances(vector, side, at) - of_bounds;
  }
}

namespace {

/// The longest step, at most 1, along which no distance shrinks by more than its share.
template <class Distances, class Changes>
double longest_step_of(const Distances& distances, const Changes& changes, double share) {
  const double largest_loss = (-changes / distances).maxCoeff();
  return largest_loss > share ? share / largest_loss : 1.0;
}

}  // namespace

double longest_step(const Eigen::VectorXd& vector, const Eigen::VectorXd& step, const BoundList& bounds, double side,
                    double share) {
  double length = 1.0;
  for (const BoundList::Stretch& at : bounds.stretches) {
    const auto changes = side * BoundList::entries(step, at);
    length = std::min(length, longest_step_of(bounds.distances(vector, side, at), changes, share));
  }
  return length;
}

double longest_step(const Eigen::VectorXd& z, const Eigen::VectorXd& step, double share) {
  return z.size() > 0 ? longest_step_of(z.array(), step.array(), share) : 1.0;
}

double complementarity_of(const Eigen::VectorXd& vector, const BoundList& bounds, const Eigen::VectorXd& z, double side,
                          double mu) {
  double largest = 0.0;
  for (const BoundList::Stretch& at : bounds.stretches) {
    const auto products = bounds.distances(vector, side, at) * BoundList::of_bounds(z, at);
    largest = std::max(largest, (products - mu).abs().maxCoeff());
  }
  return largest;
}

void keep_near(const Eigen::VectorXd& vector, const BoundList& bounds, double side, double mu, Eigen::VectorXd& z) {
  constexpr double kappa_sigma = 1e10;  // of Wächter and Biegler
  for (const BoundList::Stretch& at : bounds.stretches) {
    const auto distances = bounds.distances(vector, side, at);
    auto of_bounds = BoundList::of_bounds(z, at);
    of_bounds = of_bounds.max((mu / kappa_sigma) / distances).min((mu * kappa_sigma) / distances);
  }
}

}  // namespace dmocbench::interior_point
