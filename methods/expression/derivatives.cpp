#include "methods/expression/derivatives.hpp"

#include <algorithm>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "methods/error.hpp"
#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

namespace {

using detail::Node;

/// `adjoint` · ∂(node)/∂(operand number `which`), as a graph of the node and its operands.
Expression adjoint_of_operand(const Expression& adjoint, Node* node, std::size_t which) {
  const Expression result = Expression::of_node(node);
  const Expression x = Expression::of_node(node->operand(0));
  switch (node->operation()) {
    case Operation::add:
      return adjoint;
    case Operation::subtract:
      return which == 0 ? adjoint : -adjoint;
    case Operation::multiply:
      return adjoint * Expression::of_node(node->operand(1 - which));
    case Operation::negate:
      return -adjoint;
    case Operation::reciprocal:
      return adjoint * -(result * result);
    case Operation::square_root:
      return adjoint * (0.5 / result);
    case Operation::exponential:
      return adjoint * result;
    case Operation::logarithm:
      return adjoint * (1.0 / x);
    case Operation::sine:
      return adjoint * cos(x);
    case Operation::cosine:
      return adjoint * -sin(x);
    case Operation::tangent:
      return adjoint * (1.0 + result * result);
    case Operation::arc_sine:
      return adjoint * (1.0 / sqrt(1.0 - x * x));
    case Operation::arc_cosine:
      return adjoint * (-1.0 / sqrt(1.0 - x * x));
    case Operation::arc_tangent:
      return adjoint * (1.0 / (1.0 + x * x));
    case Operation::arc_tangent2: {
      const Expression other = Expression::of_node(node->operand(1));  // atan2(x, other)
      const Expression squared_radius = x * x + other * other;
      return adjoint * (which == 0 ? other / squared_radius : -x / squared_radius);
    }
    case Operation::hyperbolic_sine:
      return adjoint * cosh(x);
    case Operation::hyperbolic_cosine:
      return adjoint * sinh(x);
    case Operation::hyperbolic_tangent:
      return adjoint * (1.0 - result * result);
    case Operation::power:
      return adjoint * (node->value() * pow(x, node->value() - 1.0));
    case Operation::inverse_hyperbolic_sine:
      return adjoint * (1.0 / sqrt(1.0 + x * x));
    case Operation::error_function:
      return adjoint * (2.0 * std::numbers::inv_sqrtpi * exp(-(x * x)));
    case Operation::unit_step:
      return {};
    case Operation::constant:
    case Operation::input:
    case Operation::divide:
      break;
  }
  throw Error("this operation has no derivative rule");
}

/// Reverse mode on the common graph of some formulas, one formula after the other.
class ReverseMode {
 public:
  /// Throws `Error` if an entry of `x` is not an input.
  ReverseMode(std::span<const Expression> formulas, const ExpressionVector& x) : x_(x) {
    std::vector<Expression> read(formulas.begin(), formulas.end());
    read.insert(read.end(), x.begin(), x.end());
    nodes_ = detail::reachable_nodes(read);
    std::ranges::sort(nodes_, {}, &Node::serial);
    for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i]->set_number(i);
    adjoints_.resize(nodes_.size());

    first_dependence_.assign(nodes_.size(), x.size());
    for (Eigen::Index j = x.size() - 1; j >= 0; --j) {
      if (x[j].node()->operation() != Operation::input) {
        throw Error("derivatives can be taken only with respect to inputs, not to formulas");
      }
      first_dependence_[x[j].node()->number()] = j;
    }
    for (const Node* node : nodes_) {
      Eigen::Index& first = first_dependence_[node->number()];
      for (std::size_t which = 0; which < operand_count(node->operation()); ++which) {
        first = std::min(first, first_dependence_[node->operand(which)->number()]);
      }
    }
  }

  /// ∂f/∂x_j of one of the formulas, j < `count`.
  ExpressionVector gradient(const Expression& f, Eigen::Index count) {
    stop_if_requested();
    const std::uint32_t last = f.node()->number();
    if (first_dependence_[last] < count) adjoints_[last] = Expression(1.0);
    for (std::size_t i = last + 1; i-- > 0;) {
      if (!adjoints_[i].is_zero() && nodes_[i]->operation() != Operation::input) pass_on(i, count);
    }
    ExpressionVector result(count);
    for (Eigen::Index j = 0; j < count; ++j) result[j] = adjoints_[x_[j].node()->number()];
    for (const Expression& input : x_) adjoints_[input.node()->number()] = zero_;
    return result;
  }

 private:
  /// Adds the share of node i to the adjoints of its operands.
  void pass_on(std::size_t i, Eigen::Index count) {
    const Expression adjoint = std::exchange(adjoints_[i], zero_);
    for (std::size_t which = 0; which < operand_count(nodes_[i]->operation()); ++which) {
      const std::uint32_t operand = nodes_[i]->operand(which)->number();
      if (first_dependence_[operand] < count) adjoints_[operand] += adjoint_of_operand(adjoint, nodes_[i], which);
    }
  }

  const ExpressionVector& x_;
  Expression zero_;
  std::vector<Node*> nodes_;                    // operands before their readers
  std::vector<Eigen::Index> first_dependence_;  // the first entry of x on which a node depends
  std::vector<Expression> adjoints_;            // of the nodes; 0 between two gradients
};

}  // namespace

ExpressionVector gradient(const Expression& f, const ExpressionVector& x) {
  return ReverseMode(std::span(&f, 1), x).gradient(f, x.size());
}

ExpressionMatrix jacobian(const ExpressionVector& f, const ExpressionVector& x) {
  ReverseMode reverse_mode(entries_of(f), x);
  ExpressionMatrix result(f.size(), x.size());
  for (Eigen::Index i = 0; i < f.size(); ++i) result.row(i) = reverse_mode.gradient(f[i], x.size()).transpose();
  return result;
}

ExpressionMatrix symmetric_jacobian(const ExpressionVector& f, const ExpressionVector& x) {
  ReverseMode reverse_mode(entries_of(f), x);
  ExpressionMatrix result(x.size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const ExpressionVector row = reverse_mode.gradient(f[i], i + 1);
    for (Eigen::Index j = 0; j <= i; ++j) result(i, j) = result(j, i) = row[j];
  }
  return result;
}

}  // namespace dmocbench
