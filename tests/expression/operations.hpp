#pragma once

#include <cmath>

namespace dmocbench::tests {

/// Where both arguments of an operation may be sampled: inside its domain, away from its
/// singularities.
struct Domain {
  double low;
  double high;
};

/// Calls `visit(name, formula, domain)` for every operation; `formula(x, y)` works on any scalar.
///
/// Each using-declaration keeps a plain double from being taken for a constant expression.
template <class Visitor>
void visit_operations(const Visitor& visit) {
  const Domain all{-2.5, 2.5};
  const Domain positive{0.2, 4.0};
  const Domain inside_unit{-0.9, 0.9};
  visit(
      "x + y", [](const auto& x, const auto& y) { return x + y; }, all);
  visit(
      "x - y", [](const auto& x, const auto& y) { return x - y; }, all);
  visit(
      "y - x", [](const auto& x, const auto& y) { return y - x; }, all);
  visit(
      "x * y", [](const auto& x, const auto& y) { return x * y; }, all);
  visit(
      "x / y", [](const auto& x, const auto& y) { return x / y; }, positive);
  visit(
      "1 / x", [](const auto& x, const auto& /*y*/) { return 1.0 / x; }, Domain{-3.0, -0.2});
  visit(
      "-x", [](const auto& x, const auto& /*y*/) { return -x; }, all);
  visit(
      "sqrt",
      [](const auto& x, const auto& /*y*/) {
        using std::sqrt;
        return sqrt(x);
      },
      positive);
  visit(
      "exp",
      [](const auto& x, const auto& /*y*/) {
        using std::exp;
        return exp(x);
      },
      all);
  visit(
      "log",
      [](const auto& x, const auto& /*y*/) {
        using std::log;
        return log(x);
      },
      positive);
  visit(
      "sin",
      [](const auto& x, const auto& /*y*/) {
        using std::sin;
        return sin(x);
      },
      all);
  visit(
      "cos",
      [](const auto& x, const auto& /*y*/) {
        using std::cos;
        return cos(x);
      },
      all);
  visit(
      "tan",
      [](const auto& x, const auto& /*y*/) {
        using std::tan;
        return tan(x);
      },
      Domain{-1.3, 1.3});
  visit(
      "asin",
      [](const auto& x, const auto& /*y*/) {
        using std::asin;
        return asin(x);
      },
      inside_unit);
  visit(
      "acos",
      [](const auto& x, const auto& /*y*/) {
        using std::acos;
        return acos(x);
      },
      inside_unit);
  visit(
      "atan",
      [](const auto& x, const auto& /*y*/) {
        using std::atan;
        return atan(x);
      },
      all);
  visit(
      "atan2 right",
      [](const auto& y, const auto& x) {
        using std::atan2;
        return atan2(y, x);
      },
      positive);
  visit(
      "atan2 left",
      [](const auto& y, const auto& x) {
        using std::atan2;
        return atan2(y, x);
      },
      Domain{-4.0, -0.2});
  visit(
      "sinh",
      [](const auto& x, const auto& /*y*/) {
        using std::sinh;
        return sinh(x);
      },
      all);
  visit(
      "cosh",
      [](const auto& x, const auto& /*y*/) {
        using std::cosh;
        return cosh(x);
      },
      all);
  visit(
      "tanh",
      [](const auto& x, const auto& /*y*/) {
        using std::tanh;
        return tanh(x);
      },
      all);
  visit(
      "asinh",
      [](const auto& x, const auto& /*y*/) {
        using std::asinh;
        return asinh(x);
      },
      all);
  visit(
      "erf",
      [](const auto& x, const auto& /*y*/) {
        using std::erf;
        return erf(x);
      },
      all);
}

/// The same for x to a constant exponent: products, roots and genuine powers.
template <class Visitor>
void visit_powers(const Visitor& visit) {
  const auto power_of = [](double exponent) {
    return [exponent](const auto& x, const auto& /*y*/) {
      using std::pow;
      return pow(x, exponent);
    };
  };
  for (const double exponent : {1.0, 2.0, 3.0, 7.0, 16.0, -1.0, -2.0, -3.0, -16.0}) {
    visit("x^integer, x > 0", power_of(exponent), Domain{0.4, 2.0});
    visit("x^integer, x < 0", power_of(exponent), Domain{-2.0, -0.4});
  }
  for (const double exponent : {0.5, -0.5, 1.5, -1.5, 2.5, -2.5, 16.5, 17.0, -17.0, 0.3, -0.7, 2.718}) {
    visit("x^general", power_of(exponent), Domain{0.4, 2.0});
  }
}

}  // namespace dmocbench::tests
