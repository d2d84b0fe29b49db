#pragma once

#include <cmath>
#include <numbers>

namespace dmocbench::tests {

/// x + e1 ε₁ + e2 ε₂ + e12 ε₁ε₂ with ε₁² = ε₂² = 0: forward-mode first and second derivatives, exact to rounding, and
/// sharing nothing with the suite's own symbolic reverse mode.
struct HyperDual {
  double x = 0.0;
  double e1 = 0.0;
  double e2 = 0.0;
  double e12 = 0.0;
  HyperDual() = default;
  HyperDual(double value, double first = 0.0, double second = 0.0, double mixed = 0.0)
      : x(value), e1(first), e2(second), e12(mixed) {}

  /// f(a) for a function with value f, derivative f1 and curvature f2 at a.x.
  static HyperDual chain(const HyperDual& a, double f, double f1, double f2) {
    return {f, f1 * a.e1, f1 * a.e2, f1 * a.e12 + f2 * a.e1 * a.e2};
  }
};

inline HyperDual operator+(const HyperDual& a, const HyperDual& b) {
  return {a.x + b.x, a.e1 + b.e1, a.e2 + b.e2, a.e12 + b.e12};
}
inline HyperDual operator-(const HyperDual& a) { return {-a.x, -a.e1, -a.e2, -a.e12}; }
inline HyperDual operator-(const HyperDual& a, const HyperDual& b) { return a + (-b); }
inline HyperDual operator*(const HyperDual& a, const HyperDual& b) {
  return {a.x * b.x, a.e1 * b.x + a.x * b.e1, a.e2 * b.x + a.x * b.e2,
          a.e12 * b.x + a.e1 * b.e2 + a.e2 * b.e1 + a.x * b.e12};
}
inline HyperDual reciprocal(const HyperDual& a) {
  const double r = 1.0 / a.x;
  return HyperDual::chain(a, r, -r * r, 2.0 * r * r * r);
}
inline HyperDual operator/(const HyperDual& a, const HyperDual& b) { return a * reciprocal(b); }

inline HyperDual sqrt(const HyperDual& a) {
  const double r = std::sqrt(a.x);
  return HyperDual::chain(a, r, 0.5 / r, -0.25 / (r * a.x));
}
inline HyperDual exp(const HyperDual& a) {
  const double r = std::exp(a.x);
  return HyperDual::chain(a, r, r, r);
}
inline HyperDual log(const HyperDual& a) { return HyperDual::chain(a, std::log(a.x), 1.0 / a.x, -1.0 / (a.x * a.x)); }
inline HyperDual sin(const HyperDual& a) { return HyperDual::chain(a, std::sin(a.x), std::cos(a.x), -std::sin(a.x)); }
inline HyperDual cos(const HyperDual& a) { return HyperDual::chain(a, std::cos(a.x), -std::sin(a.x), -std::cos(a.x)); }
inline HyperDual tan(const HyperDual& a) { return sin(a) / cos(a); }
inline HyperDual sinh(const HyperDual& a) {
  return HyperDual::chain(a, std::sinh(a.x), std::cosh(a.x), std::sinh(a.x));
}
inline HyperDual cosh(const HyperDual& a) {
  return HyperDual::chain(a, std::cosh(a.x), std::sinh(a.x), std::cosh(a.x));
}
inline HyperDual tanh(const HyperDual& a) { return sinh(a) / cosh(a); }
inline HyperDual atan(const HyperDual& a) {
  const double d = 1.0 / (1.0 + a.x * a.x);
  return HyperDual::chain(a, std::atan(a.x), d, -2.0 * a.x * d * d);
}
inline HyperDual asin(const HyperDual& a) {
  const double d = 1.0 / std::sqrt(1.0 - a.x * a.x);
  return HyperDual::chain(a, std::asin(a.x), d, a.x * d * d * d);
}
inline HyperDual acos(const HyperDual& a) { return HyperDual(std::acos(0.0)) - asin(a); }
inline HyperDual asinh(const HyperDual& a) {
  const double d = 1.0 / std::sqrt(1.0 + a.x * a.x);
  return HyperDual::chain(a, std::asinh(a.x), d, -a.x * d * d * d);
}
inline HyperDual erf(const HyperDual& a) {
  const double d = 2.0 * std::numbers::inv_sqrtpi * std::exp(-a.x * a.x);
  return HyperDual::chain(a, std::erf(a.x), d, -2.0 * a.x * d);
}
inline HyperDual unit_step(const HyperDual& a) { return a.x > 0.0 ? 1.0 : 0.0; }
/// Right of the y axis, where the formulas of these tests stay.
inline HyperDual atan2(const HyperDual& y, const HyperDual& x) { return atan(y / x); }
inline HyperDual pow(const HyperDual& a, double e) {
  return HyperDual::chain(a, std::pow(a.x, e), e * std::pow(a.x, e - 1.0), e * (e - 1.0) * std::pow(a.x, e - 2.0));
}

}  // namespace dmocbench::tests
