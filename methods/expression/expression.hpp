#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "methods/expression/node.hpp"

namespace dmocbench {

/// Advice that compilers print with the deleted functions whose types these are.
namespace instead {
struct write_smooth_abs;
struct write_smooth_max;
struct write_smooth_min;
struct write_smooth_sign;
struct write_smooth_if_else;
struct write_smooth_if_else_max_or_min;
struct write_exp_of_y_times_log_x;
}  // namespace instead

/// A traced real number: a value type that records its computation instead of its value.
///
/// Arithmetic on expressions builds a graph. Equal nodes are shared (an operation on the same operands is the same
/// node), and values known while tracing are folded: constants, x + 0, 1 · x, 0 · x = 0, x - x = 0, numeric factors,
/// signs, and a factor times its own reciprocal. A structural zero therefore costs nothing, and NaN propagates from
/// those inputs that the folded graph still reads.
///
/// A graph belongs to the thread that traces it. Two threads may trace at the same time; mixing expressions of two
/// threads throws `Error`. A node is freed when the last expression that reads it is gone.
///
/// Expressions cannot be compared: a traced formula that branches on a value would be traced on one side only.
/// Functions with a kink or a jump do not compile for the same reason; the compiler's message names the smooth one
/// (`smooth.hpp`).
class Expression {  // NOLINT(cppcoreguidelines-special-member-functions): one assignment copies or moves
 public:
  /// The constant 0.
  Expression();
  /// The constant `value`.
  Expression(double value);  // NOLINT(google-explicit-constructor,hicpp-explicit-conversions): 2.0 * x must read so
  /// Refers to the same node; no node is copied.
  Expression(const Expression& other) noexcept : node_(other.node_) {
    if (node_ != nullptr) node_->gain_reader();
  }
  /// Takes the other's node; the other may then only be assigned to or destroyed.
  Expression(Expression&& other) noexcept : node_(std::exchange(other.node_, nullptr)) {}
  /// Stands for the other's number from now on.
  Expression& operator=(Expression other) noexcept {
    std::swap(node_, other.node_);
    return *this;
  }
  ~Expression() {
    if (node_ != nullptr) node_->lose_reader();
  }

  /// The independent variable number `index`: the same number is the same variable in every formula of a thread.
  [[nodiscard]] static Expression input(std::size_t index);

  /// The value if this is a constant.
  [[nodiscard]] std::optional<double> constant_value() const noexcept {
    if (node_->operation() != Operation::constant) return std::nullopt;
    return node_->value();
  }
  /// True if this is the constant 0: a structural zero.
  [[nodiscard]] bool is_zero() const noexcept {
    return node_->operation() == Operation::constant && node_->value() == 0.0;
  }
  /// True if both are the same node, hence the same formula.
  [[nodiscard]] bool is_same(const Expression& other) const noexcept { return node_ == other.node_; }

  /// Stands for the sum from now on.
  Expression& operator+=(const Expression& right);
  /// Stands for the difference from now on.
  Expression& operator-=(const Expression& right);
  /// Stands for the product from now on.
  Expression& operator*=(const Expression& right);
  /// Stands for the quotient from now on.
  Expression& operator/=(const Expression& right);

  // Compilers print the type and the line of a deleted function: the type says what to write instead.
  friend instead::write_smooth_abs abs(const Expression& x) = delete;
  friend instead::write_smooth_abs fabs(const Expression& x) = delete;
  friend instead::write_smooth_max max(const Expression& x, const Expression& y) = delete;
  friend instead::write_smooth_max fmax(const Expression& x, const Expression& y) = delete;
  friend instead::write_smooth_min min(const Expression& x, const Expression& y) = delete;
  friend instead::write_smooth_min fmin(const Expression& x, const Expression& y) = delete;
  friend instead::write_smooth_sign sign(const Expression& x) = delete;
  template <class C>
  friend instead::write_smooth_if_else if_else(C, const Expression&, const Expression&) = delete;
  friend instead::write_exp_of_y_times_log_x pow(const Expression& x, const Expression& y) = delete;
  explicit operator bool() const = delete;  // a formula cannot branch on a value: write smooth_if_else(x, a, b, eps)

  /// The graph's node; for the algorithms of this folder.
  [[nodiscard]] detail::Node* node() const noexcept { return node_; }
  /// The expression that a node stands for; for the algorithms of this folder.
  [[nodiscard]] static Expression of_node(detail::Node* node) noexcept { return {node, Wrap{}}; }

 private:
  struct Wrap {};
  Expression(detail::Node* node, Wrap /*tag*/) noexcept : node_(node) { node_->gain_reader(); }
  detail::Node* node_;
};

/// The sum.
[[nodiscard]] Expression operator+(const Expression& left, const Expression& right);
/// The difference.
[[nodiscard]] Expression operator-(const Expression& left, const Expression& right);
/// The product.
[[nodiscard]] Expression operator*(const Expression& left, const Expression& right);
/// The quotient.
[[nodiscard]] Expression operator/(const Expression& left, const Expression& right);
/// The negative.
[[nodiscard]] Expression operator-(const Expression& operand);
/// The operand itself.
[[nodiscard]] Expression operator+(const Expression& operand);

/// √x.
[[nodiscard]] Expression sqrt(const Expression& x);
[[nodiscard]] Expression exp(const Expression& x);  ///< e^x.
/// The natural logarithm.
[[nodiscard]] Expression log(const Expression& x);
/// The sine of x radians.
[[nodiscard]] Expression sin(const Expression& x);
/// The cosine of x radians.
[[nodiscard]] Expression cos(const Expression& x);
/// The tangent of x radians.
[[nodiscard]] Expression tan(const Expression& x);
/// The inverse sine, in radians.
[[nodiscard]] Expression asin(const Expression& x);
/// The inverse cosine, in radians.
[[nodiscard]] Expression acos(const Expression& x);
/// The inverse tangent, in radians.
[[nodiscard]] Expression atan(const Expression& x);
/// The angle of the point (x, y), as std::atan2.
[[nodiscard]] Expression atan2(const Expression& y, const Expression& x);
/// The hyperbolic sine.
[[nodiscard]] Expression sinh(const Expression& x);
/// The hyperbolic cosine.
[[nodiscard]] Expression cosh(const Expression& x);
/// The hyperbolic tangent.
[[nodiscard]] Expression tanh(const Expression& x);
/// log(x + √(x² + 1)), without cancellation.
[[nodiscard]] Expression asinh(const Expression& x);
/// 2/√π ∫₀ˣ exp(-t²) dt.
[[nodiscard]] Expression erf(const Expression& x);
/// √(x² + y²) by just that formula: not for numbers whose squares overflow, and not differentiable at 0.
[[nodiscard]] Expression hypot(const Expression& x, const Expression& y);
/// x to a constant exponent. Integers up to 16 in magnitude are products, ±1/2 is a square root.
[[nodiscard]] Expression pow(const Expression& x, double exponent);

// A traced formula cannot branch on a value: comparisons do not compile. smooth_if_else, smooth_max and smooth_min do
// not need them.
instead::write_smooth_if_else_max_or_min operator==(const Expression&, const Expression&) = delete;
instead::write_smooth_if_else_max_or_min operator!=(const Expression&, const Expression&) = delete;
instead::write_smooth_if_else_max_or_min operator<(const Expression&, const Expression&) = delete;
instead::write_smooth_if_else_max_or_min operator<=(const Expression&, const Expression&) = delete;
instead::write_smooth_if_else_max_or_min operator>(const Expression&, const Expression&) = delete;
instead::write_smooth_if_else_max_or_min operator>=(const Expression&, const Expression&) = delete;

namespace detail {
/// `Operation::unit_step`: a product with it is a formula that holds on one side of x = 0 only. Its derivative is 0, so
/// that derivatives of sums of such products are right where those formulas join smoothly.
[[nodiscard]] Expression unit_step(const Expression& x);
}  // namespace detail

/// Number of nodes alive on this thread, inputs and constants (apart from 0) among them.
[[nodiscard]] std::size_t live_nodes() noexcept;

namespace detail {

/// The nodes that the formulas need, each once; `number` is its place in the result until the next call.
[[nodiscard]] std::vector<Node*> reachable_nodes(std::span<const Expression> formulas);

}  // namespace detail

}  // namespace dmocbench
