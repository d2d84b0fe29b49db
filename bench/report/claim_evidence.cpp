#include "bench/report/claim_evidence.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/report/html.hpp"
#include "bench/report/table_markup.hpp"
#include "methods/runtime/counted.hpp"
#include "methods/runtime/parsed.hpp"

namespace dmocbench {

namespace {

/// The texts between separators.
std::vector<std::string> parts_of(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + separator.size();
  }
  return parts;
}

const ReportedTable* table_named(const ResultsFolder& results, const std::string& file) {
  const auto found = std::ranges::find(results.tables, file, &ReportedTable::file);
  return found == results.tables.end() ? nullptr : &*found;
}

/// A file that claims name as evidence, as a link to where the page shows it.
std::string link_to(const std::string& file, const ResultsFolder& results) {
  constexpr std::string_view folder = "figures/";
  constexpr std::string_view ending = ".svg";
  if (file.starts_with(folder) && file.ends_with(ending)) {
    const std::string name = file.substr(folder.size(), file.size() - folder.size() - ending.size());
    if (std::ranges::count(results.figures, name, &ReportedFigure::name) > 0)
      return fmt::format("<a href=\"#{}\">figure {}</a>", anchor("figure", name), escaped(in_words(name)));
  }
  if (table_named(results, file) != nullptr)
    return fmt::format("<a href=\"#{}\">{}</a>", anchor("table", file), escaped(file));
  return escaped(file);
}

/// The rows of "2-5 9", where the header is record 1; those that the table lacks are left out.
std::vector<const Row*> rows_at(const std::string& records, const Table& table) {
  std::vector<const Row*> rows;
  for (const std::string& range : parts_of(records, " ")) {
    const std::size_t dash = range.find('-');
    const auto first = parsed<std::size_t>(range.substr(0, dash));
    const auto last = dash == std::string::npos ? first : parsed<std::size_t>(range.substr(dash + 1));
    if (!first || !last || *first < 2) continue;
    for (std::size_t record = *first; record <= std::min(*last, table.rows().size() + 1); ++record)
      rows.push_back(&table.rows()[record - 2]);
  }
  return rows;
}

/// Some of the rows, evenly chosen, with the columns of a table that are among those named, and the status of solves.
Table chosen(const std::vector<const Row*>& rows, const Table& table, const std::vector<std::string>& named) {
  std::vector<std::string> columns;
  std::ranges::copy_if(table.columns(), std::back_inserter(columns), [&](const std::string& column) {
    return column == "status" || std::ranges::count(named, column) > 0;
  });
  Table result(columns);
  const std::size_t count = std::min(rows.size(), most_rows_of_claim);
  for (std::size_t i = 0; i < count; ++i) result.append(*rows[count < 2 ? 0 : i * (rows.size() - 1) / (count - 1)]);
  return result;
}

/// The rows of one table by which a claim was judged; empty where the table is not there.
std::string rows_behind(const Row& told, const ResultsFolder& results) {
  const ReportedTable* const reported = table_named(results, told.text("table"));
  if (reported == nullptr) return "";
  const std::vector<const Row*> rows = rows_at(told.text("records"), reported->table);
  if (rows.empty()) return "";
  const Table shown = chosen(rows, reported->table, parts_of(told.text("columns"), " "));
  const SplitColumns columns = split_columns(shown, shown.columns());
  const std::string all = counted(rows.size(), "row");
  std::string html =
      fmt::format("<details class=\"rows\"><summary>{} of {}{}</summary>\n", all, escaped(reported->file),
                  shown.rows().size() < rows.size() ? fmt::format(", {} of them here", shown.rows().size()) : "");
  html += fmt::format("<p>Of <a href=\"#{}\">{}</a> with its {}", anchor("table", reported->file),
                      escaped(reported->file), counted(reported->table.rows().size(), "row"));
  if (!columns.constant.empty()) html += escaped_prose(fmt::format("; here {}", fmt::join(columns.constant, ", ")));
  html += ".</p>\n";
  if (!columns.differing.empty()) {  // else the sentence is complete
    html +=
        rows_markup(shown, columns.differing, shown.rows().size(), results.metadata_of(reported->run), reported->file);
  }
  return html + "</details>\n";
}

/// "build/bench/claims --out results" of "build/bench/convergence --out results ...": the command that judges the
/// tables of a run.
std::string command_that_judges(const std::string& command) {
  const std::vector<std::string> words = parts_of(command, " ");
  if (words.empty()) return "";
  const std::filesystem::path program(words.front());
  const bool is_one_for_all = program.filename() == "dmocbench";
  const std::string judge = is_one_for_all ? words.front() + " claims" : (program.parent_path() / "claims").string();
  const auto out = std::ranges::find(words, "--out");
  return out == words.end() || out + 1 == words.end() ? judge : fmt::format("{} --out {}", judge, *(out + 1));
}

/// The commands of the runs that wrote these tables, each once, and of the judgement.
std::string commands_html(const std::set<std::string>& files, const ResultsFolder& results) {
  std::vector<std::string> commands;
  for (const std::string& file : files) {
    const ReportedTable* const table = table_named(results, file);
    const std::string command = table == nullptr ? "" : command_of(results.metadata_of(table->run));
    if (!command.empty() && std::ranges::count(commands, command) == 0) commands.push_back(command);
  }
  if (commands.empty()) return "";
  if (const std::string last = command_that_judges(commands.front()); !last.empty()) commands.push_back(last);
  std::string html = "<dt>Again<dd>";
  for (const std::string& command : commands) html += fmt::format("<code class=\"line\">{}</code>\n", escaped(command));
  return html;
}

}  // namespace

std::string claim_evidence(const Row& claim, const ResultsFolder& results) {
  std::vector<std::string> links;
  std::set<std::string> files;
  for (const std::string& file : parts_of(claim.text("evidence"), "; ")) {
    links.push_back(link_to(file, results));
    files.insert(file);
  }
  std::string html = links.empty() ? "" : fmt::format("<dt>Evidence<dd>{}\n", fmt::join(links, ", "));
  std::string rows;
  for (const Row& told : results.claim_rows.rows()) {
    if (told.text("claim") != claim.text("claim")) continue;
    rows += rows_behind(told, results);
    files.insert(told.text("table"));
  }
  if (!rows.empty()) html += "<dt>Judged by<dd>" + rows;
  return html + commands_html(files, results);
}

}  // namespace dmocbench
