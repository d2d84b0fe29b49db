#include "bench/report/statement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "bench/report/html.hpp"
#include "bench/report/mathml.hpp"
#include "bench/report/stated_problem.hpp"
#include "methods/runtime/parsed.hpp"

namespace dmocbench {

namespace {

std::string math(const std::string& content) { return "<math><mrow>" + content + "</mrow></math>"; }

/// A formula on a line of its own that may be broken between terms.
std::string line_of(const std::string& name, const MathTerms& terms, const std::string& ending) {
  std::string html = "<div class=\"formula\">";
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const std::string begin = i == 0 ? name + "<mo>=</mo>" : "";
    html += math(begin + terms[i] + (i + 1 == terms.size() ? ending : "")) + "\n";
  }
  return html + "</div>\n";
}

/// True if a number is written with all its digits: as a fraction, a multiple of π, or because it has few.
bool is_exact(double value) {
  constexpr std::size_t most_letters = 10;
  const std::string markup = mathml_of_number(value);
  return fmt::format("{}", value).size() <= most_letters || markup.find("<mfrac>") != std::string::npos ||
         markup.find("<mi>") != std::string::npos;
}

/// A number with its own digits, or at most eight.
std::string number_html(double value) {
  return mathml_of_number(is_exact(value) ? value : parsed<double>(fmt::format("{:.8g}", value)).value_or(value));
}

/// The condition on a component: its given value, or its bounds; empty if it is free.
std::string condition_of(const std::string& name, double lower, double upper) {
  const std::string least = number_html(lower);
  if (lower == upper) return math(name + (is_exact(lower) ? "<mo>=</mo>" : "<mo>≈</mo>") + least);
  const bool has_lower = std::isfinite(lower);
  const bool has_upper = std::isfinite(upper);
  if (!has_lower && !has_upper) return "";
  if (!has_upper) return math(name + "<mo>≥</mo>" + least);
  const std::string most = "<mo>≤</mo>" + number_html(upper);
  return math(has_lower ? least + "<mo>≤</mo>" + name + most : name + most);
}

/// Conditions in a row, with commas between them.
class Conditions {
 public:
  void add(const std::string& name, double lower, double upper) {
    const std::string condition = condition_of(name, lower, upper);
    if (!condition.empty()) row_ += (row_.empty() ? "" : ", ") + condition;
  }
  void add(const std::vector<std::string>& names, const Bounds& bounds) {
    for (Eigen::Index i = 0; i < bounds.lower.size(); ++i)
      add(names.at(static_cast<std::size_t>(i)), bounds.lower[i], bounds.upper[i]);
  }
  [[nodiscard]] const std::string& row() const { return row_; }

 private:
  std::string row_;
};

std::vector<std::string> part(const std::vector<std::string>& names, std::size_t first, std::size_t count) {
  const auto begin = names.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

/// Formulas by their names, and the parts that they share.
struct WrittenFormulas {
  std::vector<std::string> lines;
  std::string shared;
};

WrittenFormulas written(const std::vector<StatedFormula>& formulas, const std::vector<std::string>& inputs,
                        const StatedProblem& stated) {
  std::vector<Expression> values;
  values.reserve(formulas.size());
  for (const StatedFormula& formula : formulas) values.push_back(formula.value);
  const TypesetFormulas typeset_formulas = typeset(values, inputs, stated.letters.size(), stated.free_letter);
  WrittenFormulas result;
  for (std::size_t i = 0; i < formulas.size(); ++i) {
    result.lines.push_back(line_of(formulas[i].name, typeset_formulas.formulas[i], formulas[i].relation));
  }
  for (const auto& [name, terms] : typeset_formulas.shared) result.shared += line_of(name, terms, "");
  return result;
}

/// "m/s^2" with its exponents raised.
std::string unit_in_print(const std::string& unit) {
  const std::string text = escaped(unit);
  std::string html;
  std::size_t told = 0;
  for (std::size_t at = text.find('^'); at != std::string::npos; at = text.find('^', at + 1)) {
    const std::size_t digits = at + 1 + (text.compare(at + 1, 1, "-") == 0 ? 1 : 0);
    const std::size_t end = std::min(text.find_first_not_of("0123456789", digits), text.size());
    if (end == digits) continue;
    html += text.substr(told, at - told) + "<sup>" + text.substr(at + 1, end - at - 1) + "</sup>";
    told = end;
  }
  return html + text.substr(told);
}

std::string letters_html(const StatedProblem& stated) {
  std::string html;
  for (const StatedProblem::Letter& letter : stated.letters) {
    const Parameter& parameter = *letter.parameter;
    html += fmt::format("<li>{} {}, {}</li>\n", math(letter.mathml + "<mo>=</mo>" + mathml_of_number(parameter.value)),
                        unit_in_print(parameter.unit), escaped(parameter.meaning));
  }
  return html.empty() ? "" : "<ul class=\"letters\">\n" + html + "</ul>\n";
}

/// The integral of the cost, or the final cost, or both.
std::string objective_html(const StatedProblem& stated) {
  const bool has_integral = !stated.along.front().value.is_zero() || !stated.has_final_cost;
  std::string sum;
  if (has_integral)
    sum = "<msubsup><mo>∫</mo><mn>0</mn><mi>T</mi></msubsup><mi>C</mi><mspace width=\"0.2em\"/><mi>d</mi><mi>t</mi>";
  if (stated.has_final_cost) sum += (has_integral ? "<mo>+</mo>" : std::string()) + "<mi>Φ</mi>";
  return "<p>Minimise " + math(sum) + "</p>\n";
}

/// Ends, horizon and bounds, a term each.
std::string limits_html(const Problem& problem, const StatedProblem& stated_problem) {
  const auto n = static_cast<std::size_t>(problem.configuration_size());
  const auto m = static_cast<std::size_t>(problem.control_size());
  const auto l = static_cast<std::size_t>(problem.first_order_size());
  const std::size_t letters = stated_problem.letters.size();
  std::string html = "<dl>\n";
  const ProblemBounds bounds = problem.bounds();
  const auto add = [&html](std::string_view term, const Conditions& conditions) {
    if (!conditions.row().empty()) html += fmt::format("<dt>{}<dd>{}\n", term, conditions.row());
  };
  Conditions begin;
  begin.add(part(stated_problem.end_inputs, letters, n), bounds.first.q);
  begin.add(part(stated_problem.end_inputs, letters + n, n), bounds.first.v);
  begin.add(part(stated_problem.end_inputs, letters + 2 * n, l), bounds.first.y);
  add("Begin", begin);
  for (const InteriorBounds& at : bounds.interior) {
    Conditions between;
    between.add(part(stated_problem.inputs, letters, n), at.q);
    between.add(part(stated_problem.inputs, letters + n, n), at.v);
    between.add(part(stated_problem.inputs, letters + 2 * n + m, l), at.y);
    add(fmt::format("At {}", math("<mi>t</mi><mo>/</mo><mi>T</mi><mo>=</mo>" + number_html(at.relative_time))),
        between);
  }
  Conditions end;
  const std::size_t of_last = letters + 2 * n + l;
  end.add(part(stated_problem.end_inputs, of_last, n), bounds.last.q);
  end.add(part(stated_problem.end_inputs, of_last + n, n), bounds.last.v);
  end.add(part(stated_problem.end_inputs, of_last + 2 * n, l), bounds.last.y);
  add("End", end);
  Conditions horizon;
  horizon.add("<mi>T</mi>", bounds.horizon.lower, bounds.horizon.upper);
  add("Duration", horizon);
  Conditions on_motion;
  on_motion.add(part(stated_problem.inputs, letters, n), bounds.q);
  on_motion.add(part(stated_problem.inputs, letters + n, n), bounds.v);
  on_motion.add(part(stated_problem.inputs, letters + 2 * n, m), bounds.u);
  on_motion.add(part(stated_problem.inputs, letters + 2 * n + m, l), bounds.y);
  for (Eigen::Index i = 0; i < bounds.integrals.lower.size(); ++i) {
    on_motion.add(fmt::format("<msubsup><mo>∫</mo><mn>0</mn><mi>T</mi></msubsup><msub><mi>c</mi><mn>{}</mn></msub>"
                              "<mspace width=\"0.2em\"/><mi>d</mi><mi>t</mi>",
                              i + 1),
                  bounds.integrals.lower[i], bounds.integrals.upper[i]);
  }
  for (const std::size_t unknown : problem.unknowns()) {
    const Parameter& parameter = problem.parameters()[unknown];
    const auto letter = std::ranges::find_if(stated_problem.letters, [&](const StatedProblem::Letter& one) {
      return one.parameter->name == parameter.name;
    });
    on_motion.add(letter->mathml, parameter.lower, parameter.upper);
  }
  add("Bounds", on_motion);
  return html + "</dl>\n";
}

}  // namespace

std::string statement_html(const Problem& problem) {
  const StatedProblem stated_problem = stated(problem);
  const WrittenFormulas along = written(stated_problem.along, stated_problem.inputs, stated_problem);
  const WrittenFormulas at_ends = written(stated_problem.at_ends, stated_problem.end_inputs, stated_problem);

  std::string html = objective_html(stated_problem);
  const bool has_cost = !stated_problem.along.front().value.is_zero();
  for (std::size_t i = has_cost ? 0 : 1; i < along.lines.size(); ++i) html += along.lines[i];
  for (const std::string& line : at_ends.lines) html += line;
  if (!along.shared.empty() || !at_ends.shared.empty()) html += "<p>with</p>\n" + along.shared + at_ends.shared;

  return html + limits_html(problem, stated_problem) + letters_html(stated_problem);
}

}  // namespace dmocbench
