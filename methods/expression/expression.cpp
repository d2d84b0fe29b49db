#include "methods/expression/expression.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

namespace dmocbench {

namespace {

using detail::Node;
using detail::NodeKey;
using detail::NodeTable;

Expression make(const NodeKey& key) { return Expression::of_node(NodeTable::of_this_thread().find_or_create(key)); }

Expression make(Operation operation, Node* x, Node* y = nullptr) {
  return make(NodeKey{.operation = operation, .operands = {x, y}});
}

bool is(const Node* x, Operation operation) { return x->operation() == operation; }

bool created_before(const Node* a, const Node* b) { return a->serial() < b->serial(); }

/// x = factor · rest, where rest carries neither sign nor numeric factor. Of a constant, rest is null and stands for 1.
/// The expression that was split keeps the rest alive.
struct Scaled {
  double factor;
  Node* rest;
};

Scaled split(const Expression& x) {
  Node* node = x.node();
  double sign = 1.0;
  for (; is(node, Operation::negate); node = node->operand(0)) sign = -sign;
  if (is(node, Operation::constant)) return {sign * node->value(), nullptr};
  if (is(node, Operation::multiply) && is(node->operand(0), Operation::constant)) {
    return {sign * node->operand(0)->value(), node->operand(1)};
  }
  return {sign, node};
}

/// factor · rest in a canonical form, so that nodes are shared: the sign outside, then the magnitude, then the rest.
Expression join(double factor, Node* rest) {
  if (factor == 0.0) return {};
  if (rest == nullptr) return {factor};
  if (factor == 1.0) return Expression::of_node(rest);
  if (factor == -1.0) return make(Operation::negate, rest);
  if (factor < 0.0) return make(Operation::negate, join(-factor, rest).node());
  return make(Operation::multiply, Expression(factor).node(), rest);
}

Expression scaled(double factor, const Expression& x) {
  const Scaled parts = split(x);
  return join(factor * parts.factor, parts.rest);
}

/// The factors of a product, in no particular order. A factor nested deeper than the limit is not split: a product of a
/// million factors, or a power by repeated squaring, must not be expanded at every multiplication.
class Factors {
 public:
  explicit Factors(Node* product) : factors_{product} {
    for (std::size_t i = 0; i < count_ && count_ < factors_.size();) {
      Node* factor = factors_[i];
      if (is(factor, Operation::multiply)) {
        factors_[count_++] = factor->operand(1);
        factors_[i] = factor->operand(0);
      } else {
        ++i;
      }
    }
  }

  [[nodiscard]] Node** begin() { return factors_.data(); }
  [[nodiscard]] Node** end() { return factors_.data() + count_; }
  void remove(Node** factor) {
    std::move(factor + 1, end(), factor);
    --count_;
  }

 private:
  std::array<Node*, 32> factors_;
  std::size_t count_ = 1;
};

bool are_reciprocal(const Node* a, const Node* b) {
  return (is(a, Operation::reciprocal) && a->operand(0) == b) || (is(b, Operation::reciprocal) && b->operand(0) == a);
}

/// Removes from both lists the factors that cancel against their own reciprocal; true if there were any.
bool cancel(Factors& left, Factors& right) {
  bool cancelled = false;
  for (Node** factor = left.begin(); factor != left.end();) {
    Node** partner =
        std::find_if(right.begin(), right.end(), [&](Node* other) { return are_reciprocal(*factor, other); });
    if (partner == right.end()) {
      ++factor;
      continue;
    }
    right.remove(partner);
    left.remove(factor);
    cancelled = true;
  }
  return cancelled;
}

/// The product of two rests (see Scaled).
Expression product(Node* left, Node* right) {
  Factors left_factors(left);
  Factors right_factors(right);
  if (cancel(left_factors, right_factors)) {
    Expression result(1.0);
    for (Factors* factors : {&left_factors, &right_factors}) {
      for (Node* factor : *factors) result *= Expression::of_node(factor);
    }
    return result;
  }
  return created_before(right, left) ? make(Operation::multiply, right, left) : make(Operation::multiply, left, right);
}

/// left + sign · right for two rests with |sign| = 1.
Expression sum(Node* left, Node* right, double sign) {
  const bool swap = created_before(right, left);
  if (swap) std::swap(left, right);
  if (sign > 0.0) return make(Operation::add, left, right);
  // One of a - b and b - a exists in the graph; the other is its negative.
  const Expression difference = make(Operation::subtract, left, right);
  return swap ? make(Operation::negate, difference.node()) : difference;
}

enum class Symmetry : std::uint8_t { none, odd, even };

/// The function at a constant, or its node; the sign of x is moved outside where the function is odd or even.
Expression function(Operation operation, double (*value_of)(double), Symmetry symmetry, const Expression& x) {
  if (const auto value = x.constant_value()) return {value_of(*value)};
  if (symmetry == Symmetry::none || !is(x.node(), Operation::negate)) return make(operation, x.node());
  const Expression positive = make(operation, x.node()->operand(0));
  return symmetry == Symmetry::odd ? -positive : positive;
}

Expression integer_power(const Expression& x, unsigned exponent) {
  if (exponent == 0) return {1.0};
  if (exponent == 1) return x;
  const Expression half = integer_power(x, exponent / 2);
  return exponent % 2 == 0 ? half * half : half * half * x;
}

}  // namespace

Expression::Expression() : Expression(NodeTable::of_this_thread().zero(), Wrap{}) {}

Expression::Expression(double value) : Expression(make(NodeKey{.operation = Operation::constant, .value = value})) {}

Expression Expression::input(std::size_t index) { return make(NodeKey{.operation = Operation::input, .index = index}); }

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
  if (x.rest == y.rest) return join(x.factor + y.factor, x.rest);
  const bool both_vary = !a && !b;
  if (both_vary && std::abs(x.factor) == std::abs(y.factor)) {
    const double sign = x.factor == y.factor ? 1.0 : -1.0;  // not a quotient: the factors may be infinite
    return scaled(x.factor, sum(x.rest, y.rest, sign));
  }
  const Expression magnitude_x = join(std::abs(x.factor), x.rest);
  const Expression magnitude_y = join(std::abs(y.factor), y.rest);
  const bool same_sign = (x.factor < 0.0) == (y.factor < 0.0);
  const Expression result = sum(magnitude_x.node(), magnitude_y.node(), same_sign ? 1.0 : -1.0);
  return x.factor < 0.0 ? -result : result;
}

Expression operator-(const Expression& left, const Expression& right) { return left + (-right); }

Expression operator*(const Expression& left, const Expression& right) {
  const Scaled x = split(left);
  const Scaled y = split(right);
  const double factor = x.factor * y.factor;
  if (factor == 0.0) return {};
  if (x.rest == nullptr || y.rest == nullptr) return join(factor, x.rest == nullptr ? y.rest : x.rest);
  return scaled(factor, product(x.rest, y.rest));  // a cancellation may have left a factor, a sum or a constant
}

Expression operator/(const Expression& left, const Expression& right) {
  const auto divisor = right.constant_value();
  if (const auto dividend = left.constant_value(); dividend && divisor) {
    return {*dividend / *divisor};
  }
  if (divisor) return left * Expression(1.0 / *divisor);
  const Scaled y = split(right);
  const Expression inverse =
      is(y.rest, Operation::reciprocal) ? Expression::of_node(y.rest->operand(0)) : make(Operation::reciprocal, y.rest);
  return left * inverse * Expression(1.0 / y.factor);
}

Expression operator-(const Expression& operand) { return scaled(-1.0, operand); }

Expression operator+(const Expression& operand) { return operand; }

Expression sqrt(const Expression& x) { return function(Operation::square_root, std::sqrt, Symmetry::none, x); }
Expression exp(const Expression& x) { return function(Operation::exponential, std::exp, Symmetry::none, x); }
Expression log(const Expression& x) { return function(Operation::logarithm, std::log, Symmetry::none, x); }
Expression sin(const Expression& x) { return function(Operation::sine, std::sin, Symmetry::odd, x); }
Expression cos(const Expression& x) { return function(Operation::cosine, std::cos, Symmetry::even, x); }
Expression tan(const Expression& x) { return function(Operation::tangent, std::tan, Symmetry::odd, x); }
Expression asin(const Expression& x) { return function(Operation::arc_sine, std::asin, Symmetry::odd, x); }
Expression acos(const Expression& x) { return function(Operation::arc_cosine, std::acos, Symmetry::none, x); }
Expression atan(const Expression& x) { return function(Operation::arc_tangent, std::atan, Symmetry::odd, x); }
Expression sinh(const Expression& x) { return function(Operation::hyperbolic_sine, std::sinh, Symmetry::odd, x); }
Expression cosh(const Expression& x) { return function(Operation::hyperbolic_cosine, std::cosh, Symmetry::even, x); }
Expression tanh(const Expression& x) { return function(Operation::hyperbolic_tangent, std::tanh, Symmetry::odd, x); }
Expression asinh(const Expression& x) {
  return function(Operation::inverse_hyperbolic_sine, std::asinh, Symmetry::odd, x);
}
Expression erf(const Expression& x) { return function(Operation::error_function, std::erf, Symmetry::odd, x); }
Expression hypot(const Expression& x, const Expression& y) { return sqrt(x * x + y * y); }

Expression atan2(const Expression& y, const Expression& x) {
  const auto a = y.constant_value();
  const auto b = x.constant_value();
  if (a && b) return {std::atan2(*a, *b)};
  return make(Operation::arc_tangent2, y.node(), x.node());
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

Expression detail::unit_step(const Expression& x) {
  return function(Operation::unit_step, detail::unit_step<double>, Symmetry::none, x);
}

namespace detail {

std::vector<Node*> reachable_nodes(std::span<const Expression> formulas) {
  static std::atomic<std::uint64_t> traversals{0};
  const std::uint64_t traversal = ++traversals;
  std::vector<Node*> nodes;
  const auto add = [&](Node* node) {
    if (node == nullptr || node->traversal_ == traversal) return;
    node->traversal_ = traversal;
    node->set_number(nodes.size());
    nodes.push_back(node);
  };
  for (const Expression& formula : formulas) add(formula.node());
  for (std::size_t i = 0; i < nodes.size(); ++i) {  // NOLINT(modernize-loop-convert): the list grows meanwhile
    for (Node* operand : nodes[i]->key().operands) add(operand);
  }
  return nodes;
}

}  // namespace detail

}  // namespace dmocbench
