#include "methods/expression/affine_arguments.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/expression/schedule.hpp"

namespace dmocbench {

namespace {

using detail::Node;

/// The dependence of a node on x.
enum class Dependence : std::uint8_t { none, affine, nonlinear };

/// Operands before the nodes that read them; `number` is the place.
std::vector<Node*> operands_first(std::span<const Expression> formulas) {
  std::vector<Node*> nodes = detail::reachable_nodes(formulas);
  std::ranges::sort(nodes, {}, &Node::serial);
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i]->set_number(i);
  return nodes;
}

std::span<Node* const> operands_of(const Node* node) {
  return {node->key().operands.data(), operand_count(node->operation())};
}

/// A node whose operands depend on x like this.
Dependence dependence_of(Operation operation, Dependence left, Dependence right) {
  const Dependence most = std::max(left, right);
  if (most == Dependence::none) return most;
  switch (operation) {
    case Operation::add:
    case Operation::subtract:
    case Operation::negate:
      return most;
    case Operation::multiply:
      return std::min(left, right) == Dependence::none ? most : Dependence::nonlinear;
    default:
      return Dependence::nonlinear;
  }
}

/// The dependence of every node, by their numbers.
std::vector<Dependence> dependences(std::span<Node* const> nodes, const ExpressionVector& x) {
  std::vector<Dependence> result(nodes.size(), Dependence::none);
  for (const Expression& input : x) {
    const std::uint32_t number = input.node()->number();
    if (number < nodes.size() && nodes[number] == input.node()) result[number] = Dependence::affine;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto operands = operands_of(nodes[i]);
    if (operands.empty()) continue;
    const Dependence left = result[operands.front()->number()];
    result[i] = dependence_of(nodes[i]->operation(), left,
                              operands.size() > 1 ? result[operands.back()->number()] : Dependence::none);
  }
  return result;
}

/// x without its sign and numeric factor.
Node* without_factor(Node* x) {
  for (;;) {
    if (x->operation() == Operation::negate) {
      x = x->operand(0);
    } else if (x->operation() == Operation::multiply && x->operand(0)->operation() == Operation::constant) {
      x = x->operand(1);
    } else {
      return x;
    }
  }
}

/// `nodes` are the formulas' nodes, operands first.
std::vector<Expression> find_arguments(std::span<const Expression> formulas, std::span<Node* const> nodes,
                                       const ExpressionVector& x) {
  const std::vector<Dependence> dependence = dependences(nodes, x);
  std::vector<bool> is_argument(nodes.size());
  const auto add = [&](Node* node) {
    if (dependence[node->number()] == Dependence::affine) is_argument[without_factor(node)->number()] = true;
  };
  for (const Expression& formula : formulas) add(formula.node());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (dependence[i] != Dependence::nonlinear) continue;
    for (Node* operand : operands_of(nodes[i])) add(operand);
  }
  std::vector<Expression> arguments;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (is_argument[i]) arguments.push_back(Expression::of_node(nodes[i]));
  }
  return arguments;
}

/// The number of an input that is not among the nodes and x, nor any after it.
std::size_t first_unused_input(std::span<Node* const> nodes, const ExpressionVector& x) {
  std::size_t unused = 0;
  const auto pass = [&](const Node* node) {
    if (node->operation() == Operation::input) unused = std::max(unused, node->index() + 1);
  };
  for (const Expression& input : x) pass(input.node());
  for (const Node* node : nodes) pass(node);
  return unused;
}

/// The formulas, whose nodes these are, operands first, with `replacements` in place of `originals`.
std::vector<Expression> replaced_among(std::span<Node* const> nodes, std::span<const Expression> formulas,
                                       const ExpressionVector& originals, const ExpressionVector& replacements) {
  std::unordered_map<const Node*, Expression> replacement_of;
  for (Eigen::Index i = 0; i < originals.size(); ++i) replacement_of.emplace(originals[i].node(), replacements[i]);
  std::vector<Expression> values;
  values.reserve(nodes.size());
  for (Node* node : nodes) {
    const auto operands = operands_of(node);
    const bool has_changed =
        std::ranges::any_of(operands, [&](Node* operand) { return values[operand->number()].node() != operand; });
    if (const auto found = replacement_of.find(node); found != replacement_of.end()) {
      values.push_back(found->second);
    } else if (has_changed) {
      values.push_back(detail::replay_operation({.operation = node->operation(),
                                                 .left = operands.front()->number(),
                                                 .right = operands.back()->number(),
                                                 .value = node->value()},
                                                values));
    } else {
      values.push_back(Expression::of_node(node));
    }
  }
  std::vector<Expression> result;
  result.reserve(formulas.size());
  for (const Expression& formula : formulas) result.push_back(values[formula.node()->number()]);
  return result;
}

}  // namespace

std::vector<Expression> replaced(std::span<const Expression> formulas, const ExpressionVector& nodes,
                                 const ExpressionVector& replacements) {
  return replaced_among(operands_first(formulas), formulas, nodes, replacements);
}

AffineArguments::AffineArguments(std::span<const Expression> formulas, const ExpressionVector& x) {
  const std::vector<Node*> nodes = operands_first(formulas);
  std::vector<Expression> arguments = find_arguments(formulas, nodes, x);
  if (arguments.size() > most_per_entry * static_cast<std::size_t>(x.size())) arguments.assign(x.begin(), x.end());
  definitions_.formulas = Eigen::Map<ExpressionVector>(arguments.data(), static_cast<Eigen::Index>(arguments.size()));
  definitions_.inputs = input_vector(first_unused_input(nodes, x), definitions_.formulas.size());
  formulas_ = replaced_among(nodes, formulas, definitions_.formulas, definitions_.inputs);
  coefficients_ = jacobian(definitions_.formulas, x);
}

}  // namespace dmocbench
