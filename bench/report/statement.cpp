#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "bench/report/mathml.hpp"
#include "bench/report/model.hpp"
#include "bench/report/stated_problem.hpp"
#include "methods/expression/vectors.hpp"
#include "methods/mechanics/parameter_scope.hpp"
#include "methods/mechanics/point_of_inputs.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

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

/// True if a number is written with all its digits: as a fraction, a multiple of π, or because it has few.
bool is_exact(double value) {
  constexpr std::size_t most_letters = 10;
  const std::string markup = mathml_of_number(value);
  return fmt::format("{}", value).size() <= most_letters || markup.find("<mfrac>") != std::string::npos ||
         markup.find("<mi>") != std::string::npos;
}

/// A number with its own digits, or at most eight.
std::string number_of(double value) {
  return mathml_of_number(is_exact(value) ? value : parsed<double>(fmt::format("{:.8g}", value)).value_or(value));
}

/// The relation of a quantity or a formula to its bounds; empty if it has none.
std::string relation(double lower, double upper) {
  const std::string least = number_of(lower);
  if (lower == upper) return (is_exact(lower) ? "<mo>=</mo>" : "<mo>≈</mo>") + least;
  if (std::isinf(lower) && std::isinf(upper)) return "";
  if (std::isinf(upper)) return "<mo>≥</mo>" + least;
  if (std::isinf(lower)) return "<mo>≤</mo>" + number_of(upper);
  return fmt::format("<mo>∈</mo><mo>[</mo>{}<mo>,</mo>{}<mo>]</mo>", least, number_of(upper));
}

std::string indexed(std::string_view letter, const std::string& index) {
  return fmt::format("<msub><mi>{}</mi>{}</msub>", letter, index);
}

Names in_mathml(Names names, std::string (*as_mathml)(std::string_view)) {
  std::ranges::transform(names, names.begin(), as_mathml);
  return names;
}

/// "x(0)" of every name.
Names at_time(Names names, std::string_view time) {
  constexpr std::string_view form = R"(<mrow>{}<mo stretchy="false">(</mo>{}<mo stretchy="false">)</mo></mrow>)";
  for (std::string& name : names) name = fmt::format(form, name, time);
  return names;
}

void append(Names& names, std::initializer_list<Names> others) {
  for (const Names& other : others) names.insert(names.end(), other.begin(), other.end());
}

/// Adds formulas that have names.
void add(std::vector<StatedFormula>& formulas, const Names& names, const ExpressionVector& values) {
  for (Eigen::Index i = 0; i < values.size(); ++i)
    formulas.push_back({names.at(static_cast<std::size_t>(i)), values[i], ""});
}

/// Adds formulas that have a letter and a number.
void add(std::vector<StatedFormula>& formulas, std::string_view letter, const ExpressionVector& values,
         const Bounds& bounds) {
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    formulas.push_back(
        {indexed(letter, fmt::format("<mn>{}</mn>", i + 1)), values[i], relation(bounds.lower[i], bounds.upper[i])});
  }
}

Bounds zeros(const ExpressionVector& values) { return Bounds::all(values.size(), 0.0, 0.0); }

void trace_along(const Problem& problem, const ProblemBounds& bounds, StatedProblem& result) {
  InputCounter inputs(result.letters.size());
  const ControlledState x = take_point(inputs, problem);
  result.along.push_back({"<mi>C</mi>", problem.running_cost(x), ""});
  result.along.push_back({"<mi>L</mi>", problem.lagrangian(x.state()), ""});
  Names forces = in_mathml(problem.configuration_names(), mathml_of_name);
  for (std::string& name : forces) name = indexed("f", name);
  add(result.along, forces, problem.force(x));
  const ExpressionVector holonomic = problem.constraints(x.q);
  add(result.along, "g", holonomic, zeros(holonomic));
  const ExpressionVector rates = problem.velocity_constraints(x.q, x.v);
  add(result.along, "a", rates, zeros(rates));
  const ExpressionVector path = problem.path_constraints(x);
  add(result.along, "h", path, bounds.of_path(path.size()));
  add(result.along, in_mathml(problem.first_order_names(), mathml_of_rate), problem.first_order_rates(x));
  const ExpressionVector integrands = problem.integrands(x);
  add(result.along, "c", integrands, Bounds::none(integrands.size()));
}

void trace_ends(const Problem& problem, StatedProblem& result) {
  InputCounter inputs(result.letters.size());
  std::array<State, 2> ends;
  for (State& end : ends) {
    end.q = inputs.take(problem.configuration_size());
    end.v = inputs.take(problem.configuration_size());
    end.y = inputs.take(problem.first_order_size());
  }
  ends[1].t = inputs.take();
  const Expression final_cost = problem.final_cost(ends[1]);
  result.has_final_cost = !final_cost.is_zero();
  if (result.has_final_cost) result.at_ends.push_back({"<mi>Φ</mi>", final_cost, ""});
  const ExpressionVector conditions = problem.boundary_conditions(ends[0], ends[1]);
  add(result.at_ends, "r", conditions, zeros(conditions));
}

/// A letter that no name contains.
std::string free_letter(const Names& taken) {
  for (const char* const letter : {"w", "z", "s", "b", "a"}) {
    const auto has_letter = [&](const std::string& name) {
      return name.find(fmt::format("<mi>{}</mi>", letter)) != std::string::npos;
    };
    if (std::ranges::none_of(taken, has_letter)) return letter;
  }
  return "part";
}

/// A formula on a line of its own that may be broken between terms.
Json line_of(const std::string& name, MathTerms terms, const std::string& ending) {
  terms.front().insert(0, name + "<mo>=</mo>");
  terms.back() += ending;
  return {{"terms", terms}};
}

/// Conditions by the place where they hold.
class Conditions {
 public:
  void add(const std::string& name, double lower, double upper) {
    const std::string condition = relation(lower, upper);
    if (!condition.empty()) all_.push_back(name + condition);
  }
  /// Bounds on `count` quantities, or none; the names of the quantities begin at `first`, which moves behind them.
  void add(const std::vector<std::string>& names, std::size_t& first, Eigen::Index count, const Bounds& bounds) {
    for (Eigen::Index i = 0; i < bounds.lower.size(); ++i)
      add(names.at(first + static_cast<std::size_t>(i)), bounds.lower[i], bounds.upper[i]);
    first += static_cast<std::size_t>(count);
  }
  void append_to(Json& limits, const char* place, const std::string& time = "") const {
    if (!all_.empty()) limits.push_back({{"place", place}, {"time", time}, {"conditions", all_}});
  }

 private:
  std::vector<std::string> all_;
};

/// Adds formulas by their names, and the parts that they share.
void add_formulas(const std::vector<StatedFormula>& formulas, const std::vector<std::string>& inputs,
                  const StatedProblem& stated, Json& model) {
  std::vector<Expression> values;
  std::ranges::transform(formulas, std::back_inserter(values), &StatedFormula::value);
  const TypesetFormulas typeset_formulas = typeset(values, inputs, stated.letters.size(), stated.free_letter);
  for (std::size_t i = 0; i < formulas.size(); ++i) {
    const bool is_no_cost = formulas[i].name == "<mi>C</mi>" && values[i].is_zero();
    if (!is_no_cost)
      model["formulas"].push_back(line_of(formulas[i].name, typeset_formulas.formulas[i], formulas[i].relation));
  }
  for (const auto& [name, terms] : typeset_formulas.shared) model["shared"].push_back(line_of(name, terms, ""));
}

/// "m/s²" of "m/s^2".
std::string unit_in_print(const std::string& unit) {
  constexpr std::array superscripts{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string print;
  for (std::size_t at = 0; at < unit.size();) {
    const bool is_negative = unit.compare(at, 2, "^-") == 0;
    const std::size_t digits = at + (is_negative ? 2 : 1);
    const std::size_t end = std::min(unit.find_first_not_of("0123456789", digits), unit.size());
    if (unit[at] != '^' || end <= digits) {
      print += unit[at++];
      continue;
    }
    if (is_negative) print += "⁻";
    for (at = digits; at < end; ++at) print += superscripts.at(static_cast<std::size_t>(unit[at] - '0'));
  }
  return print;
}

Json letters_json(const StatedProblem& stated) {
  Json letters = Json::array();
  for (const StatedProblem::Letter& letter : stated.letters) {
    const Parameter& parameter = *letter.parameter;
    letters.push_back({{"equation", letter.mathml + "<mo>=</mo>" + mathml_of_number(parameter.value)},
                       {"unit", unit_in_print(parameter.unit)},
                       {"meaning", parameter.meaning}});
  }
  return letters;
}

/// The integral over the time of the motion.
std::string integral_of(const std::string& integrand) {
  return "<msubsup><mo>∫</mo><mn>0</mn><mi>T</mi></msubsup>" + integrand +
         "<mspace width=\"0.2em\"/><mi>d</mi><mi>t</mi>";
}

/// The integral of the cost, or the final cost, or both.
std::string objective_of(const StatedProblem& stated) {
  const bool has_integral = !stated.along.front().value.is_zero() || !stated.has_final_cost;
  std::string sum = has_integral ? integral_of("<mi>C</mi>") : "";
  if (stated.has_final_cost) sum += has_integral ? "<mo>+</mo><mi>Φ</mi>" : "<mi>Φ</mi>";
  return sum;
}

/// Ends, horizon and bounds.
Json limits_of(const Problem& problem, const StatedProblem& stated) {
  const Eigen::Index n = problem.configuration_size();
  const Eigen::Index m = problem.control_size();
  const Eigen::Index l = problem.first_order_size();
  const ProblemBounds bounds = problem.bounds();
  Json limits = Json::array();
  std::size_t place = stated.letters.size();
  for (const auto& [name, end] : {std::pair("Begin", &bounds.first), std::pair("End", &bounds.last)}) {
    Conditions conditions;
    conditions.add(stated.end_inputs, place, n, end->q);
    conditions.add(stated.end_inputs, place, n, end->v);
    conditions.add(stated.end_inputs, place, l, end->y);
    conditions.append_to(limits, name);
  }
  for (const InteriorBounds& at : bounds.interior) {
    Conditions conditions;
    place = stated.letters.size();
    conditions.add(stated.inputs, place, n, at.q);
    conditions.add(stated.inputs, place, n, at.v);
    place += static_cast<std::size_t>(m);
    conditions.add(stated.inputs, place, l, at.y);
    conditions.append_to(limits, "At", "<mi>t</mi><mo>/</mo><mi>T</mi><mo>=</mo>" + number_of(at.relative_time));
  }
  Conditions horizon;
  horizon.add("<mi>T</mi>", bounds.horizon.lower, bounds.horizon.upper);
  horizon.append_to(limits, "Duration");
  Conditions along;
  place = stated.letters.size();
  along.add(stated.inputs, place, n, bounds.q);
  along.add(stated.inputs, place, n, bounds.v);
  along.add(stated.inputs, place, m, bounds.u);
  along.add(stated.inputs, place, l, bounds.y);
  for (Eigen::Index i = 0; i < bounds.integrals.lower.size(); ++i) {
    along.add(integral_of(fmt::format("<msub><mi>c</mi><mn>{}</mn></msub>", i + 1)), bounds.integrals.lower[i],
              bounds.integrals.upper[i]);
  }
  for (const StatedProblem::Letter& letter : stated.letters) {
    const auto is_letter = [&](std::size_t unknown) { return &problem.parameters()[unknown] == letter.parameter; };
    if (std::ranges::any_of(problem.unknowns(), is_letter))
      along.add(letter.mathml, letter.parameter->lower, letter.parameter->upper);
  }
  along.append_to(limits, "Bounds");
  return limits;
}

}  // namespace

StatedProblem stated(const Problem& problem) {
  StatedProblem result;
  const Names varying = TracedProblem(problem).varying_parameters();
  Names lettered = varying;
  for (const std::size_t unknown : problem.unknowns()) lettered.push_back(problem.parameters()[unknown].name);
  const Names q = in_mathml(problem.configuration_names(), mathml_of_name);
  const Names v = in_mathml(problem.configuration_names(), mathml_of_rate);
  const Names u = in_mathml(problem.control_names(), mathml_of_name);
  const Names y = in_mathml(problem.first_order_names(), mathml_of_name);
  Names taken{"<mi>t</mi>", "<mi>C</mi>", "<mi>L</mi>"};
  append(taken, {q, u, y});
  result.letters = letters_of(problem, lettered, taken);
  for (const StatedProblem::Letter& letter : result.letters) result.inputs.push_back(letter.mathml);
  append(taken, {result.inputs});
  result.end_inputs = result.inputs;
  append(result.inputs, {q, v, u, y, {"<mi>t</mi>"}});
  for (const std::string_view time : {"<mn>0</mn>", "<mi>T</mi>"})
    append(result.end_inputs, {at_time(q, time), at_time(v, time), at_time(y, time)});
  append(result.end_inputs, {{"<mi>T</mi>"}});
  result.free_letter = free_letter(taken);

  const ProblemBounds bounds = problem.bounds();  // before the trace: parameters that they read may be open in formulas
  const ParameterTrace open(problem, varying);
  trace_along(problem, bounds, result);
  trace_ends(problem, result);
  return result;
}

PageModel statement_model(const Problem& problem) {
  const StatedProblem stated_problem = stated(problem);
  Json model{{"objective", objective_of(stated_problem)}, {"formulas", Json::array()}, {"shared", Json::array()}};
  add_formulas(stated_problem.along, stated_problem.inputs, stated_problem, model);
  add_formulas(stated_problem.at_ends, stated_problem.end_inputs, stated_problem, model);
  model["limits"] = limits_of(problem, stated_problem);
  model["letters"] = letters_json(stated_problem);
  return model;
}

}  // namespace dmocbench
