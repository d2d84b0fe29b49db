#include "methods/extensions/interchange/ampl_model.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/expression/replay.hpp"
#include "methods/extensions/interchange/ampl_definitions.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

/// Names of unknowns or rows, block by block, by the symbols of their blocks (`BlockWords`).
class AmplNames {
 public:
  explicit AmplNames(const Transcription& program)
      : q_(without_spaces(program.problem().configuration_names())),
        u_(without_spaces(program.problem().control_names())) {}

  template <class Kind>
  [[nodiscard]] std::vector<std::string> of(const std::vector<Block<Kind>>& blocks) const {
    std::vector<std::string> names;
    std::map<std::string, int> numbers;  // how many components have a symbol so far
    for (const Block<Kind>& block : blocks) {
      int& number = numbers[symbol_of(block, "{0}", "{1}")];
      for (Eigen::Index i = 0; i < block.width; ++i) {
        const std::string name = symbol_of(block, component_of(block, i), std::to_string(++number));
        const bool is_series = block.support == Support::nodes || block.support == Support::intervals;
        for (std::size_t k = 0; k < block.length; ++k) {
          names.push_back(is_series ? fmt::format("{}[{}]", name, k) : name);
        }
      }
    }
    return names;
  }

 private:
  static std::vector<std::string> without_spaces(std::vector<std::string> names) {
    for (std::string& name : names) {
      std::ranges::replace_if(
          name, [](unsigned char letter) { return std::isspace(letter) != 0; }, '_');
    }
    return names;
  }

  template <class Kind>
  [[nodiscard]] static std::string symbol_of(const Block<Kind>& block, const std::string& component,
                                             const std::string& number) {
    return fmt::format(fmt::runtime(block.words.symbol), component, number, block.stage + 1, block.node);
  }
  template <class Kind>
  [[nodiscard]] std::string component_of(const Block<Kind>& block, Eigen::Index i) const {
    const auto number = static_cast<std::size_t>(block.component + i);
    if (block.words.names == ComponentNames::configuration) return q_[number];
    return block.words.names == ComponentNames::control ? u_[number] : "";
  }

  std::vector<std::string> q_;
  std::vector<std::string> u_;
};

}  // namespace

std::vector<std::string> ampl_variable_names(const Transcription& program) {
  return AmplNames(program).of(program.blocks().unknowns());
}

std::vector<std::string> ampl_row_names(const Transcription& program) {
  return AmplNames(program).of(program.blocks().rows());
}

namespace {

/// A part of the program on one interval, or at the ends: cost and rows as one straight-line code of its unknowns.
struct PlacedFormulas {
  Schedule schedule;                   // the cost, then rows
  std::vector<std::size_t> variables;  // of the program, by local unknowns
  std::vector<std::size_t> rows;       // of the program, by outputs after the cost
};

/// Step, time and open parameters become numbers, so that values depending on them alone are computed here.
PlacedFormulas placed(const LocalFunctions& functions, const std::vector<SeriesPlace>& unknowns,
                      const std::vector<SeriesPlace>& rows, const Transcription& program, std::size_t interval) {
  const LocalInputs& numbers = functions.inputs;
  const Eigen::VectorXd& parameters = program.traced_problem().open_values();
  PlacedFormulas result;
  std::vector<Expression> inputs(numbers.count());
  for (std::size_t i = 0; i < numbers.parameters; ++i) inputs[i] = parameters[static_cast<Eigen::Index>(i)];
  for (std::size_t a = 0; a < numbers.unknowns; ++a) {
    inputs[numbers.unknown(a)] = Expression::input(a);
    result.variables.push_back(unknowns[a].at(interval));
  }
  inputs[numbers.step()] = program.step_inputs()[static_cast<Eigen::Index>(interval)];
  inputs[numbers.time()] = program.time_inputs()[static_cast<Eigen::Index>(interval)];
  const std::span<const Expression> point(inputs);
  std::vector<Expression> outputs = replay<Expression>(functions.cost, point);
  const std::vector<Expression> of_rows = replay<Expression>(functions.rows.schedule, point);
  outputs.insert(outputs.end(), of_rows.begin(), of_rows.end());
  for (const std::size_t row : functions.rows.places) result.rows.push_back(rows[row].at(interval));
  result.schedule = Schedule(outputs);
  return result;
}

/// Calls visit(formulas) for every interval, then for the ends.
template <class Visit>
void for_each_part(const Transcription& program, const Visit& visit) {
  const ProgramBlocks& blocks = program.blocks();
  for (std::size_t k = 0; k < blocks.intervals(); ++k) {
    visit(placed(program.functions(), blocks.unknown_places(), blocks.row_places(), program, k));
  }
  const std::optional<EndFunctions>& ends = program.end_functions();
  if (ends) visit(placed(*ends, blocks.end_unknown_places(), blocks.end_row_places(), program, 0));
}

/// A line per entry.
std::string lines(const std::vector<std::string>& entries) { return fmt::format("{}\n", fmt::join(entries, "\n")); }

/// A sum as AMPL writes it: nothing, one term, a pair, or a list.
std::string sum(const std::vector<std::string>& terms) {
  if (terms.empty()) return "n0\n";
  if (terms.size() == 1) return lines(terms);
  return (terms.size() == 2 ? std::string("o0\n") : fmt::format("o54\n{}\n", terms.size())) + lines(terms);
}

std::string bound(double lower, double upper) {
  if (lower == upper) return fmt::format("4 {}\n", lower);
  if (!std::isfinite(lower)) return std::isfinite(upper) ? fmt::format("1 {}\n", upper) : "3\n";
  return std::isfinite(upper) ? fmt::format("0 {} {}\n", lower, upper) : fmt::format("2 {}\n", lower);
}

std::string bounds(char segment, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  std::string text(1, segment);
  text += '\n';
  for (Eigen::Index i = 0; i < lower.size(); ++i) text += bound(lower[i], upper[i]);
  return text;
}

/// Coefficients by variables.
using LinearPart = std::map<std::size_t, double>;

/// Writes the segments of a program one by one; in the order of the format.
class AmplWriter {
 public:
  explicit AmplWriter(const Transcription& program)
      : program_(program), variables_(program.variable_count()), rows_(program.constraint_count()) {
    for_each_part(program, [&](const PlacedFormulas& part) {
      const AmplCounts more = AmplDefinitions::count(part.schedule);
      std::ranges::transform(counts_, more, counts_.begin(), std::plus());
    });
    const SparsityPattern pattern = program.jacobian_structure().expand();
    columns_.resize(rows_);
    linear_rows_.resize(rows_);
    for (std::size_t e = 0; e < pattern.size(); ++e) {
      columns_[static_cast<std::size_t>(pattern.rows[e])].push_back(pattern.columns[e]);
    }
    for (std::vector<int>& columns : columns_) std::ranges::sort(columns);
    entries_ = pattern.size();
    find_objective_variables();
  }

  [[nodiscard]] std::string text(const Eigen::VectorXd& start) {
    const std::string formulas_of_all = formulas();  // finds the linear parts
    return header() + formulas_of_all + initial(start) +
           bounds('r', program_.constraint_lower(), program_.constraint_upper()) +
           bounds('b', program_.variable_lower(), program_.variable_upper()) + patterns();
  }

 private:
  void find_objective_variables() {
    std::vector<char> is_read(variables_);
    const auto note = [&](const LocalFunctions& functions, const std::vector<SeriesPlace>& unknowns,
                          std::size_t intervals) {
      for (const std::size_t a : functions.gradient.places) {
        for (std::size_t k = 0; k < intervals; ++k) is_read[unknowns[a].at(k)] = 1;
      }
    };
    const ProgramBlocks& blocks = program_.blocks();
    note(program_.functions(), blocks.unknown_places(), blocks.intervals());
    const std::optional<EndFunctions>& ends = program_.end_functions();
    if (ends) note(*ends, blocks.end_unknown_places(), 1);
    for (std::size_t i = 0; i < variables_; ++i) {
      if (is_read[i] != 0) objective_variables_.push_back(i);
    }
  }

  [[nodiscard]] std::string header() const {
    const auto count_rows = [&](const auto& is_counted) {
      std::size_t count = 0;
      for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(rows_); ++i) {
        if (is_counted(program_.constraint_lower()[i], program_.constraint_upper()[i])) ++count;
      }
      return count;
    };
    const std::size_t equations = count_rows([](double lower, double upper) { return lower == upper; });
    const std::size_t ranges = count_rows(
        [](double lower, double upper) { return std::isfinite(lower) && std::isfinite(upper) && lower != upper; });
    return fmt::format(
        "g3 1 1 0\t# problem {}\n"
        " {} {} 1 {} {}\t# vars, constraints, objectives, ranges, eqns\n"
        " {} 1\t# nonlinear constraints, objectives\n"
        " 0 0\t# network constraints: nonlinear, linear\n"
        " {} {} {}\t# nonlinear vars in constraints, objectives, both\n"
        " 0 0 0 1\t# linear network variables; functions; arith, flags\n"
        " 0 0 0 0 0\t# discrete variables: binary, integer, nonlinear (b,c,o)\n"
        " {} {}\t# nonzeros in Jacobian, gradients\n"
        " {} {}\t# max name lengths: constraints, variables\n"
        " {} {} {} 0 0\t# common exprs: b,c,o,c1,o1\n",
        program_.problem().name(), variables_, rows_, ranges, equations, rows_, variables_, variables_, variables_,
        entries_, objective_variables_.size(), longest(ampl_row_names(program_)),
        longest(ampl_variable_names(program_)), counts_[0], counts_[1], counts_[2]);
  }
  static std::size_t longest(const std::vector<std::string>& names) {
    std::size_t length = 0;
    for (const std::string& name : names) length = std::max(length, name.size());
    return length;
  }

  /// Takes the terms that are bare variables out of a sum: they belong to its linear part.
  void take_linear_terms(std::vector<std::string>& terms, LinearPart& linear) const {
    std::erase_if(terms, [&](const std::string& term) {
      const auto variable =
          term.starts_with('v') ? parsed<std::size_t>(std::string_view(term).substr(1)) : std::nullopt;
      if (!variable || *variable >= variables_) return false;
      linear[*variable] += 1.0;
      return true;
    });
  }

  [[nodiscard]] std::string formulas() {
    AmplDefinitions definitions({variables_, variables_ + counts_[0], variables_ + counts_[0] + counts_[1]});
    std::vector<std::vector<std::string>> rows(rows_);
    std::vector<std::string> costs;
    for_each_part(program_, [&](const PlacedFormulas& part) {
      std::vector<std::string> texts = definitions.add(part.schedule, part.variables);
      if (texts.front() != "n0") costs.push_back(std::move(texts.front()));
      for (std::size_t e = 0; e < part.rows.size(); ++e) rows[part.rows[e]].push_back(std::move(texts[e + 1]));
    });
    for (std::size_t row = 0; row < rows_; ++row) take_linear_terms(rows[row], linear_rows_[row]);
    take_linear_terms(costs, linear_objective_);
    std::string text = definitions.text();
    for (std::size_t row = 0; row < rows_; ++row) text += fmt::format("C{}\n{}", row, sum(rows[row]));
    return text + "O0 0\n" + sum(costs);
  }

  [[nodiscard]] std::string initial(const Eigen::VectorXd& start) const {
    std::string text = fmt::format("x{}\n", variables_);
    for (Eigen::Index i = 0; i < start.size(); ++i) fmt::format_to(std::back_inserter(text), "{} {}\n", i, start[i]);
    return text;
  }

  [[nodiscard]] std::string patterns() const {
    std::vector<std::size_t> in_column(variables_);
    for (const std::vector<int>& columns : columns_) {
      for (const int column : columns) ++in_column[static_cast<std::size_t>(column)];
    }
    std::partial_sum(in_column.begin(), in_column.end(), in_column.begin());
    std::string text = fmt::format("k{}\n", variables_ - 1);
    const auto out = std::back_inserter(text);
    for (std::size_t i = 0; i + 1 < variables_; ++i) fmt::format_to(out, "{}\n", in_column[i]);
    for (std::size_t row = 0; row < rows_; ++row) {
      if (columns_[row].empty()) continue;
      fmt::format_to(out, "J{} {}\n", row, columns_[row].size());
      for (const int column : columns_[row]) {
        fmt::format_to(out, "{} {}\n", column, coefficient(linear_rows_[row], static_cast<std::size_t>(column)));
      }
    }
    if (objective_variables_.empty()) return text;
    fmt::format_to(out, "G0 {}\n", objective_variables_.size());
    for (const std::size_t variable : objective_variables_) {
      fmt::format_to(out, "{} {}\n", variable, coefficient(linear_objective_, variable));
    }
    return text;
  }

  static double coefficient(const LinearPart& linear, std::size_t variable) {
    const auto found = linear.find(variable);
    return found == linear.end() ? 0.0 : found->second;
  }

  const Transcription& program_;
  std::size_t variables_;
  std::size_t rows_;
  AmplCounts counts_{};
  std::size_t entries_ = 0;                // of the Jacobian
  std::vector<std::vector<int>> columns_;  // of every row of it
  std::vector<std::size_t> objective_variables_;
  std::vector<LinearPart> linear_rows_;  // the parts outside their formulas
  LinearPart linear_objective_;
};

}  // namespace

AmplModel ampl_model(const Transcription& program, const Eigen::VectorXd& start) {
  if (static_cast<std::size_t>(start.size()) != program.variable_count()) {
    throw Error("the start has {} entries, but the program has {} variables", start.size(), program.variable_count());
  }
  return {.nl = AmplWriter(program).text(start),
          .row = lines(ampl_row_names(program)) + "cost\n",
          .col = lines(ampl_variable_names(program))};
}

}  // namespace dmocbench
