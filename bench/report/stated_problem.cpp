#include "bench/report/stated_problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "bench/report/mathml.hpp"
#include "methods/expression/vectors.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

namespace {

/// Letters that parameters usually have.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> usual_letters{{{"mass", "m"},
                                                                                       {"length", "l"},
                                                                                       {"gravity", "g"},
                                                                                       {"inertia", "J"},
                                                                                       {"stiffness", "k"},
                                                                                       {"damping", "d"},
                                                                                       {"friction", "b"},
                                                                                       {"arm", "r"},
                                                                                       {"lever", "r"},
                                                                                       {"thrust", "a"},
                                                                                       {"width", "w"},
                                                                                       {"horizon", "T"}}};

/// "m_1" of "mass_1", "m_cart" of "cart_mass"; the name itself where no letter is usual.
std::string letter_of(const std::string& name) {
  for (const auto& [word, letter] : usual_letters) {
    if (name == word) return std::string(letter);
    if (name.starts_with(std::string(word) + "_")) return std::string(letter) + name.substr(word.size());
    const std::string ending = "_" + std::string(word);
    if (name.ends_with(ending)) return fmt::format("{}_{}", letter, name.substr(0, name.size() - ending.size()));
  }
  return name;
}

std::string indexed(std::string_view name, std::string_view index) {
  return fmt::format("<msub><mi>{}</mi>{}</msub>", name, index);
}

/// "x(0)".
std::string at(const std::string& name, const std::string& time) {
  return fmt::format(R"(<mrow>{}<mo stretchy="false">(</mo>{}<mo stretchy="false">)</mo></mrow>)", name, time);
}

/// A letter for every parameter that varies: the usual one if it is free.
std::vector<StatedProblem::Letter> letters_of(const Problem& problem, const std::vector<std::string>& varying,
                                              std::vector<std::string> taken) {
  std::vector<StatedProblem::Letter> letters;
  for (const std::string& name : varying) {
    const auto parameter = std::ranges::find(problem.parameters(), name, &Parameter::name);
    std::string letter = mathml_of_name(letter_of(name));
    if (std::ranges::count(taken, letter) > 0) letter = mathml_of_name(name);
    taken.push_back(letter);
    letters.push_back({letter, &*parameter});
  }
  return letters;
}

/// The relation to bounds after a formula.
std::string relation(double lower, double upper) {
  const auto number = [](double value) { return fmt::format("<mn>{:g}</mn>", value); };
  if (lower == upper) return "<mo>=</mo>" + number(lower);
  if (std::isinf(upper)) return "<mo>≥</mo>" + number(lower);
  if (std::isinf(lower)) return "<mo>≤</mo>" + number(upper);
  return "<mo>∈</mo><mo>[</mo>" + number(lower) + "<mo>,</mo>" + number(upper) + "<mo>]</mo>";
}

void trace_along(const Problem& problem, const ProblemBounds& bounds, StatedProblem& result) {
  const Eigen::Index n = problem.configuration_size();
  const Eigen::Index m = problem.control_size();
  InputCounter inputs(result.letters.size());
  ControlledState x;
  x.q = inputs.take(n);
  x.v = inputs.take(n);
  x.u = inputs.take(m);
  x.y = inputs.take(problem.first_order_size());
  x.t = inputs.take();
  result.along.push_back({"<mi>C</mi>", problem.running_cost(x), ""});
  result.along.push_back({"<mi>L</mi>", problem.lagrangian(x.state()), ""});
  const ExpressionVector force = problem.force(x);
  const std::vector<std::string> names = problem.configuration_names();
  for (Eigen::Index i = 0; i < force.size(); ++i)
    result.along.push_back({indexed("f", mathml_of_name(names.at(static_cast<std::size_t>(i)))), force[i], ""});
  const ExpressionVector holonomic = problem.constraints(x.q);
  for (Eigen::Index i = 0; i < holonomic.size(); ++i) {
    result.along.push_back({indexed("g", fmt::format("<mn>{}</mn>", i + 1)), holonomic[i], "<mo>=</mo><mn>0</mn>"});
  }
  const ExpressionVector constraints = problem.path_constraints(x);
  const Bounds path = bounds.of_path(constraints.size());
  for (Eigen::Index i = 0; i < constraints.size(); ++i) {
    result.along.push_back(
        {indexed("h", fmt::format("<mn>{}</mn>", i + 1)), constraints[i], relation(path.lower[i], path.upper[i])});
  }
  const ExpressionVector rates = problem.first_order_rates(x);
  const std::vector<std::string> first_order = problem.first_order_names();
  for (Eigen::Index i = 0; i < rates.size(); ++i)
    result.along.push_back({mathml_of_rate(first_order.at(static_cast<std::size_t>(i))), rates[i], ""});
  const ExpressionVector integrands = problem.integrands(x);
  for (Eigen::Index i = 0; i < integrands.size(); ++i)
    result.along.push_back({indexed("c", fmt::format("<mn>{}</mn>", i + 1)), integrands[i], ""});
}

void trace_ends(const Problem& problem, StatedProblem& result) {
  const Eigen::Index n = problem.configuration_size();
  InputCounter inputs(result.letters.size());
  State first;
  first.q = inputs.take(n);
  first.v = inputs.take(n);
  first.y = inputs.take(problem.first_order_size());
  State last;
  last.q = inputs.take(n);
  last.v = inputs.take(n);
  last.y = inputs.take(problem.first_order_size());
  last.t = inputs.take();
  const Expression final_cost = problem.final_cost(last);
  result.has_final_cost = !final_cost.is_zero();
  if (result.has_final_cost) result.at_ends.push_back({"<mi>Φ</mi>", final_cost, ""});
  const ExpressionVector conditions = problem.boundary_conditions(first, last);
  for (Eigen::Index i = 0; i < conditions.size(); ++i)
    result.at_ends.push_back({indexed("r", fmt::format("<mn>{}</mn>", i + 1)), conditions[i], "<mo>=</mo><mn>0</mn>"});
}

}  // namespace

StatedProblem stated(const Problem& problem) {
  StatedProblem result;
  const std::vector<std::string> varying = TracedProblem(problem).varying_parameters();
  std::vector<std::string> lettered = varying;
  for (const std::size_t unknown : problem.unknowns()) lettered.push_back(problem.parameters()[unknown].name);
  std::vector<std::string> q;
  std::vector<std::string> v;
  for (const std::string& name : problem.configuration_names()) {
    q.push_back(mathml_of_name(name));
    v.push_back(mathml_of_rate(name));
  }
  std::vector<std::string> taken{"<mi>t</mi>", "<mi>C</mi>", "<mi>L</mi>"};
  taken.insert(taken.end(), q.begin(), q.end());
  for (const std::string& name : problem.control_names()) taken.push_back(mathml_of_name(name));
  for (const std::string& name : problem.first_order_names()) taken.push_back(mathml_of_name(name));
  result.letters = letters_of(problem, lettered, taken);
  for (const StatedProblem::Letter& letter : result.letters) {
    result.inputs.push_back(letter.mathml);
    taken.push_back(letter.mathml);
  }
  result.end_inputs = result.inputs;
  result.inputs.insert(result.inputs.end(), q.begin(), q.end());
  result.inputs.insert(result.inputs.end(), v.begin(), v.end());
  for (const std::string& name : problem.control_names()) result.inputs.push_back(mathml_of_name(name));
  for (const std::string& name : problem.first_order_names()) result.inputs.push_back(mathml_of_name(name));
  result.inputs.emplace_back("<mi>t</mi>");
  for (const std::string time : {"<mn>0</mn>", "<mi>T</mi>"}) {
    for (const std::string& name : q) result.end_inputs.push_back(at(name, time));
    for (const std::string& name : v) result.end_inputs.push_back(at(name, time));
    for (const std::string& name : problem.first_order_names())
      result.end_inputs.push_back(at(mathml_of_name(name), time));
  }
  result.end_inputs.emplace_back("<mi>T</mi>");
  for (const std::string letter : {"w", "z", "s", "b", "a"}) {
    const bool is_free = std::ranges::none_of(taken, [&letter](const std::string& name) {
      return name.find("<mi>" + letter + "</mi>") != std::string::npos;
    });
    if (is_free && result.free_letter.empty()) result.free_letter = letter;
  }
  if (result.free_letter.empty()) result.free_letter = "part";

  const ProblemBounds bounds = problem.bounds();  // before the trace: parameters that they read may be open in formulas
  const ParameterTrace open(problem, varying);
  trace_along(problem, bounds, result);
  trace_ends(problem, result);
  return result;
}

}  // namespace dmocbench
