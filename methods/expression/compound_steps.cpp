#include "methods/expression/compound_steps.hpp"

#include <unordered_map>

namespace dmocbench {

namespace {

/// The combination that an operation is; nothing for other operations.
std::optional<Combination> combination_of(Operation operation) {
  switch (operation) {
    case Operation::add:
      return Combination::add;
    case Operation::subtract:
      return Combination::subtract;
    case Operation::multiply:
      return Combination::multiply;
    default:
      return std::nullopt;
  }
}

/// The same combination with its operands swapped.
Combination swapped(Combination combination) {
  return combination == Combination::subtract ? Combination::subtract_from : combination;
}

/// The number of readers of each step; outputs count as readers.
std::vector<std::size_t> count_readers(const Schedule& schedule) {
  std::vector<std::size_t> readers(schedule.steps().size());
  for (const Schedule::Step& step : schedule.steps()) {
    const std::size_t operands = operand_count(step.operation);
    if (operands > 0) ++readers[step.left];
    if (operands > 1) ++readers[step.right];
  }
  for (const std::uint32_t output : schedule.outputs()) ++readers[output];
  return readers;
}

/// Combinations carried out one after the other, starting with the first two operands; or a tree.
struct Draft {
  std::array<Combination, most_operands - 1> combinations{};
  std::array<std::uint32_t, most_operands> operands{};
  std::size_t operand_count = 0;  // the number of combinations plus one; 0 for other steps
  bool is_tree = false;

  void append(Combination combination, std::uint32_t operand) {
    combinations[operand_count - 1] = combination;
    operands[operand_count++] = operand;
  }

  [[nodiscard]] std::size_t code() const {
    const auto& c = combinations;
    if (is_tree) return instruction_code::tree(c[0], c[1], c[2]);
    return operand_count == 3 ? instruction_code::pair(c[0], c[1]) : instruction_code::chain(c[0], c[1], c[2]);
  }
};

class Compounder {
 public:
  explicit Compounder(const Schedule& schedule)
      : steps_(schedule.steps()), readers_(count_readers(schedule)), drafts_(steps_.size()), absorbed_(steps_.size()) {
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      if (const auto combination = combination_of(steps_[i].operation)) drafts_[i] = draft(steps_[i], *combination);
      if (steps_[i].operation == Operation::sine) sine_of_[steps_[i].left] = i;
      if (steps_[i].operation == Operation::cosine) cosine_of_[steps_[i].left] = i;
    }
  }

  std::vector<CompoundStep> compounds() {
    std::vector<CompoundStep> result;
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      if (operand_count(steps_[i].operation) > 0 && !absorbed_[i]) result.push_back(compound(i));
    }
    return result;
  }

 private:
  /// The step combined with those operands that have no other reader, if the kernel has an instruction for it.
  Draft draft(const Schedule::Step& step, Combination combination) {
    const std::size_t left = absorbable_size(step.left);
    const std::size_t right = absorbable_size(step.right);
    if (left == 2 && right == 2) return tree(drafts_[take(step.left)], drafts_[take(step.right)], combination);
    if (left == 0 && right == 0) return {{combination}, {step.left, step.right}, 2};
    const bool extends_left = left >= right;
    Draft result = drafts_[take(extends_left ? step.left : step.right)];
    result.append(extends_left ? combination : swapped(combination), extends_left ? step.right : step.left);
    return result;
  }

  static Draft tree(const Draft& left, const Draft& right, Combination combination) {
    return {{left.combinations[0], right.combinations[0], combination},
            {left.operands[0], left.operands[1], right.operands[0], right.operands[1]},
            most_operands,
            true};
  }

  /// The number of operands of a step that its only reader may absorb; 0 for other steps.
  [[nodiscard]] std::size_t absorbable_size(std::uint32_t step) const {
    const std::size_t size = drafts_[step].operand_count;
    return readers_[step] == 1 && size < most_operands ? size : 0;
  }

  std::uint32_t take(std::uint32_t step) {
    absorbed_[step] = true;
    return step;
  }

  CompoundStep compound(std::uint32_t i) {
    const Schedule::Step& step = steps_[i];
    const Draft& draft = drafts_[i];
    if (draft.operand_count > 2) return {draft.code(), i, std::nullopt, draft.operands, draft.operand_count};
    if (step.operation == Operation::sine && cosine_of_.contains(step.left)) {
      return {instruction_code::sine_and_cosine, i, take(cosine_of_[step.left]), {step.left}, 1};
    }
    if (step.operation == Operation::cosine && sine_of_.contains(step.left)) {
      return {instruction_code::sine_and_cosine, take(sine_of_[step.left]), i, {step.left}, 1};
    }
    return {
        instruction_code::of(step.operation), i, std::nullopt, {step.left, step.right}, operand_count(step.operation)};
  }

  const std::vector<Schedule::Step>& steps_;
  std::vector<std::size_t> readers_;
  std::vector<Draft> drafts_;
  std::vector<bool> absorbed_;
  std::unordered_map<std::uint32_t, std::uint32_t> sine_of_;  // by the step of its argument
  std::unordered_map<std::uint32_t, std::uint32_t> cosine_of_;
};

}  // namespace

std::vector<CompoundStep> compound_steps(const Schedule& schedule) { return Compounder(schedule).compounds(); }

}  // namespace dmocbench
