#include "methods/expression/native/native_plan.hpp"

#include <algorithm>
#include <limits>

#include "methods/expression/compound_steps.hpp"

namespace dmocbench {

namespace {

/// Whether machine code carries it out; all other operations on values are functions.
bool is_arithmetic(Operation operation) {
  switch (operation) {
    case Operation::add:
    case Operation::subtract:
    case Operation::multiply:
    case Operation::divide:
    case Operation::negate:
    case Operation::reciprocal:
    case Operation::square_root:
      return true;
    default:
      return false;
  }
}

class Planner {
 public:
  Planner(const Schedule& schedule, const TapeSeries& table)
      : schedule_(schedule),
        steps_(schedule.steps()),
        table_(table),
        stage_of_(steps_.size(), unplanned),
        outputs_of_(steps_.size()) {
    for (const CompoundStep& compound : compound_steps(schedule)) {
      if (is_function(compound.step)) functions_.push_back(compound);
    }
    for (std::uint32_t j = 0; j < schedule.outputs().size(); ++j) {
      outputs_of_[schedule.outputs()[j]].push_back(table.first_output + j);
    }
    plan_.homes.resize(steps_.size() + extra_values);
    plan_.homes[minus_zero()].constant = -0.0;
    plan_.homes[one()].constant = 1.0;
  }

  NativePlan plan() {
    find_stages();
    find_homes();
    write_arithmetic();
    for (const CompoundStep& function : functions_) write_function(function);
    copy_remaining_outputs();
    return std::move(plan_);
  }

 private:
  static constexpr std::uint32_t unplanned = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t extra_values = 2;

  // Constants that machine code needs in addition to the formulas' constants.
  [[nodiscard]] std::uint32_t minus_zero() const { return static_cast<std::uint32_t>(steps_.size()); }
  [[nodiscard]] std::uint32_t one() const { return minus_zero() + 1; }

  [[nodiscard]] bool is_computed(std::uint32_t step) const { return operand_count(steps_[step].operation) > 0; }
  [[nodiscard]] bool is_function(std::uint32_t step) const {
    return is_computed(step) && !is_arithmetic(steps_[step].operation);
  }

  template <class Visit>
  void visit_operands(const Schedule::Step& step, const Visit& visit) const {
    if (operand_count(step.operation) > 0) visit(step.left);
    if (operand_count(step.operation) > 1) visit(step.right);
  }

  /// Functions follow the arithmetic of stage k if at most k functions come one after the other on the way to them;
  /// arithmetic belongs to the first stage that needs it.
  void find_stages() {
    std::vector<std::uint32_t> depth(steps_.size());  // functions on the longest way to a value, its own among them
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      visit_operands(steps_[i], [&](std::uint32_t operand) { depth[i] = std::max(depth[i], depth[operand]); });
      if (!is_function(i)) continue;
      stage_of_[i] = depth[i]++;
    }
    const std::uint32_t last = depth.empty() ? 0 : *std::ranges::max_element(depth);
    plan_.stages.resize(last + 1);
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      if (is_function(i)) need_operands(i, stage_of_[i]);
    }
    for (const std::uint32_t output : schedule_.outputs()) need(output, last);
    // Readers come after their operands.
    for (std::size_t i = steps_.size(); i-- > 0;) {
      const auto step = static_cast<std::uint32_t>(i);
      if (is_computed(step) && !is_function(step)) need_operands(step, stage_of_[i]);
    }
  }
  void need_operands(std::uint32_t step, std::uint32_t stage) {
    visit_operands(steps_[step], [&](std::uint32_t operand) { need(operand, stage); });
  }
  void need(std::uint32_t value, std::uint32_t stage) {
    if (is_computed(value) && !is_function(value)) stage_of_[value] = std::min(stage_of_[value], stage);
  }

  /// Series of constants' copies, inputs, outputs, functions, and of values that pass from a stage to functions or to
  /// later stages.
  void find_homes() {
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      if (steps_[i].operation == Operation::constant) plan_.homes[i].constant = steps_[i].value;
      if (!is_computed(i)) plan_.homes[i].series = table_.of_steps[i];
      if (!outputs_of_[i].empty() && is_computed(i)) plan_.homes[i].series = outputs_of_[i].front();
    }
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      if (is_function(i)) keep(i);
      visit_operands(steps_[i], [&](std::uint32_t operand) {
        if (is_function(i) || stage_of_[operand] < stage_of_[i]) keep(operand);
      });
    }
  }
  void keep(std::uint32_t value) {
    if (plan_.homes[value].series) return;
    plan_.homes[value].series = table_.first_slot + static_cast<std::uint32_t>(plan_.slots++);
  }

  void write_arithmetic() {
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      if (!is_computed(i) || is_function(i)) continue;
      std::vector<VectorStep>& arithmetic = plan_.stages[stage_of_[i]].arithmetic;
      arithmetic.push_back(vector_step(i));
      const std::optional<std::uint32_t>& home = plan_.homes[i].series;
      if (outputs_of_[i].empty() && home) arithmetic.push_back(copy(i, *home));
      for (const std::uint32_t output : outputs_of_[i]) arithmetic.push_back(copy(i, output));
    }
  }

  [[nodiscard]] static VectorStep copy(std::uint32_t value, std::uint32_t series) {
    return {VectorOperation::copy, series, value, value};
  }

  [[nodiscard]] VectorStep vector_step(std::uint32_t i) const {
    const Schedule::Step& step = steps_[i];
    switch (step.operation) {
      case Operation::add:
        return {VectorOperation::add, i, step.left, step.right};
      case Operation::subtract:
        return {VectorOperation::subtract, i, step.left, step.right};
      case Operation::multiply:
        return {VectorOperation::multiply, i, step.left, step.right};
      case Operation::divide:
        return {VectorOperation::divide, i, step.left, step.right};
      case Operation::negate:
        return {VectorOperation::exclusive_or, i, step.left, minus_zero()};
      case Operation::reciprocal:
        return {VectorOperation::divide, i, one(), step.left};
      default:
        return {VectorOperation::square_root, i, step.left, step.left};
    }
  }

  void write_function(const CompoundStep& function) {
    const auto series = [&](std::uint32_t value) { return *plan_.homes[value].series; };
    TapeInstruction instruction{.code = static_cast<std::uint32_t>(function.code),
                                .result = series(function.step),
                                .second_result = series(function.cosine.value_or(function.step)),
                                .operands = {},
                                .exponent = steps_[function.step].value};
    std::transform(function.operands.begin(), function.operands.begin() + function.operand_count,
                   instruction.operands.begin(), series);
    plan_.stages[stage_of_[function.step]].functions.push_back(instruction);
  }

  /// Outputs that are constants or inputs, or results of functions a second time.
  void copy_remaining_outputs() {
    for (std::uint32_t j = 0; j < schedule_.outputs().size(); ++j) {
      const std::uint32_t value = schedule_.outputs()[j];
      const std::uint32_t output = table_.first_output + j;
      if (is_computed(value) && !is_function(value)) continue;
      if (plan_.homes[value].series != output) plan_.stages.back().arithmetic.push_back(copy(value, output));
    }
  }

  const Schedule& schedule_;
  const std::vector<Schedule::Step>& steps_;
  const TapeSeries& table_;
  std::vector<CompoundStep> functions_;
  std::vector<std::uint32_t> stage_of_;                 // of every step
  std::vector<std::vector<std::uint32_t>> outputs_of_;  // series of the outputs that a step is
  NativePlan plan_;
};

}  // namespace

NativePlan native_plan(const Schedule& schedule, const TapeSeries& table) { return Planner(schedule, table).plan(); }

}  // namespace dmocbench
