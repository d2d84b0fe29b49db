#include "methods/expression/schedule.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <unordered_map>

namespace dmocbench {

namespace {

using detail::Node;

/// Writes nodes as steps, depth first: a value is computed close to its first reader, so that few values are alive at a
/// time.
class Writer {
 public:
  Writer(std::span<const Expression> outputs, const Definitions& definitions) {
    std::vector<Expression> all(outputs.begin(), outputs.end());
    for (const ExpressionVector& part : {definitions.inputs, definitions.formulas}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    const std::vector<Node*> nodes = detail::reachable_nodes(all);
    readers_.resize(nodes.size());
    positions_.assign(nodes.size(), unwritten);
    steps_.reserve(nodes.size());
    meant_ = nodes;
    for (Eigen::Index i = 0; i < definitions.inputs.size(); ++i) {
      meant_[definitions.inputs[i].node()->number()] = definitions.formulas[i].node();
    }
    for (const Expression& output : outputs) ++readers_[meant(output.node())->number()];
    for (const Node* node : nodes) {
      for (const Node* operand : node->key().operands) {
        if (operand != nullptr) ++readers_[meant(operand)->number()];
      }
    }
  }

  /// The position of the node's step, which is written first if necessary.
  std::uint32_t position(const Node* asked) {
    const Node* output = meant(asked);
    open_.push_back(output);
    while (!open_.empty()) {
      const Node* node = open_.back();
      if (position_of(node) != unwritten) {
        open_.pop_back();
        continue;
      }
      const Form form = form_of(node);
      const std::size_t waiting = open_.size();
      for (const std::size_t which : {1U, 0U}) {
        const Node* operand = form.operands[which];
        if (operand != nullptr && position_of(operand) == unwritten) open_.push_back(operand);
      }
      if (open_.size() > waiting) continue;
      open_.pop_back();
      positions_[node->number()] = write(node, form);
    }
    return position_of(output);
  }

  [[nodiscard]] std::vector<Schedule::Step> take_steps() { return std::move(steps_); }

 private:
  static constexpr std::uint32_t unwritten = std::numeric_limits<std::uint32_t>::max();

  /// The computation of a node: by its own operation, or by a shorter one if an operand has no other reader.
  struct Form {
    Operation operation = Operation::constant;
    std::array<Node*, 2> operands{};
    double value = 0.0;
    bool has_constant_left = false;  // `value` stands for the left operand
  };

  /// The formula that an input stands for, or the node itself; null of none.
  [[nodiscard]] Node* meant(const Node* node) const { return node == nullptr ? nullptr : meant_[node->number()]; }

  [[nodiscard]] std::uint32_t position_of(const Node* node) const { return positions_[node->number()]; }

  [[nodiscard]] bool is_single(const Node* node, Operation operation) const {
    return node->operation() == operation && readers_[node->number()] == 1;
  }

  [[nodiscard]] Form form_of(const Node* node) const {
    if (node->operation() == Operation::multiply) {
      for (const std::size_t which : {0U, 1U}) {
        const Node* factor = meant(node->operand(which));
        if (!is_single(factor, Operation::reciprocal)) continue;
        return {Operation::divide, {meant(node->operand(1 - which)), meant(factor->operand(0))}, 0.0};
      }
    }
    if (node->operation() == Operation::negate) {
      const Node* x = meant(node->operand(0));
      if (is_single(x, Operation::multiply) && x->operand(0)->operation() == Operation::constant) {
        return {Operation::multiply, {nullptr, meant(x->operand(1))}, -x->operand(0)->value(), true};
      }
      if (is_single(x, Operation::subtract)) {
        return {Operation::subtract, {meant(x->operand(1)), meant(x->operand(0))}, 0.0};
      }
    }
    return {node->operation(), {meant(node->operand(0)), meant(node->operand(1))}, node->value()};
  }

  std::uint32_t write(const Node* node, const Form& form) {
    if (form.operation == Operation::constant) return constant(form.value);
    Schedule::Step step{.operation = form.operation, .value = form.value, .input_index = node->index()};
    if (form.has_constant_left) {
      step.left = constant(form.value);
    } else if (form.operands[0] != nullptr) {
      step.left = position_of(form.operands[0]);
    }
    if (form.operands[1] != nullptr) step.right = position_of(form.operands[1]);
    return append(step);
  }

  std::uint32_t constant(double value) {
    const auto key = std::bit_cast<std::uint64_t>(value);  // 0 and -0 are different constants
    const auto [entry, is_new] = constants_.try_emplace(key, static_cast<std::uint32_t>(steps_.size()));
    if (is_new) append({.operation = Operation::constant, .value = value});
    return entry->second;
  }

  std::uint32_t append(const Schedule::Step& step) {
    steps_.push_back(step);
    return static_cast<std::uint32_t>(steps_.size() - 1);
  }

  // Indexed by the numbers of the nodes: their meanings, their readers, outputs among them, and the positions of their
  // steps.
  std::vector<Node*> meant_;
  std::vector<std::size_t> readers_;
  std::vector<std::uint32_t> positions_;
  std::vector<const Node*> open_;
  std::unordered_map<std::uint64_t, std::uint32_t> constants_;
  std::vector<Schedule::Step> steps_;
};

}  // namespace

Schedule::Schedule(std::span<const Expression> outputs, const Definitions& definitions) {
  Writer writer(outputs, definitions);
  outputs_.reserve(outputs.size());
  for (const Expression& output : outputs) outputs_.push_back(writer.position(output.node()));
  steps_ = writer.take_steps();
  for (const Step& step : steps_) {
    if (step.operation == Operation::input) input_count_ = std::max(input_count_, step.input_index + 1);
  }
}

std::size_t Schedule::operation_count() const noexcept {
  return static_cast<std::size_t>(
      std::ranges::count_if(steps_, [](const Step& step) { return operand_count(step.operation) > 0; }));
}

}  // namespace dmocbench
