#include "methods/expression/derivatives.hpp"

#include <algorithm>
#include <ranges>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "methods/error.hpp"
#include "methods/expression/node.hpp"

namespace dmocbench {

namespace {

using detail::Node;

/// The nodes of `f` that depend on one of the inputs `x`, operands before their readers.
std::vector<Node*> active_nodes(const Expression& f, const std::unordered_set<Node*>& x) {
  std::vector<Node*> reachable;
  std::unordered_set<Node*> seen;
  std::vector<Node*> open{f.node()};
  while (!open.empty()) {
    Node* node = open.back();
    open.pop_back();
    if (!seen.insert(node).second) continue;
    reachable.push_back(node);
    for (Node* operand : node->key().operands) {
      if (operand != nullptr) open.push_back(operand);
    }
  }
  std::sort(reachable.begin(), reachable.end(), [](const Node* a, const Node* b) { return a->serial() < b->serial(); });
  std::vector<Node*> active;
  std::unordered_set<Node*> is_active;
  for (Node* node : reachable) {
    const auto depends = [&](Node* operand) { return operand != nullptr && is_active.contains(operand); };
    if (x.contains(node) || depends(node->operand(0)) || depends(node->operand(1))) {
      is_active.insert(node);
      active.push_back(node);
    }
  }
  return active;
}

/// ∂(node)/∂(operand number `which`), as a graph of the node and its operands.
Expression partial_derivative(Node* node, std::size_t which) {
  Expression result = Expression::of_node(node);
  const Expression x = Expression::of_node(node->operand(0));
  switch (node->operation()) {
    case Operation::add:
      return 1.0;
    case Operation::subtract:
      return which == 0 ? 1.0 : -1.0;
    case Operation::multiply:
      return Expression::of_node(node->operand(1 - which));
    case Operation::negate:
      return -1.0;
    case Operation::reciprocal:
      return -(result * result);
    case Operation::square_root:
      return 0.5 / result;
    case Operation::exponential:
      return result;
    case Operation::logarithm:
      return 1.0 / x;
    case Operation::sine:
      return cos(x);
    case Operation::cosine:
      return -sin(x);
    case Operation::tangent:
      return 1.0 + result * result;
    case Operation::arc_sine:
      return 1.0 / sqrt(1.0 - x * x);
    case Operation::arc_cosine:
      return -1.0 / sqrt(1.0 - x * x);
    case Operation::arc_tangent:
      return 1.0 / (1.0 + x * x);
    case Operation::arc_tangent2: {
      const Expression other = Expression::of_node(node->operand(1));  // atan2(x, other)
      const Expression squared_radius = x * x + other * other;
      return which == 0 ? other / squared_radius : -x / squared_radius;
    }
    case Operation::hyperbolic_sine:
      return cosh(x);
    case Operation::hyperbolic_cosine:
      return sinh(x);
    case Operation::hyperbolic_tangent:
      return 1.0 - result * result;
    case Operation::power:
      return node->value() * pow(x, node->value() - 1.0);
    case Operation::constant:
    case Operation::input:
    case Operation::divide:
      break;
  }
  throw Error("no derivative rule for this operation");
}

}  // namespace

ExpressionVector gradient(const Expression& f, const ExpressionVector& x) {
  std::unordered_set<Node*> inputs;
  for (const Expression& variable : x) {
    if (variable.node()->operation() != Operation::input) {
      throw Error("derivatives are taken with respect to inputs, not to formulas");
    }
    inputs.insert(variable.node());
  }
  const std::vector<Node*> nodes = active_nodes(f, inputs);
  const std::unordered_set<Node*> active(nodes.begin(), nodes.end());

  std::unordered_map<Node*, Expression> adjoints;
  adjoints.emplace(f.node(), Expression(1.0));
  for (Node* node : std::ranges::reverse_view(nodes)) {
    const auto found = adjoints.find(node);
    if (found == adjoints.end()) continue;
    const Expression adjoint = found->second;
    for (std::size_t which = 0; which < operand_count(node->operation()); ++which) {
      Node* operand = node->operand(which);
      if (active.contains(operand)) adjoints[operand] += adjoint * partial_derivative(node, which);
    }
  }
  ExpressionVector result(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (const auto found = adjoints.find(x[i].node()); found != adjoints.end() && active.contains(x[i].node())) {
      result[i] = found->second;
    }
  }
  return result;
}

ExpressionMatrix jacobian(const ExpressionVector& f, const ExpressionVector& x) {
  ExpressionMatrix result(f.size(), x.size());
  for (Eigen::Index i = 0; i < f.size(); ++i) result.row(i) = gradient(f[i], x).transpose();
  return result;
}

ExpressionMatrix hessian(const Expression& f, const ExpressionVector& x) {
  const ExpressionVector first = gradient(f, x);
  ExpressionMatrix result(x.size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const ExpressionVector row = gradient(first[i], x.head(i + 1));
    for (Eigen::Index j = 0; j <= i; ++j) result(i, j) = result(j, i) = row[j];
  }
  return result;
}

}  // namespace dmocbench
