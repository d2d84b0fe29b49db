#include "methods/extensions/interchange/ampl_definitions.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

using Step = Schedule::Step;

/// The number of an operation in AMPL's format.
int ampl_number(Operation operation) {
  constexpr std::array numbers{std::pair(Operation::add, 0),
                               std::pair(Operation::subtract, 1),
                               std::pair(Operation::multiply, 2),
                               std::pair(Operation::divide, 3),
                               std::pair(Operation::reciprocal, 3),
                               std::pair(Operation::power, 5),
                               std::pair(Operation::negate, 16),
                               std::pair(Operation::hyperbolic_tangent, 37),
                               std::pair(Operation::tangent, 38),
                               std::pair(Operation::square_root, 39),
                               std::pair(Operation::hyperbolic_sine, 40),
                               std::pair(Operation::sine, 41),
                               std::pair(Operation::logarithm, 43),
                               std::pair(Operation::exponential, 44),
                               std::pair(Operation::hyperbolic_cosine, 45),
                               std::pair(Operation::cosine, 46),
                               std::pair(Operation::arc_tangent2, 48),
                               std::pair(Operation::arc_tangent, 49),
                               std::pair(Operation::inverse_hyperbolic_sine, 50),
                               std::pair(Operation::arc_sine, 51),
                               std::pair(Operation::arc_cosine, 53)};
  const auto found = std::ranges::find(numbers, operation, [](const auto& pair) { return pair.first; });
  if (found != numbers.end()) return found->second;
  throw Error(
      "a formula contains an operation that AMPL's format does not have, such as erf or a spline; write it with +, "
      "-, *, /, powers and elementary functions");
}

/// The uses of a step, which decide about its definition.
struct Uses {
  std::vector<std::size_t> readers;
  std::vector<AmplReaders> kinds;

  explicit Uses(const Schedule& schedule) : readers(schedule.steps().size()), kinds(schedule.steps().size()) {
    const std::vector<Step>& steps = schedule.steps();
    std::vector<bool> by_rows(steps.size());
    std::vector<bool> by_objective(steps.size());
    for (std::size_t i = 0; i < schedule.outputs().size(); ++i) {
      const std::uint32_t output = schedule.outputs()[i];
      ++readers[output];
      (i == 0 ? by_objective : by_rows)[output] = true;
    }
    for (std::size_t i = steps.size(); i-- > 0;) {
      kinds[i] = !by_rows[i]        ? AmplReaders::objective
                 : !by_objective[i] ? AmplReaders::rows
                                    : AmplReaders::rows_and_objective;
      const std::size_t operands = operand_count(steps[i].operation);
      const auto read = [&](std::uint32_t operand) {
        ++readers[operand];
        by_rows[operand] = by_rows[operand] || by_rows[i];
        by_objective[operand] = by_objective[operand] || by_objective[i];
      };
      if (operands > 0) read(steps[i].left);
      if (operands > 1) read(steps[i].right);
    }
  }
  [[nodiscard]] bool is_defined(const Schedule& schedule, std::size_t step) const {
    return operand_count(schedule.steps()[step].operation) > 0 && readers[step] > 1;
  }
};

}  // namespace

AmplCounts AmplDefinitions::count(const Schedule& schedule) {
  const Uses uses(schedule);
  AmplCounts counts{};
  for (std::size_t i = 0; i < uses.kinds.size(); ++i) {
    if (uses.is_defined(schedule, i)) ++counts[static_cast<std::size_t>(uses.kinds[i])];
  }
  return counts;
}

std::vector<std::string> AmplDefinitions::add(const Schedule& schedule, const std::vector<std::size_t>& variables) {
  const Uses uses(schedule);
  const std::vector<Step>& steps = schedule.steps();
  std::vector<std::string> values(steps.size());  // each until its only reader takes it, or for ever if it is short
  const auto take = [&](std::uint32_t position) {
    return uses.readers[position] > 1 ? values[position] : std::move(values[position]);
  };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& step = steps[i];
    if (step.operation == Operation::constant) {
      values[i] = fmt::format("n{}", step.value);
      continue;
    }
    if (step.operation == Operation::input) {
      values[i] = fmt::format("v{}", variables[step.input_index]);
      continue;
    }
    std::string formula = fmt::format("o{}\n", ampl_number(step.operation));
    if (step.operation == Operation::reciprocal) formula += "n1\n";
    formula += take(step.left);
    if (operand_count(step.operation) > 1) formula += "\n" + take(step.right);
    if (step.operation == Operation::power) formula += fmt::format("\nn{}", step.value);
    if (!uses.is_defined(schedule, i)) {
      values[i] = std::move(formula);
      continue;
    }
    const auto kind = static_cast<std::size_t>(uses.kinds[i]);
    const std::size_t number = next_[kind]++;
    texts_[kind] += fmt::format("V{} 0 0\n{}\n", number, formula);
    values[i] = fmt::format("v{}", number);
  }
  std::vector<std::string> outputs;
  for (const std::uint32_t output : schedule.outputs()) outputs.push_back(values[output]);
  return outputs;
}

}  // namespace dmocbench
