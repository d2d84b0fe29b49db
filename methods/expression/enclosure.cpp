#include "methods/expression/enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dmocbench {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;
constexpr Enclosure whole{-infinite, infinite};

Enclosure constant(double x) { return {x, x}; }

/// An end that is not a number (∞ - ∞) is unknown.
Enclosure known(double lower, double upper) {
  return {std::isnan(lower) ? -infinite : lower, std::isnan(upper) ? infinite : upper};
}

Enclosure sum(const Enclosure& x, const Enclosure& y) { return known(x.lower + y.lower, x.upper + y.upper); }
Enclosure negative(const Enclosure& x) { return {-x.upper, -x.lower}; }

double times(double x, double y) { return x == 0.0 || y == 0.0 ? 0.0 : x * y; }  // also 0 times infinity

Enclosure product(const Enclosure& x, const Enclosure& y) {
  const auto [least, largest] =
      std::minmax({times(x.lower, y.lower), times(x.lower, y.upper), times(x.upper, y.lower), times(x.upper, y.upper)});
  return {least, largest};
}

Enclosure square(const Enclosure& x) {
  const double a = x.lower * x.lower;
  const double b = x.upper * x.upper;
  return {x.contains(0.0) ? 0.0 : std::min(a, b), std::max(a, b)};
}

Enclosure reciprocal(const Enclosure& x) {
  if (x.lower > 0.0 || x.upper < 0.0) return {1.0 / x.upper, 1.0 / x.lower};
  if (x.lower == 0.0 && x.upper > 0.0) return {1.0 / x.upper, infinite};
  if (x.upper == 0.0 && x.lower < 0.0) return {-infinite, 1.0 / x.lower};
  return whole;
}

/// The part of a range where a function is defined.
Enclosure within(const Enclosure& x, double lower, double upper) {
  return {std::clamp(x.lower, lower, upper), std::clamp(x.upper, lower, upper)};
}

template <class Function>
Enclosure rising(const Enclosure& x, const Function& function) {
  return known(function(x.lower), function(x.upper));
}

Enclosure cosine(const Enclosure& x) {
  if (!(x.upper - x.lower < 2.0 * pi)) return {-1.0, 1.0};
  const double a = std::cos(x.lower);
  const double b = std::cos(x.upper);
  const auto passes = [&](double phase) {  // a multiple of 2π after `phase`
    return std::ceil((x.lower - phase) / (2.0 * pi)) * 2.0 * pi + phase <= x.upper;
  };
  return {passes(pi) ? -1.0 : std::min(a, b), passes(0.0) ? 1.0 : std::max(a, b)};
}

Enclosure sine(const Enclosure& x) { return cosine({x.lower - 0.5 * pi, x.upper - 0.5 * pi}); }

Enclosure power(const Enclosure& x, double exponent) {
  if (exponent == 0.0) return constant(1.0);
  if (exponent < 0.0) return reciprocal(power(x, -exponent));
  const auto raised = [exponent](double base) { return std::pow(base, exponent); };
  if (std::fmod(exponent, 2.0) == 0.0) {
    const double a = raised(x.lower);
    const double b = raised(x.upper);
    return {x.contains(0.0) ? 0.0 : std::min(a, b), std::max(a, b)};
  }
  return rising(std::floor(exponent) == exponent ? x : within(x, 0.0, infinite), raised);
}

/// f(x), where f has these values and this derivative over the range of x.
EnclosedRate chained(const EnclosedRate& x, const Enclosure& value, const Enclosure& derivative) {
  return {value, product(derivative, x.rate)};
}

/// √(1 + sign · x²).
Enclosure root_of_square(const Enclosure& x, double sign) {
  const Enclosure inside = sum(constant(1.0), product(constant(sign), square(x)));
  return rising(within(inside, 0.0, infinite), [](double y) { return std::sqrt(y); });
}

}  // namespace

EnclosedRate operator+(const EnclosedRate& x, const EnclosedRate& y) {
  return {sum(x.value, y.value), sum(x.rate, y.rate)};
}

EnclosedRate operator-(const EnclosedRate& x) { return {negative(x.value), negative(x.rate)}; }

EnclosedRate operator-(const EnclosedRate& x, const EnclosedRate& y) { return x + (-y); }

EnclosedRate operator*(const EnclosedRate& x, const EnclosedRate& y) {
  if (&x == &y) return chained(x, square(x.value), product(constant(2.0), x.value));
  return {product(x.value, y.value), sum(product(x.rate, y.value), product(x.value, y.rate))};
}

EnclosedRate operator/(double x, const EnclosedRate& y) {
  const Enclosure inverse = reciprocal(y.value);
  return chained(y, product(constant(x), inverse), product(constant(-x), square(inverse)));
}

EnclosedRate operator/(const EnclosedRate& x, const EnclosedRate& y) {
  return &x == &y ? EnclosedRate(1.0) : x * (1.0 / y);
}

EnclosedRate sqrt(const EnclosedRate& x) {
  const Enclosure root = power(x.value, 0.5);
  return chained(x, root, product(constant(0.5), reciprocal(root)));
}

EnclosedRate exp(const EnclosedRate& x) {
  const Enclosure value = rising(x.value, [](double y) { return std::exp(y); });
  return chained(x, value, value);
}

EnclosedRate log(const EnclosedRate& x) {
  const Enclosure inside = within(x.value, 0.0, infinite);
  return chained(x, rising(inside, [](double y) { return std::log(y); }), reciprocal(inside));
}

EnclosedRate sin(const EnclosedRate& x) { return chained(x, sine(x.value), cosine(x.value)); }

EnclosedRate cos(const EnclosedRate& x) { return chained(x, cosine(x.value), negative(sine(x.value))); }

EnclosedRate tan(const EnclosedRate& x) {
  const bool has_pole = !(std::floor(x.value.lower / pi + 0.5) == std::floor(x.value.upper / pi + 0.5));
  if (has_pole) return {whole, whole};
  const Enclosure value = rising(x.value, [](double y) { return std::tan(y); });
  return chained(x, value, sum(constant(1.0), square(value)));
}

EnclosedRate asin(const EnclosedRate& x) {
  const Enclosure inside = within(x.value, -1.0, 1.0);
  const Enclosure value = rising(inside, [](double y) { return std::asin(y); });
  return chained(x, value, reciprocal(root_of_square(inside, -1.0)));
}

EnclosedRate acos(const EnclosedRate& x) { return EnclosedRate(0.5 * pi) - asin(x); }

EnclosedRate atan(const EnclosedRate& x) {
  const Enclosure value = rising(x.value, [](double y) { return std::atan(y); });
  return chained(x, value, reciprocal(sum(constant(1.0), square(x.value))));
}

EnclosedRate atan2(const EnclosedRate& y, const EnclosedRate& x) {
  if (x.value.lower > 0.0) return atan(y / x);
  if (y.value.lower > 0.0) return EnclosedRate(0.5 * pi) - atan(x / y);
  if (y.value.upper < 0.0) return EnclosedRate(-0.5 * pi) - atan(x / y);
  return {{-pi, pi}, whole};
}

EnclosedRate sinh(const EnclosedRate& x) {
  const Enclosure value = rising(x.value, [](double y) { return std::sinh(y); });
  return chained(x, value, root_of_square(value, 1.0));
}

EnclosedRate cosh(const EnclosedRate& x) {
  const Enclosure rate = rising(x.value, [](double y) { return std::sinh(y); });
  return chained(x, root_of_square(rate, 1.0), rate);
}

EnclosedRate tanh(const EnclosedRate& x) {
  const Enclosure value = rising(x.value, [](double y) { return std::tanh(y); });
  return chained(x, value, sum(constant(1.0), negative(square(value))));
}

EnclosedRate pow(const EnclosedRate& x, double exponent) {
  return chained(x, power(x.value, exponent), product(constant(exponent), power(x.value, exponent - 1.0)));
}

EnclosedRate asinh(const EnclosedRate& x) {
  const Enclosure value = rising(x.value, [](double y) { return std::asinh(y); });
  return chained(x, value, reciprocal(root_of_square(x.value, 1.0)));
}

EnclosedRate erf(const EnclosedRate& x) {
  const Enclosure density = rising(negative(square(x.value)), [](double y) { return std::exp(y); });
  return chained(x, rising(x.value, [](double y) { return std::erf(y); }),
                 product(constant(2.0 * std::numbers::inv_sqrtpi), density));
}

EnclosedRate unit_step(const EnclosedRate& x) {
  if (x.value.lower > 0.0) return EnclosedRate(1.0);
  if (x.value.upper <= 0.0) return EnclosedRate(0.0);
  return {{0.0, 1.0}, whole};
}

}  // namespace dmocbench
