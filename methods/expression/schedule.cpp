#include "methods/expression/schedule.hpp"

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "methods/expression/node.hpp"

namespace dmocbench {

namespace {

using detail::Node;

/// The number of readers of each reachable node; outputs count as readers.
std::unordered_map<Node*, std::size_t> count_readers(std::span<const Expression> outputs) {
  std::unordered_map<Node*, std::size_t> readers;
  std::vector<Node*> open;
  const auto read = [&](Node* node) {
    if (readers[node]++ == 0) open.push_back(node);
  };
  for (const Expression& output : outputs) read(output.node());
  while (!open.empty()) {
    Node* node = open.back();
    open.pop_back();
    for (Node* operand : node->key().operands) {
      if (operand != nullptr) read(operand);
    }
  }
  return readers;
}

/// Writes nodes as steps, depth first: a value is computed close to its first reader, so that few values are alive at a
/// time.
class Writer {
 public:
  explicit Writer(std::span<const Expression> outputs) : readers_(count_readers(outputs)) {}

  /// The position of the node's step, which is written first if necessary.
  std::uint32_t position(Node* output) {
    std::vector<Node*> open{output};
    while (!open.empty()) {
      Node* node = open.back();
      if (positions_.contains(node)) {
        open.pop_back();
        continue;
      }
      const Form form = form_of(node);
      const std::size_t waiting = open.size();
      for (const std::size_t which : {1U, 0U}) {
        Node* operand = form.operands[which];
        if (operand != nullptr && !positions_.contains(operand)) open.push_back(operand);
      }
      if (open.size() > waiting) continue;
      open.pop_back();
      write(node, form);
    }
    return positions_.at(output);
  }

  [[nodiscard]] std::vector<Schedule::Step> take_steps() { return std::move(steps_); }

 private:
  /// How a node is computed: by its own operation, or by a shorter one if an operand has no other reader.
  struct Form {
    Operation operation;
    std::array<Node*, 2> operands;
    double value;
    bool has_constant_left = false;  // `value` stands for the left operand
  };

  [[nodiscard]] bool is_single(Node* node, Operation operation) const {
    return node != nullptr && node->operation() == operation && readers_.at(node) == 1;
  }

  [[nodiscard]] Form form_of(Node* node) const {
    Form form{node->operation(), node->key().operands, node->value()};
    if (node->operation() == Operation::multiply) {
      for (const std::size_t which : {0U, 1U}) {
        Node* factor = node->operand(which);
        if (!is_single(factor, Operation::reciprocal)) continue;
        return {Operation::divide, {node->operand(1 - which), factor->operand(0)}, 0.0};
      }
    }
    if (node->operation() == Operation::negate && is_single(node->operand(0), Operation::multiply) &&
        node->operand(0)->operand(0)->operation() == Operation::constant) {
      const Node* product = node->operand(0);
      return {Operation::multiply, {nullptr, product->operand(1)}, -product->operand(0)->value(), true};
    }
    if (node->operation() == Operation::negate && is_single(node->operand(0), Operation::subtract)) {
      const Node* difference = node->operand(0);
      return {Operation::subtract, {difference->operand(1), difference->operand(0)}, 0.0};
    }
    return form;
  }

  void write(Node* node, const Form& form) {
    if (form.operation == Operation::constant) {
      positions_[node] = constant(form.value);
      return;
    }
    Schedule::Step step{.operation = form.operation, .value = form.value, .input_index = node->index()};
    if (form.has_constant_left) {
      step.left = constant(form.value);
    } else if (form.operands[0] != nullptr) {
      step.left = positions_.at(form.operands[0]);
    }
    if (form.operands[1] != nullptr) step.right = positions_.at(form.operands[1]);
    positions_[node] = append(step);
  }

  std::uint32_t constant(double value) {
    const auto key = std::bit_cast<std::uint64_t>(value);  // 0 and -0 are different constants
    if (const auto found = constants_.find(key); found != constants_.end()) return found->second;
    return constants_[key] = append({.operation = Operation::constant, .value = value});
  }

  std::uint32_t append(const Schedule::Step& step) {
    steps_.push_back(step);
    return static_cast<std::uint32_t>(steps_.size() - 1);
  }

  std::unordered_map<Node*, std::size_t> readers_;
  std::unordered_map<Node*, std::uint32_t> positions_;
  std::unordered_map<std::uint64_t, std::uint32_t> constants_;
  std::vector<Schedule::Step> steps_;
};

}  // namespace

Schedule::Schedule(std::span<const Expression> outputs) {
  Writer writer(outputs);
  for (const Expression& output : outputs) outputs_.push_back(writer.position(output.node()));
  steps_ = writer.take_steps();
  for (const Step& step : steps_) {
    if (step.operation == Operation::input) {
      input_count_ = std::max(input_count_, step.input_index + 1);
    }
  }
}

Schedule::Schedule(const ExpressionVector& outputs)
    : Schedule(std::span<const Expression>(outputs.data(), static_cast<std::size_t>(outputs.size()))) {}

std::size_t Schedule::operation_count() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(steps_.begin(), steps_.end(), [](const Step& step) { return operand_count(step.operation) > 0; }));
}

}  // namespace dmocbench
