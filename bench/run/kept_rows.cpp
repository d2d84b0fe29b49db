#include "bench/run/kept_rows.hpp"

#include <algorithm>
#include <utility>

#include "bench/run/described_tables.hpp"
#include "bench/run/json_place.hpp"
#include "bench/run/problem_libraries.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

bool has_column(const Table& table, std::string_view column) {
  return std::ranges::find(table.columns(), column) != table.columns().end();
}

Statement statement_of(const Row& row) { return {row.text("problem"), row.text("library"), row.text("settings")}; }

std::vector<std::string> with_statement_after_problem(std::vector<std::string> columns) {
  const auto problem = std::ranges::find(columns, "problem");
  if (problem != columns.end()) columns.insert(problem + 1, {"library", "settings"});
  return columns;
}

/// An entry of "earlier_runs": a run without its tables and without the runs before it.
Json entry_of(Json metadata) {
  metadata["complete"] = metadata.contains("run_complete") ? metadata["run_complete"] : metadata["complete"];
  metadata.erase("run_complete");
  for (const char* const key : {"tables", "motions", "earlier_runs"}) metadata.erase(key);
  return metadata;
}

std::set<Statement> statements_in(const JsonPlace& run) {
  std::set<Statement> statements;
  for (const JsonPlace& entry : run.at("statements").entries()) {
    statements.insert({entry.at("problem").text(), entry.at("library").text(), entry.at("settings").text()});
  }
  return statements;
}

std::set<Statement> statements_of(const std::vector<Case>& cases) {
  std::set<Statement> statements;
  for (const Case& one : cases) statements.insert(statement_of(one.nominal ? *one.nominal : *one.problem));
  return statements;
}

Json in_json(const std::set<Statement>& statements) {
  Json list = Json::array();
  for (const Statement& one : statements)
    list.push_back({{"problem", one.problem}, {"library", one.library}, {"settings", one.settings}});
  return list;
}

}  // namespace

Statement statement_of(const Problem& problem) {
  return {problem.name(), library_of(problem.name()), problem.settings()};
}

Table with_statements(const Table& table, const std::set<Statement>& statements) {
  if (!has_column(table, "problem") || has_column(table, "settings")) return table;
  Table result(with_statement_after_problem(table.columns()));
  result.describe(table.facts());
  constexpr FieldType text{FieldKind::text, true};
  result.describe({{"library", {"", "file of the problem's library; empty for problems of the suite", text}},
                   {"settings", {"", "parameters that differ from their defaults, separated by spaces", text}}});
  result.set_key(with_statement_after_problem(table.key()));
  for (Row row : table.rows()) {
    const auto stated = std::ranges::find(statements, row.text("problem"), &Statement::problem);
    row.set("library", stated == statements.end() ? "" : stated->library);
    row.set("settings", stated == statements.end() ? "" : stated->settings);
    result.append(std::move(row));
  }
  return result;
}

KeptRows::KeptRows(std::filesystem::path prefix, const std::vector<Case>& cases)
    : KeptRows(std::move(prefix), statements_of(cases)) {
  any_settings_ = std::ranges::any_of(cases, [](const Case& one) { return one.nominal != nullptr; });
}

KeptRows::KeptRows(std::filesystem::path prefix, std::set<Statement> own)
    : prefix_(std::move(prefix)), own_(std::move(own)) {
  const std::filesystem::path metadata = prefix_.string() + ".json";
  std::error_code none;  // a missing file is not a regular file
  if (!std::filesystem::is_regular_file(metadata, none)) return;
  earlier_ = json_or_null(read_file(metadata));
  if (!earlier_.is_object())
    throw Error("{} is damaged; move it and its tables away, or choose another --out", metadata.string());
}

void KeptRows::read(const std::filesystem::path& file) {
  std::error_code none;  // a missing file is not a regular file
  if (!std::filesystem::is_regular_file(file, none)) return;
  const Table table = read_table(file);
  if (!has_column(table, "problem") || !has_column(table, "settings")) return;
  Table kept(table.columns());
  for (const Row& row : table.rows()) {
    if (!is_own(statement_of(row))) kept.append(row);
  }
  if (kept.rows().empty()) return;
  require_described(file);
  kept_[file] = std::move(kept);
}

bool KeptRows::is_own(const Statement& statement) const {
  if (!any_settings_) return own_.contains(statement);
  return std::ranges::any_of(
      own_, [&](const Statement& own) { return own.problem == statement.problem && own.library == statement.library; });
}

void KeptRows::require_described(const std::filesystem::path& file) const {
  const std::string source = prefix_.string() + ".json";
  const std::string name = file.filename().string();
  const JsonPlace earlier(earlier_, source);
  try {
    if (!earlier.has("statements")) throw Error("{} does not describe the runs that wrote {}", source, name);
    // A run that was interrupted has not described all of its tables.
    const bool is_described = earlier.has("tables") && earlier.at("tables").has(name);
    if (is_described || earlier.at("complete").boolean()) require_as_written(earlier_, source, name, read_file(file));
  } catch (const Error& error) {
    throw Error("{}; {} has rows of other problems: move both files away, or choose another --out", error.what(),
                file.string());
  }
}

void KeptRows::require_columns(const std::filesystem::path& file, const std::vector<std::string>& columns) const {
  std::error_code none;  // a missing file is not a regular file
  if (!std::filesystem::is_regular_file(file, none) || std::filesystem::is_empty(file)) return;
  if (read_table(file).columns() == columns) return;
  throw Error("{} has columns that differ from this run's; move it away, or choose another --name or --out",
              file.string());
}

void KeptRows::require_no_other_motion(const std::filesystem::path& file) const {
  std::error_code none;  // a missing file is not a regular file
  const JsonPlace earlier(earlier_, prefix_.string() + ".json");
  if (!std::filesystem::is_regular_file(file, none) || !earlier.has("motions")) return;
  for (const JsonPlace& motion : earlier.at("motions").entries()) {
    if (motion.at("nodes").text() != file.filename()) continue;
    const Statement other{motion.at("problem").text(), motion.has("library") ? motion.at("library").text() : "",
                          motion.has("settings") ? motion.at("settings").text() : ""};
    if (is_own(other)) continue;
    throw Error("{} is the trajectory of {}{}{}; choose another --name or --out", file.string(), other.problem,
                other.settings.empty() ? "" : " ", other.settings);
  }
}

std::size_t KeptRows::count(const std::filesystem::path& file) const {
  const auto found = kept_.find(file);
  return found == kept_.end() ? 0 : found->second.rows().size();
}

Table KeptRows::joined(const std::filesystem::path& file, const Table& own) const {
  const auto found = kept_.find(file);
  if (found == kept_.end() || found->second.columns() != own.columns()) return own;
  Table result = own;
  result.clear();
  for (const Row& row : found->second.rows()) result.append(row);
  for (const Row& row : own.rows()) result.append(row);
  return result;
}

void KeptRows::reduce(const std::filesystem::path& file) const {
  const auto found = kept_.find(file);
  if (found != kept_.end()) return write_file(file, found->second.csv());
  std::error_code none;  // it need not exist
  std::filesystem::remove(file, none);
}

Json KeptRows::kept_runs() const {
  Json kept = Json::array();
  if (kept_.empty()) return kept;
  const JsonPlace earlier(earlier_, prefix_.string() + ".json");
  Json runs = Json::array();
  if (earlier.has("earlier_runs")) {
    for (const JsonPlace& run : earlier.at("earlier_runs").entries()) runs.push_back(run.json());
  }
  runs.push_back(entry_of(earlier_));
  for (Json& run : runs) {
    std::set<Statement> statements = statements_in(JsonPlace(run, prefix_.string() + ".json"));
    std::erase_if(statements, [this](const Statement& statement) { return is_own(statement); });
    if (statements.empty()) continue;
    run["statements"] = in_json(statements);
    kept.push_back(run);
  }
  return kept;
}

void KeptRows::describe_runs(Json& metadata) const {
  metadata["statements"] = in_json(own_);
  if (Json runs = kept_runs(); !runs.empty()) metadata["earlier_runs"] = std::move(runs);
}

void KeptRows::describe_end(bool is_complete, Json& metadata) const {
  metadata["run_complete"] = is_complete;
  metadata["complete"] = is_complete && std::ranges::all_of(kept_runs(), [this](const Json& run) {
                           return JsonPlace(run, prefix_.string() + ".json").at("complete").boolean();
                         });
}

void KeptRows::describe_files(const std::vector<std::filesystem::path>& own, Json& metadata) const {
  const JsonPlace earlier(earlier_, prefix_.string() + ".json");
  const auto is_kept = [&](const std::string& name) {
    std::error_code none;  // a name that cannot be looked up is not there
    const auto is_name = [&](const std::filesystem::path& file) { return file.filename() == name; };
    return std::ranges::none_of(own, is_name) &&
           std::filesystem::exists(prefix_.parent_path() / std::filesystem::path(name).filename(), none);
  };
  if (earlier.has("tables")) {
    for (const auto& [name, table] : earlier.at("tables").members()) {
      if (is_kept(name)) metadata["tables"][name] = table.json();
    }
  }
  if (!earlier.has("motions")) return;
  for (const JsonPlace& motion : earlier.at("motions").entries()) {
    if (is_kept(motion.at("nodes").text())) metadata["motions"].push_back(motion.json());
  }
}

}  // namespace dmocbench
