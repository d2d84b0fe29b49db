#include "bench/summary/library_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace dmocbench {

namespace {

/// "0.5545708783346 (13 digits)".
std::string reference_in_words(const Row& row) {
  const auto reference = row.number("reference_objective");
  const auto digits = row.number("reference_digits");
  if (!reference || !digits) return "unknown";
  return fmt::format("{:.{}g} ({} digits)", *reference, static_cast<int>(*digits), *digits);
}

/// "0.554575 (+7.4e-06)", or the status; "elsewhere" marks a solve without success.
std::string answer_in_words(const Row& row) {
  if (row.text("status") != "solved") return row.text("status");
  std::string words = fmt::format("{:.7g}", row.number("objective", std::nan("")));
  if (const auto difference = row.number("relative_difference")) words += fmt::format(" ({:+.1e})", *difference);
  return row.text("success") == "no" ? words + " elsewhere" : words;
}

}  // namespace

Table library_table(const Selection& rows) {
  Table library({"problem", "reference_objective", "reference_digits", "method", "tableau", "stages", "solver",
                 "derivatives", "intervals", "status", "objective", "relative_difference", "success", "replay_error",
                 "message"});
  for (const Selection& curve : rows.group_by({"problem", "method", "tableau", "stages", "solver", "derivatives"})) {
    for (const Row& row : curve.where("intervals", curve.sorted_by("intervals").back().text("intervals"))) {
      Row line = fields_of(row, library.columns());
      const auto reference = row.number("reference_objective");
      const auto objective = row.number("objective");
      if (reference && objective) line.set("relative_difference", (*objective - *reference) / std::abs(*reference));
      library.append(std::move(line));
    }
  }
  return library;
}

std::string library_table_in_markdown(const Selection& library) {
  const std::vector<std::string> methods = library.distinct("method");
  std::string text =
      "# The library\n\n"
      "Every problem from its own guess: the cost that a method reaches and, in brackets, its relative difference from "
      "the reference; where it was not solved, the status. \"Elsewhere\" is farther from the reference than counts as "
      "a success: another minimum, or a grid that is too coarse.\n";
  for (const Selection& scheme : library.group_by({"tableau", "stages", "solver", "derivatives"})) {
    const Row& head = scheme.front();
    text += fmt::format("\n## {} {}, {}, {}\n\n| problem | N | reference | {} |\n|---|---|---|", head.text("tableau"),
                        head.text("stages"), head.text("solver"), head.text("derivatives"), fmt::join(methods, " | "));
    for (std::size_t i = 0; i < methods.size(); ++i) text += "---|";
    const std::vector<Selection> problems = scheme.group_by({"problem"});
    for (const Selection& answers : problems) {
      text += fmt::format("\n| {} | {} | {} |", answers.front().text("problem"), answers.front().text("intervals"),
                          reference_in_words(answers.front()));
      for (const std::string& method : methods) {
        text += " " + answer_in_words(answers.where("method", method).front()) + " |";
      }
    }
    const auto count_by_all = [&](const char* column, const char* said) {
      return std::ranges::count_if(problems, [&](const Selection& answers) {
        return std::ranges::all_of(methods, [&](const std::string& method) {
          return answers.where("method", method).front().text(column) == said;
        });
      });
    };
    text += fmt::format("\n\nSolved by all: {} of {} problems; with success by all: {}.\n",
                        count_by_all("status", "solved"), problems.size(), count_by_all("success", "yes"));
  }
  return text;
}

}  // namespace dmocbench
