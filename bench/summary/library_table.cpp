#include "bench/summary/library_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace dmocbench {

namespace {

constexpr std::array scheme_columns{"tableau", "stages", "solver", "derivatives"};
using Scheme = std::array<std::string, scheme_columns.size()>;

Scheme scheme_of(const Row& row) {
  Scheme scheme;
  for (std::size_t i = 0; i < scheme.size(); ++i) scheme[i] = row.text(scheme_columns[i]);
  return scheme;
}

/// The distinct values in the order in which they come.
template <class Value, class Read>
std::vector<Value> distinct(const Table& table, const Read& read) {
  std::vector<Value> values;
  for (const Row& row : table.rows()) {
    Value value = read(row);
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(std::move(value));
  }
  return values;
}

std::vector<std::string> distinct_texts(const Table& table, const std::string& column) {
  return distinct<std::string>(table, [&](const Row& row) { return row.text(column); });
}

const Row* find_row(const Table& library, const std::string& problem, const Scheme& scheme, const std::string& method) {
  const auto found = std::find_if(library.rows().begin(), library.rows().end(), [&](const Row& row) {
    return row.text("problem") == problem && row.text("method") == method && scheme_of(row) == scheme;
  });
  return found == library.rows().end() ? nullptr : &*found;
}

/// "0.5545708783346 (13 digits)".
std::string reference_in_words(const Row& row) {
  const auto reference = row.number("reference_objective");
  const auto digits = row.number("reference_digits");
  if (!reference || !digits) return "unknown";
  return fmt::format("{:.{}g} ({} digits)", *reference, static_cast<int>(*digits), *digits);
}

/// "0.554575 (+7.4e-06)", or the status; "elsewhere" beside what is no success.
std::string answer_in_words(const Row& row) {
  if (row.text("status") != "solved") return row.text("status");
  std::string words = fmt::format("{:.7g}", row.number("objective").value_or(std::nan("")));
  if (const auto difference = row.number("relative_difference")) words += fmt::format(" ({:+.1e})", *difference);
  return row.text("success") == "no" ? words + " elsewhere" : words;
}

bool all_say(const std::vector<const Row*>& rows, const std::string& column, const std::string& text) {
  return std::all_of(rows.begin(), rows.end(),
                     [&](const Row* row) { return row != nullptr && row->text(column) == text; });
}

}  // namespace

Table library_table(const Table& rows) {
  std::map<std::array<std::string, scheme_columns.size() + 2>, double> finest;
  const auto curve_of = [](const Row& row) {
    return std::array{row.text("problem"), row.text("method"), row.text("tableau"),
                      row.text("stages"),  row.text("solver"), row.text("derivatives")};
  };
  for (const Row& row : rows.rows()) {
    double& most = finest[curve_of(row)];
    most = std::max(most, row.number("intervals").value_or(0.0));
  }
  Table library({"problem", "reference_objective", "reference_digits", "method", "tableau", "stages", "solver",
                 "derivatives", "intervals", "status", "objective", "relative_difference", "success", "replay_error",
                 "message"});
  for (const Row& row : rows.rows()) {
    if (row.number("intervals").value_or(0.0) != finest[curve_of(row)]) continue;
    Row line;
    for (const std::string& column : library.columns()) line.set(column, row.text(column));
    const auto reference = row.number("reference_objective");
    const auto objective = row.number("objective");
    if (reference && objective) line.set("relative_difference", (*objective - *reference) / std::abs(*reference));
    library.append(std::move(line));
  }
  return library;
}

std::string library_table_in_markdown(const Table& library) {
  const std::vector<std::string> methods = distinct_texts(library, "method");
  std::string text =
      "# The library\n\nEvery problem from its own guess: the cost that a method reaches and, in brackets, its "
      "relative "
      "difference from the reference; where it was not solved, the status. \"Elsewhere\" is farther from the "
      "reference than counts as a success: another minimum, or a grid that is too coarse.\n";
  for (const Scheme& scheme : distinct<Scheme>(library, scheme_of)) {
    text +=
        fmt::format("\n## {} {}, {}, {}\n\n| problem | N | reference |", scheme[0], scheme[1], scheme[2], scheme[3]);
    for (const std::string& method : methods) text += " " + method + " |";
    text += "\n|---|---|---|";
    for (std::size_t i = 0; i < methods.size(); ++i) text += "---|";
    text += "\n";
    int problems = 0;
    int solved = 0;
    int successes = 0;
    for (const std::string& problem : distinct_texts(library, "problem")) {
      std::vector<const Row*> answers;  // by method; null where it was not asked for
      answers.reserve(methods.size());
      for (const std::string& method : methods) answers.push_back(find_row(library, problem, scheme, method));
      const auto any = std::find_if(answers.begin(), answers.end(), [](const Row* row) { return row != nullptr; });
      if (any == answers.end()) continue;
      text += fmt::format("| {} | {} | {} |", problem, (*any)->text("intervals"), reference_in_words(**any));
      for (const Row* row : answers) text += " " + (row == nullptr ? "" : answer_in_words(*row)) + " |";
      text += "\n";
      ++problems;
      if (all_say(answers, "status", "solved")) ++solved;
      if (all_say(answers, "success", "yes")) ++successes;
    }
    text += fmt::format("\nSolved by all: {} of {} problems; with success by all: {}.\n", solved, problems, successes);
  }
  return text;
}

}  // namespace dmocbench
