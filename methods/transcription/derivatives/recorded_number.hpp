#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>

#include <adolc/adolc.h>

namespace dmocbench {

/// A number of a recording by ADOL-C, for `replay`. It is a constant until it is combined with an independent variable,
/// so that ADOL-C records no operation on constants. Copies share the variable, so that copying records nothing.
class RecordedNumber {
 public:
  /// A constant.
  explicit RecordedNumber(double value) : value_(value) {}
  /// An independent variable, or a result of ADOL-C's.
  explicit RecordedNumber(std::shared_ptr<const adouble> variable) : variable_(std::move(variable)) {}

  /// The result of a function of ADOL-C. (It is never applied to constants, which are folded while formulas are
  /// traced.)
  template <class Function>
  static RecordedNumber of(const Function& function, const RecordedNumber& x) {
    return kept(x.variable_ ? function(*x.variable_) : function(adouble(x.value_)));
  }
  /// The result of an operation that is defined on doubles and on ADOL-C's variables.
  template <class Function>
  static RecordedNumber of(const Function& function, const RecordedNumber& x, const RecordedNumber& y) {
    if (x.variable_ && y.variable_) return kept(function(*x.variable_, *y.variable_));
    if (x.variable_) return kept(function(*x.variable_, y.value_));
    if (y.variable_) return kept(function(x.value_, *y.variable_));
    return kept(function(x.value_, y.value_));
  }
  /// A copy that ADOL-C records, also of a constant.
  [[nodiscard]] adouble variable() const { return variable_ ? *variable_ : adouble(value_); }

 private:
  template <class Result>
  static RecordedNumber kept(const Result& result) {
    if constexpr (std::is_same_v<Result, double>) {
      return RecordedNumber(result);
    } else {
      return RecordedNumber(std::make_shared<const adouble>(result));
    }
  }

  double value_ = 0.0;
  std::shared_ptr<const adouble> variable_;  // null for a constant
};

/// The sum.
[[nodiscard]] inline RecordedNumber operator+(const RecordedNumber& x, const RecordedNumber& y) {
  return RecordedNumber::of(std::plus<>(), x, y);
}
/// The difference.
[[nodiscard]] inline RecordedNumber operator-(const RecordedNumber& x, const RecordedNumber& y) {
  return RecordedNumber::of(std::minus<>(), x, y);
}
/// The product.
[[nodiscard]] inline RecordedNumber operator*(const RecordedNumber& x, const RecordedNumber& y) {
  return RecordedNumber::of(std::multiplies<>(), x, y);
}
/// The quotient.
[[nodiscard]] inline RecordedNumber operator/(const RecordedNumber& x, const RecordedNumber& y) {
  return RecordedNumber::of(std::divides<>(), x, y);
}
/// The quotient.
[[nodiscard]] inline RecordedNumber operator/(double x, const RecordedNumber& y) { return RecordedNumber(x) / y; }
/// The negative.
[[nodiscard]] inline RecordedNumber operator-(const RecordedNumber& x) {
  return RecordedNumber::of(std::negate<>(), x);
}
/// √x.
[[nodiscard]] inline RecordedNumber sqrt(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return sqrt(a); }, x);
}
/// e to the x.
[[nodiscard]] inline RecordedNumber exp(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return exp(a); }, x);
}
/// The natural logarithm.
[[nodiscard]] inline RecordedNumber log(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return log(a); }, x);
}
/// The sine of x radians.
[[nodiscard]] inline RecordedNumber sin(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return sin(a); }, x);
}
/// The cosine of x radians.
[[nodiscard]] inline RecordedNumber cos(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return cos(a); }, x);
}
/// The tangent of x radians.
[[nodiscard]] inline RecordedNumber tan(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return tan(a); }, x);
}
/// The inverse sine, in radians.
[[nodiscard]] inline RecordedNumber asin(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return asin(a); }, x);
}
/// The inverse cosine, in radians.
[[nodiscard]] inline RecordedNumber acos(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return acos(a); }, x);
}
/// The inverse tangent, in radians.
[[nodiscard]] inline RecordedNumber atan(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return atan(a); }, x);
}
/// The hyperbolic sine.
[[nodiscard]] inline RecordedNumber sinh(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return sinh(a); }, x);
}
/// The hyperbolic cosine.
[[nodiscard]] inline RecordedNumber cosh(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return cosh(a); }, x);
}
/// The hyperbolic tangent.
[[nodiscard]] inline RecordedNumber tanh(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return tanh(a); }, x);
}
/// The inverse hyperbolic sine.
[[nodiscard]] inline RecordedNumber asinh(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return asinh(a); }, x);
}
/// The error function.
[[nodiscard]] inline RecordedNumber erf(const RecordedNumber& x) {
  return RecordedNumber::of([](const auto& a) { return erf(a); }, x);
}
/// 1 where x > 0, else 0.
[[nodiscard]] inline RecordedNumber unit_step(const RecordedNumber& x) {
  adouble result;
  condassign(result, x.variable(), adouble(1.0), adouble(0.0));
  return RecordedNumber(std::make_shared<const adouble>(result));
}
/// x to a constant exponent.
[[nodiscard]] inline RecordedNumber pow(const RecordedNumber& x, double exponent) {
  return RecordedNumber::of([exponent](const auto& a) { return pow(a, exponent); }, x);
}
/// As std::atan2.
[[nodiscard]] inline RecordedNumber atan2(const RecordedNumber& x, const RecordedNumber& y) {
  // ADOL-C's atan2 takes no constants.
  return RecordedNumber(std::make_shared<const adouble>(atan2(x.variable(), y.variable())));
}

}  // namespace dmocbench
