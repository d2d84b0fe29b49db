#include "methods/expression/expression.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "methods/expression/node.hpp"

namespace dmocbench {

namespace {

using detail::NodeKey;
using detail::NodeTable;

Expression make(const NodeKey& key) { return Expression::of_node(NodeTable::of_this_thread().find_or_create(key)); }

Expression make(Operation operation, const Expression& x) {
  return make(NodeKey{.operation = operation, .operands = {x.node(), nullptr}});
}

Expression make(Operation operation, const Expression& x, const Expression& y) {
  return make(NodeKey{.operation = operation, .operands = {x.node(), y.node()}});
}

bool is(const Expression& x, Operation operation) { return x.node()->operation() == operation; }

Expression operand(const Expression& x, std::size_t which = 0) { return Expression::of_node(x.node()->operand(which)); }

bool created_before(const Expression& a, const Expression& b) { return a.node()->serial() < b.node()->serial(); }

/// x = factor · rest, where rest carries neither sign nor numeric factor (1 for a constant).
struct Scaled {
  double factor;
  Expression rest;
};

Scaled split(const Expression& x) {
  if (const auto value = x.constant_value()) return {*value, Expression(1.0)};
  if (is(x, Operation::negate)) {
    const Scaled inner = split(operand(x));
    return {-inner.factor, inner.rest};
  }
  if (is(x, Operation::multiply)) {
    if (const auto value = operand(x, 0).constant_value()) return {*value, operand(x, 1)};
  }
  return {1.0, x};
}

/// factor · rest in a canonical form, so that nodes are shared: the sign outside, then the magnitude, then the rest.
Expression scaled(double factor, const Expression& rest) {
  if (factor == 0.0) return {};
  if (const auto value = rest.constant_value()) return {factor * *value};
  if (factor == 1.0) return rest;
  if (factor == -1.0) return make(Operation::negate, rest);
  if (factor < 0.0) return make(Operation::negate, scaled(-factor, rest));
  return make(Operation::multiply, Expression(factor), rest);
}

/// The factors of a product, in no particular order. A factor nested deeper than the limit is not split: a product of a
/// million factors, or a power by repeated squaring, must not be expanded at every multiplication.
std::vector<Expression> factors_of(const Expression& product) {
  constexpr std::size_t limit = 32;
  std::vector<Expression> factors{product};
  for (std::size_t i = 0; i < factors.size() && factors.size() < limit;) {
    if (!is(factors[i], Operation::multiply)) {
      ++i;
      continue;
    }
    factors.push_back(operand(factors[i], 1));
    factors[i] = operand(factors[i], 0);
  }
  return factors;
}

bool are_reciprocal(const Expression& a, const Expression& b) {
  return (is(a, Operation::reciprocal) && operand(a).is_same(b)) ||
         (is(b, Operation::reciprocal) && operand(b).is_same(a));
}

/// Removes from both lists the factors that cancel against their own reciprocal; true if there were any.
bool cancel(std::vector<Expression>& left, std::vector<Expression>& right) {
  bool cancelled = false;
  for (std::size_t i = 0; i < left.size();) {
    const auto partner = std::find_if(right.begin(), right.end(),
                                      [&](const Expression& factor) { return are_reciprocal(left[i], factor); });
    if (partner == right.end()) {
      ++i;
      continue;
    }
    right.erase(partner);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    cancelled = true;
  }
  return cancelled;
}

/// The product of two rests (see Scaled).
Expression product(const Expression& left, const Expression& right) {
  if (left.constant_value() == 1.0) return right;
  if (right.constant_value() == 1.0) return left;
  std::vector<Expression> left_factors = factors_of(left);
  std::vector<Expression> right_factors = factors_of(right);
  if (cancel(left_factors, right_factors)) {
    Expression result(1.0);
    for (const auto* factors : {&left_factors, &right_factors}) {
      for (const Expression& factor : *factors) result *= factor;
    }
    return result;
  }
  return created_before(right, left) ? make(Operation::multiply, right, left) : make(Operation::multiply, left, right);
}

/// left + sign · right for two rests with |sign| = 1.
Expression sum(const Expression& left, const Expression& right, double sign) {
  const bool swap = created_before(right, left);
  if (sign > 0.0) {
    return swap ? make(Operation::add, right, left) : make(Operation::add, left, right);
  }
  // One of a - b and b - a exists in the graph; the other is its negative.
  return swap ? make(Operation::negate, make(Operation::subtract, right, left))
              : make(Operation::subtract, left, right);
}

Expression odd_function(Operation operation, const Expression& x) {
  if (is(x, Operation::negate)) return -make(operation, operand(x));
  return make(operation, x);
}

Expression even_function(Operation operation, const Expression& x) {
  if (is(x, Operation::negate)) return make(operation, operand(x));
  return make(operation, x);
}

Expression integer_power(const Expression& x, unsigned exponent) {
  if (exponent == 0) return {1.0};
  if (exponent == 1) return x;
  const Expression half = integer_power(x, exponent / 2);
  return exponent % 2 == 0 ? half * half : half * half * x;
}

}  // namespace

Expression::Expression() : Expression(0.0) {}

Expression::Expression(double value) : Expression(make(NodeKey{.operation = Operation::constant, .value = value})) {}

Expression Expression::input(std::size_t index) { return make(NodeKey{.operation = Operation::input, .index = index}); }

std::optional<double> Expression::constant_value() const noexcept {
  if (node_->operation() != Operation::constant) return std::nullopt;
  return node_->value();
}

Expression& Expression::operator+=(const Expression& right) { return *this = *this + right; }
Expression& Expression::operator-=(const Expression& right) { return *this = *this - right; }
Expression& Expression::operator*=(const Expression& right) { return *this = *this * right; }
Expression& Expression::operator/=(const Expression& right) { return *this = *this / right; }

Expression operator+(const Expression& left, const Expression& right) {
  const auto a = left.constant_value();
  const auto b = right.constant_value();
  if (a && b) return {*a + *b};
  if (a == 0.0) return right;
  if (b == 0.0) return left;
  const Scaled x = split(left);
  const Scaled y = split(right);
  if (x.rest.is_same(y.rest)) return scaled(x.factor + y.factor, x.rest);
  const bool both_vary = !a && !b;
  if (both_vary && std::abs(x.factor) == std::abs(y.factor)) {
    const double sign = x.factor == y.factor ? 1.0 : -1.0;  // not a quotient: the factors may be infinite
    return scaled(x.factor, Expression(1.0)) * sum(x.rest, y.rest, sign);
  }
  const Expression magnitude_x = scaled(std::abs(x.factor), x.rest);
  const Expression magnitude_y = scaled(std::abs(y.factor), y.rest);
  const bool same_sign = (x.factor < 0.0) == (y.factor < 0.0);
  const Expression result = sum(magnitude_x, magnitude_y, same_sign ? 1.0 : -1.0);
  return x.factor < 0.0 ? -result : result;
}

Expression operator-(const Expression& left, const Expression& right) { return left + (-right); }

Expression operator*(const Expression& left, const Expression& right) {
  const Scaled x = split(left);
  const Scaled y = split(right);
  const double factor = x.factor * y.factor;
  if (factor == 0.0) return {};
  const Expression rest = product(x.rest, y.rest);
  const Scaled z = split(rest);  // a cancellation may have left a plain sum or a constant
  return scaled(factor * z.factor, z.rest);
}

Expression operator/(const Expression& left, const Expression& right) {
  const auto divisor = right.constant_value();
  if (const auto dividend = left.constant_value(); dividend && divisor) {
    return {*dividend / *divisor};
  }
  if (divisor == 0.0) return left * Expression(1.0 / *divisor);
  const Scaled y = split(right);
  const Expression inverse = y.rest.constant_value()             ? Expression(1.0)
                             : is(y.rest, Operation::reciprocal) ? operand(y.rest)
                                                                 : make(Operation::reciprocal, y.rest);
  return left * inverse * Expression(1.0 / y.factor);
}

Expression operator-(const Expression& operand) {
  const Scaled x = split(operand);
  return scaled(-x.factor, x.rest);
}

Expression operator+(const Expression& operand) { return operand; }

Expression sqrt(const Expression& x) {
  if (const auto value = x.constant_value()) return {std::sqrt(*value)};
  return make(Operation::square_root, x);
}

Expression exp(const Expression& x) {
  if (const auto value = x.constant_value()) return {std::exp(*value)};
  return make(Operation::exponential, x);
}

Expression log(const Expression& x) {
  if (const auto value = x.constant_value()) return {std::log(*value)};
  return make(Operation::logarithm, x);
}

Expression sin(const Expression& x) {
  if (const auto value = x.constant_value()) return {std::sin(*value)};
  return odd_function(Operation::sine, x);
}

Expression cos(const Expression& x) {
  if (const auto value = x.constant_value()) return {std::cos(*value)};
  return even_function(Operation::cosine, x);
}

Expression tan(const Expression& x) {
  if (const auto value = x.constant_value()) return {std::tan(*value)};
  return odd_function(Operation::tangent, x);
}

Expression asin(const Expression& x) {
  if (const auto value = x.constant_value()) return {std::asin(*value)};
  return odd_function(Operation::arc_sine, x);
}

Expression acos(const Expression& x) {
  if (const auto value = x.constant_value()) return {std::acos(*value)};
  return make(Operation::arc_cosine, x);
}

Expression atan(const Expression& x) {
  if (const auto value = x.constant_value()) return {std::atan(*value)};
  return odd_function(Operation::arc_tangent, x);
}

Expression atan2(const Expression& y, const Expression& x) {
  const auto a = y.constant_value();
  const auto b = x.constant_value();
  if (a && b) return {std::atan2(*a, *b)};
  return make(Operation::arc_tangent2, y, x);
}

Expression sinh(const Expression& x) {
  if (const auto value = x.constant_value()) return {std::sinh(*value)};
  return odd_function(Operation::hyperbolic_sine, x);
}

Expression cosh(const Expression& x) {
  if (const auto value = x.constant_value()) return {std::cosh(*value)};
  return even_function(Operation::hyperbolic_cosine, x);
}

Expression tanh(const Expression& x) {
  if (const auto value = x.constant_value()) return {std::tanh(*value)};
  return odd_function(Operation::hyperbolic_tangent, x);
}

Expression pow(const Expression& x, double exponent) {
  constexpr double largest_product = 16.0;
  if (const auto value = x.constant_value()) return {std::pow(*value, exponent)};
  if (exponent == 0.5) return sqrt(x);
  if (exponent == -0.5) return 1.0 / sqrt(x);
  if (exponent == std::trunc(exponent) && std::abs(exponent) <= largest_product) {
    const Expression magnitude = integer_power(x, static_cast<unsigned>(std::abs(exponent)));
    return exponent < 0.0 ? 1.0 / magnitude : magnitude;
  }
  return make(NodeKey{.operation = Operation::power, .value = exponent, .operands = {x.node(), nullptr}});
}

}  // namespace dmocbench
