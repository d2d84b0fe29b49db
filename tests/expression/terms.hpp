#pragma once

#include <cmath>
#include <numbers>

namespace dmocbench::tests {

/// A number that remembers how large the terms were that it came from.
///
/// A rounding error of one unit in any operation on the way shows in the result as at most
/// `magnitude` times the unit: the sum of the magnitudes of all terms, carried through derivatives
/// to first order. Replayed on a schedule it tells how close two evaluations of that schedule have
/// to be, however much cancels.
struct Terms {
  double value = 0.0;
  double magnitude = 0.0;

  Terms() = default;
  Terms(double number)  // NOLINT(google-explicit-constructor,hicpp-explicit-conversions): 1.0 / x
                        // must read so
      : value(number), magnitude(std::abs(number)) {}
  Terms(double number, double size) : value(number), magnitude(size) {}

  /// f(x) and its derivative there.
  [[nodiscard]] static Terms apply(double f, double slope, const Terms& x) {
    return {f, std::abs(f) + std::abs(slope) * x.magnitude};
  }
};

inline Terms operator+(const Terms& a, const Terms& b) { return {a.value + b.value, a.magnitude + b.magnitude}; }
inline Terms operator-(const Terms& a, const Terms& b) { return {a.value - b.value, a.magnitude + b.magnitude}; }
inline Terms operator-(const Terms& a) { return {-a.value, a.magnitude}; }
inline Terms operator*(const Terms& a, const Terms& b) {
  return {a.value * b.value, std::abs(a.value) * b.magnitude + std::abs(b.value) * a.magnitude};
}
inline Terms operator/(const Terms& a, const Terms& b) {
  const double quotient = a.value / b.value;
  return {quotient, (a.magnitude + std::abs(quotient) * b.magnitude) / std::abs(b.value)};
}

inline Terms sqrt(const Terms& x) { return Terms::apply(std::sqrt(x.value), 0.5 / std::sqrt(x.value), x); }
inline Terms exp(const Terms& x) { return Terms::apply(std::exp(x.value), std::exp(x.value), x); }
inline Terms log(const Terms& x) { return Terms::apply(std::log(x.value), 1.0 / x.value, x); }
inline Terms sin(const Terms& x) { return Terms::apply(std::sin(x.value), std::cos(x.value), x); }
inline Terms cos(const Terms& x) { return Terms::apply(std::cos(x.value), std::sin(x.value), x); }
inline Terms tan(const Terms& x) {
  const double f = std::tan(x.value);
  return Terms::apply(f, 1.0 + f * f, x);
}
inline Terms asin(const Terms& x) {
  return Terms::apply(std::asin(x.value), 1.0 / std::sqrt(1.0 - x.value * x.value), x);
}
inline Terms acos(const Terms& x) {
  return Terms::apply(std::acos(x.value), 1.0 / std::sqrt(1.0 - x.value * x.value), x);
}
inline Terms atan(const Terms& x) { return Terms::apply(std::atan(x.value), 1.0 / (1.0 + x.value * x.value), x); }
inline Terms atan2(const Terms& y, const Terms& x) {
  const double angle = std::atan2(y.value, x.value);
  const double squared_radius = x.value * x.value + y.value * y.value;
  const double carried = std::abs(x.value) * y.magnitude + std::abs(y.value) * x.magnitude;
  return {angle, std::abs(angle) + carried / squared_radius};
}
inline Terms sinh(const Terms& x) { return Terms::apply(std::sinh(x.value), std::cosh(x.value), x); }
inline Terms cosh(const Terms& x) { return Terms::apply(std::cosh(x.value), std::sinh(x.value), x); }
inline Terms tanh(const Terms& x) {
  const double f = std::tanh(x.value);
  return Terms::apply(f, 1.0 - f * f, x);
}
inline Terms asinh(const Terms& x) {
  return Terms::apply(std::asinh(x.value), 1.0 / std::sqrt(1.0 + x.value * x.value), x);
}
inline Terms erf(const Terms& x) {
  return Terms::apply(std::erf(x.value), 2.0 * std::numbers::inv_sqrtpi * std::exp(-x.value * x.value), x);
}
inline Terms unit_step(const Terms& x) { return x.value > 0.0 ? 1.0 : 0.0; }
inline Terms pow(const Terms& x, double exponent) {
  return Terms::apply(std::pow(x.value, exponent), exponent * std::pow(x.value, exponent - 1.0), x);
}

}  // namespace dmocbench::tests
