#include "bench/python/formula_text.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "methods/choose.hpp"
#include "methods/expression/schedule.hpp"

namespace dmocbench::python {

namespace {

/// Names of inputs by their numbers.
std::map<std::size_t, std::string>& input_names() {
  thread_local std::map<std::size_t, std::string> names;
  return names;
}

/// How tightly the operator of a text binds its operands.
enum class Binding : std::uint8_t { sum, product, power, atom };

struct Text {
  std::string words;
  Binding binding = Binding::atom;
};

std::string within(const Text& text, Binding least) {
  return text.binding < least ? fmt::format("({})", text.words) : text.words;
}

std::string_view name_of_function(Operation operation) {
  constexpr std::array functions{std::pair(Operation::square_root, "sqrt"),
                                 std::pair(Operation::exponential, "exp"),
                                 std::pair(Operation::logarithm, "log"),
                                 std::pair(Operation::sine, "sin"),
                                 std::pair(Operation::cosine, "cos"),
                                 std::pair(Operation::tangent, "tan"),
                                 std::pair(Operation::arc_sine, "asin"),
                                 std::pair(Operation::arc_cosine, "acos"),
                                 std::pair(Operation::arc_tangent, "atan"),
                                 std::pair(Operation::arc_tangent2, "atan2"),
                                 std::pair(Operation::hyperbolic_sine, "sinh"),
                                 std::pair(Operation::hyperbolic_cosine, "cosh"),
                                 std::pair(Operation::hyperbolic_tangent, "tanh"),
                                 std::pair(Operation::inverse_hyperbolic_sine, "asinh"),
                                 std::pair(Operation::error_function, "erf"),
                                 std::pair(Operation::unit_step, "step")};
  for (const auto& [known, name] : functions) {
    if (known == operation) return name;
  }
  return "?";
}

Text number(double value) { return {fmt::format("{}", value), value < 0.0 ? Binding::sum : Binding::atom}; }

/// The text of a step, from the texts of its operands, which are the same for a square.
Text text_of_step(const Schedule::Step& step, const Text& left, const Text& right) {
  switch (step.operation) {
    case Operation::constant:
      return number(step.value);
    case Operation::input: {
      const auto found = input_names().find(step.input_index);
      return {found != input_names().end() ? found->second : fmt::format("x{}", step.input_index), Binding::atom};
    }
    case Operation::add:
      return {left.words + " + " + right.words, Binding::sum};
    case Operation::subtract:
      return {left.words + " - " + within(right, Binding::product), Binding::sum};
    case Operation::multiply:
      if (step.left == step.right) return {within(left, Binding::atom) + "**2", Binding::power};
      return {within(left, Binding::product) + "*" + within(right, Binding::product), Binding::product};
    case Operation::divide:
      return {within(left, Binding::product) + "/" + within(right, Binding::power), Binding::product};
    case Operation::negate:
      return {"-" + within(left, Binding::product), Binding::sum};
    case Operation::reciprocal:
      return {"1/" + within(left, Binding::power), Binding::product};
    case Operation::power:
      return {within(left, Binding::atom) + "**" + within(number(step.value), Binding::atom), Binding::power};
    case Operation::arc_tangent2:
      return {"atan2(" + left.words + ", " + right.words + ")", Binding::atom};
    default:
      return {fmt::format("{}({})", name_of_function(step.operation), left.words), Binding::atom};
  }
}

}  // namespace

void name_inputs(const ExpressionVector& entries, const std::string& prefix, const std::vector<std::string>& names) {
  for (Eigen::Index i = 0; i < entries.size(); ++i) {
    const Schedule alone(std::span(&entries[i], 1));
    if (alone.steps().size() != 1 || alone.steps().front().operation != Operation::input) continue;
    const std::string& name = names[static_cast<std::size_t>(i)];
    input_names()[alone.steps().front().input_index] = prefix.empty() ? name : fmt::format("{}.{}", prefix, name);
  }
}

std::string text_of_formula(const Expression& formula) {
  constexpr std::size_t most_letters = 500;
  const Schedule schedule(std::span(&formula, 1));
  const std::vector<Schedule::Step>& steps = schedule.steps();
  std::vector<Text> texts;
  texts.reserve(steps.size());
  for (const Schedule::Step& step : steps) {
    const std::size_t operands = operand_count(step.operation);
    Text text = text_of_step(step, operands > 0 ? texts[step.left] : Text{}, operands > 1 ? texts[step.right] : Text{});
    // Parts that others read are repeated: without a limit their lengths could double with every operation.
    if (text.words.size() > 2 * most_letters) text.words.resize(2 * most_letters);
    texts.push_back(std::move(text));
  }
  std::string words = std::move(texts[schedule.outputs().front()].words);
  if (words.size() <= most_letters) return words;
  words.resize(most_letters);
  return fmt::format("{}... ({} operations)", words, schedule.operation_count());
}

}  // namespace dmocbench::python
