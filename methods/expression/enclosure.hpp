#pragma once

namespace dmocbench {

/// An interval that contains all values of a quantity. Its ends are rounded to nearest, not outwards: what is decided
/// by it allows for rounding. Infinite ends where a formula has a pole or an argument may leave its domain.
struct Enclosure {
  double lower = 0.0;  ///< at most every value
  double upper = 0.0;  ///< at least every value

  /// Whether a number lies in it.
  [[nodiscard]] bool contains(double x) const noexcept { return lower <= x && x <= upper; }
};

/// A quantity along a parameter τ and its rate by τ, both enclosed: a scalar for `replay`, which then bounds a formula
/// and its rate over a part of the parameter.
///
/// Enclosures shrink with the part, the error of `value` in proportion to it. A jump (`Operation::unit_step`) has an
/// unbounded rate.
struct EnclosedRate {
  EnclosedRate() = default;
  /// A constant.
  explicit EnclosedRate(double constant) : value{constant, constant} {}
  /// Both.
  EnclosedRate(Enclosure of_value, Enclosure of_rate) : value(of_value), rate(of_rate) {}

  Enclosure value;  ///< of the quantity
  Enclosure rate;   ///< of its derivative by τ
};

// One for each `Operation`, which `replay` calls.
/// @cond
[[nodiscard]] EnclosedRate operator+(const EnclosedRate& x, const EnclosedRate& y);
[[nodiscard]] EnclosedRate operator-(const EnclosedRate& x, const EnclosedRate& y);
[[nodiscard]] EnclosedRate operator-(const EnclosedRate& x);
[[nodiscard]] EnclosedRate operator*(const EnclosedRate& x, const EnclosedRate& y);
[[nodiscard]] EnclosedRate operator/(const EnclosedRate& x, const EnclosedRate& y);
[[nodiscard]] EnclosedRate operator/(double x, const EnclosedRate& y);
[[nodiscard]] EnclosedRate sqrt(const EnclosedRate& x);
[[nodiscard]] EnclosedRate exp(const EnclosedRate& x);
[[nodiscard]] EnclosedRate log(const EnclosedRate& x);
[[nodiscard]] EnclosedRate sin(const EnclosedRate& x);
[[nodiscard]] EnclosedRate cos(const EnclosedRate& x);
[[nodiscard]] EnclosedRate tan(const EnclosedRate& x);
[[nodiscard]] EnclosedRate asin(const EnclosedRate& x);
[[nodiscard]] EnclosedRate acos(const EnclosedRate& x);
[[nodiscard]] EnclosedRate atan(const EnclosedRate& x);
[[nodiscard]] EnclosedRate atan2(const EnclosedRate& y, const EnclosedRate& x);
[[nodiscard]] EnclosedRate sinh(const EnclosedRate& x);
[[nodiscard]] EnclosedRate cosh(const EnclosedRate& x);
[[nodiscard]] EnclosedRate tanh(const EnclosedRate& x);
[[nodiscard]] EnclosedRate pow(const EnclosedRate& x, double exponent);
[[nodiscard]] EnclosedRate asinh(const EnclosedRate& x);
[[nodiscard]] EnclosedRate erf(const EnclosedRate& x);
[[nodiscard]] EnclosedRate unit_step(const EnclosedRate& x);
/// @endcond

}  // namespace dmocbench
