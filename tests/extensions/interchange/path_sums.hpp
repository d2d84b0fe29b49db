#pragma once

#include <cmath>
#include <numbers>

namespace dmocbench::tests {

/// A number with the sums of the absolute terms of its derivatives along two directions: over all paths through the
/// operations, the product of the magnitudes of their derivatives. Every way of differentiating adds up the same paths,
/// so that their rounding is small against these sums, however much cancels.
struct PathSums {
  double value = 0.0;
  double first = 0.0;   ///< along direction 1
  double second = 0.0;  ///< along direction 2
  double both = 0.0;    ///< second derivative along both

  PathSums() = default;
  PathSums(double number) : value(number) {}  // NOLINT(google-explicit-constructor,hicpp-explicit-conversions): 1.0 / x
  PathSums(double number, double along_1, double along_2, double along_both)
      : value(number), first(along_1), second(along_2), both(along_both) {}

  /// f(x) and its first two derivatives there.
  [[nodiscard]] static PathSums apply(double f, double slope, double curvature, const PathSums& x) {
    const double s = std::abs(slope);
    return {f, s * x.first, s * x.second, s * x.both + std::abs(curvature) * x.first * x.second};
  }
};

inline PathSums sum(double value, const PathSums& a, const PathSums& b) {
  return {value, a.first + b.first, a.second + b.second, a.both + b.both};
}
inline PathSums operator+(const PathSums& a, const PathSums& b) { return sum(a.value + b.value, a, b); }
inline PathSums operator-(const PathSums& a, const PathSums& b) { return sum(a.value - b.value, a, b); }
inline PathSums operator-(const PathSums& a) { return PathSums::apply(-a.value, 1.0, 0.0, a); }
inline PathSums operator*(const PathSums& a, const PathSums& b) {
  const double x = std::abs(a.value);
  const double y = std::abs(b.value);
  return {a.value * b.value, y * a.first + x * b.first, y * a.second + x * b.second,
          y * a.both + x * b.both + a.first * b.second + a.second * b.first};
}
inline PathSums reciprocal(const PathSums& x) {
  const double r = 1.0 / x.value;
  return PathSums::apply(r, r * r, 2.0 * r * r * r, x);
}
inline PathSums operator/(const PathSums& a, const PathSums& b) { return a * reciprocal(b); }

inline PathSums sqrt(const PathSums& x) {
  const double f = std::sqrt(x.value);
  return PathSums::apply(f, 0.5 / f, 0.25 / (f * x.value), x);
}
inline PathSums exp(const PathSums& x) {
  const double f = std::exp(x.value);
  return PathSums::apply(f, f, f, x);
}
inline PathSums log(const PathSums& x) {
  return PathSums::apply(std::log(x.value), 1.0 / x.value, 1.0 / (x.value * x.value), x);
}
inline PathSums sin(const PathSums& x) {
  return PathSums::apply(std::sin(x.value), std::cos(x.value), std::sin(x.value), x);
}
inline PathSums cos(const PathSums& x) {
  return PathSums::apply(std::cos(x.value), std::sin(x.value), std::cos(x.value), x);
}
inline PathSums tan(const PathSums& x) {
  const double f = std::tan(x.value);
  return PathSums::apply(f, 1.0 + f * f, 2.0 * f * (1.0 + f * f), x);
}
inline PathSums asin(const PathSums& x) {
  const double rest = 1.0 - x.value * x.value;
  return PathSums::apply(std::asin(x.value), 1.0 / std::sqrt(rest), x.value / (rest * std::sqrt(rest)), x);
}
inline PathSums acos(const PathSums& x) {
  const PathSums other = asin(x);
  return {std::acos(x.value), other.first, other.second, other.both};
}
inline PathSums atan(const PathSums& x) {
  const double slope = 1.0 / (1.0 + x.value * x.value);
  return PathSums::apply(std::atan(x.value), slope, 2.0 * x.value * slope * slope, x);
}
inline PathSums atan2(const PathSums& y, const PathSums& x) {
  PathSums result = atan(y / x);
  result.value = std::atan2(y.value, x.value);
  return result;
}
inline PathSums sinh(const PathSums& x) {
  return PathSums::apply(std::sinh(x.value), std::cosh(x.value), std::sinh(x.value), x);
}
inline PathSums cosh(const PathSums& x) {
  return PathSums::apply(std::cosh(x.value), std::sinh(x.value), std::cosh(x.value), x);
}
inline PathSums tanh(const PathSums& x) {
  const double f = std::tanh(x.value);
  return PathSums::apply(f, 1.0 - f * f, 2.0 * f * (1.0 - f * f), x);
}
inline PathSums asinh(const PathSums& x) {
  const double rest = 1.0 + x.value * x.value;
  return PathSums::apply(std::asinh(x.value), 1.0 / std::sqrt(rest), x.value / (rest * std::sqrt(rest)), x);
}
inline PathSums erf(const PathSums& x) {
  const double slope = 2.0 / std::sqrt(std::numbers::pi) * std::exp(-x.value * x.value);
  return PathSums::apply(std::erf(x.value), slope, 2.0 * x.value * slope, x);
}
inline PathSums unit_step(const PathSums& x) { return PathSums::apply(x.value > 0.0 ? 1.0 : 0.0, 0.0, 0.0, x); }
inline PathSums pow(const PathSums& x, double exponent) {
  return PathSums::apply(std::pow(x.value, exponent), exponent * std::pow(x.value, exponent - 1.0),
                         exponent * (exponent - 1.0) * std::pow(x.value, exponent - 2.0), x);
}

}  // namespace dmocbench::tests
