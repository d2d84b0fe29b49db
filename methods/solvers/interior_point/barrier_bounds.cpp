#include "methods/solvers/interior_point/barrier_bounds.hpp"

#include <cmath>
#include <numeric>

#include "methods/solvers/interior_point/constants.hpp"

namespace dmocbench::interior_point {

namespace {

/// Σ ln, of eight numbers at a time: a product is cheaper than eight logarithms.
template <class Numbers>
double sum_of_logarithms(const Numbers& numbers) {
  constexpr Eigen::Index at_once = 8;
  constexpr double smallest = 1e-30;  // its eighth power is a number still
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

/// The longest step, at most 1, along which no distance shrinks by more than the share τ.
template <class Distances, class Changes>
double boundary_fraction(const Distances& distances, const Changes& changes, double tau) {
  const double largest_loss = (-changes / distances).maxCoeff();
  return largest_loss > tau ? tau / largest_loss : 1.0;
}

double total(const std::array<double, 4>& of_sets) { return std::accumulate(of_sets.begin(), of_sets.end(), 0.0); }

}  // namespace

BarrierBounds::BarrierBounds(const Primal& lower, const Primal& upper) {
  for (std::size_t set = 0; set < counts_.size(); ++set) {
    const auto part = set < 2 ? &Primal::x : &Primal::s;
    const bool is_lower = set % 2 == 0;
    const Eigen::VectorXd& low = lower.*part;
    const Eigen::VectorXd& high = upper.*part;
    const Eigen::VectorXd& values = is_lower ? low : high;
    Eigen::Index begin = 0;  // of the stretch that ends at `end`
    Eigen::Index end = 0;
    const auto add_stretch = [&] {
      if (begin == end) return;
      stretches_.push_back(
          {part, is_lower ? 1.0 : -1.0, set, begin, counts_[set], values.segment(begin, end - begin).array()});
      counts_[set] += end - begin;
    };
    for_each_bounded(low, high, [&](Eigen::Index i) {
      if (!std::isfinite(values[i]) || low[i] == high[i]) return;
      if (i != end) {
        add_stretch();
        begin = i;
      }
      end = i + 1;
    });
    add_stretch();
    count_ += counts_[set];
  }
}

void BarrierBounds::read(const Primal& lower, const Primal& upper) {
  for (BoundStretch& bounds : stretches_) bounds.values = bounds.entries(bounds.side > 0.0 ? lower : upper);
}

void BarrierBounds::set_multipliers(double value, Iterate& at) const {
  for (std::size_t set = 0; set < counts_.size(); ++set) at.z[set].setConstant(counts_[set], value);
}

void BarrierBounds::balance(double mu, const Primal& gradient, Iterate& at) const {
  for (const BoundStretch& bounds : stretches_) {
    bounds.z(at) = (mu / bounds.distances(at)).max(bounds.side * bounds.entries(gradient));
  }
}

double BarrierBounds::barrier(const Primal& at) const {
  std::array<double, 4> sums{};
  for (const BoundStretch& bounds : stretches_) sums[bounds.set] -= sum_of_logarithms(bounds.distances(at));
  return total(sums);
}

double BarrierBounds::barrier_derivative(const Primal& at, const Primal& step) const {
  std::array<double, 4> sums{};
  for (const BoundStretch& bounds : stretches_) {
    sums[bounds.set] -= (bounds.side * bounds.entries(step) / bounds.distances(at)).sum();
  }
  return total(sums);
}

void BarrierBounds::add_barrier(const Iterate& at, double mu, Primal& sigma, Primal& gradient) const {
  for (const BoundStretch& bounds : stretches_) {
    const auto distances = bounds.distances(at);
    bounds.entries(sigma) += bounds.z(at) / distances;
    bounds.entries(gradient) -= (bounds.side * mu) / distances;
  }
}

void BarrierBounds::add_nearness(const Primal& at, double mu, Primal& diagonal) const {
  for (const BoundStretch& bounds : stretches_) bounds.entries(diagonal) += mu / bounds.distances(at).square();
}

void BarrierBounds::subtract_multipliers(const Iterate& at, Primal& gradient) const {
  for (const BoundStretch& bounds : stretches_) bounds.entries(gradient) -= bounds.side * bounds.z(at);
}

double BarrierBounds::complementarity(const Iterate& at, double mu) const {
  double largest = 0.0;
  for (const BoundStretch& bounds : stretches_) {
    largest = std::max(largest, (bounds.distances(at) * bounds.z(at) - mu).abs().maxCoeff());
  }
  return largest;
}

void BarrierBounds::set_multiplier_step(const Iterate& at, double mu, Iterate& step) const {
  for (std::size_t set = 0; set < counts_.size(); ++set) step.z[set].resize(counts_[set]);
  for (const BoundStretch& bounds : stretches_) {
    const auto z = bounds.z(at);
    bounds.z(step) = (mu - bounds.side * z * bounds.entries(step)) / bounds.distances(at) - z;
  }
}

double BarrierBounds::fraction_to_boundary(const Primal& at, const Primal& step, double tau) const {
  double length = 1.0;
  for (const BoundStretch& bounds : stretches_) {
    length = std::min(length, boundary_fraction(bounds.distances(at), bounds.side * bounds.entries(step), tau));
  }
  return length;
}

double BarrierBounds::multiplier_fraction_to_boundary(const Iterate& at, const Iterate& step, double tau) const {
  double length = 1.0;
  for (const BoundStretch& bounds : stretches_) {
    length = std::min(length, boundary_fraction(bounds.z(at), bounds.z(step), tau));
  }
  return length;
}

void BarrierBounds::update_multipliers(const Iterate& step, double length, double mu, Iterate& at) const {
  using constants::kappa_sigma;
  for (const BoundStretch& bounds : stretches_) {
    const auto distances = bounds.distances(at);
    auto z = bounds.z(at);
    z += length * bounds.z(step);
    z = z.max((mu / kappa_sigma) / distances).min((mu * kappa_sigma) / distances);
  }
}

}  // namespace dmocbench::interior_point
