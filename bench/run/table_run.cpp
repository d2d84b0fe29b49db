#include "bench/run/table_run.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/described_tables.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/json_place.hpp"
#include "bench/run/metadata.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> parse(CommandLine& line, std::filesystem::path& out, RunSummary& summary, bool* fresh) {
  line.group(group_of_output);
  line.option("--out", out, "folder for the results", OptionRole::place);
  summary.add_to(line);
  if (fresh != nullptr) {
    line.flag("--fresh", *fresh, "measure everything instead of resuming an interrupted run", OptionRole::machine);
  }
  std::vector<std::string> command_line = line.parse();
  listen_for_interrupt();  // created folders are removed when the run ends
  return command_line;
}

/// Writes tables, and next to them the metadata of their run with the JSON Schema of their rows. Columns that a table
/// leaves unexplained are as in the first table. Rows kept from earlier runs precede the others. The
/// metadata contain `"complete": false` until all tables are there.
/// Throws `Error` if a file cannot be written.
void write_tables(const std::vector<TableFile>& tables, const std::filesystem::path& metadata_file,
                  const std::vector<std::string>& command_line, const KeptRows& kept) {
  nlohmann::ordered_json metadata = describe_run(command_line);
  kept.describe_runs(metadata);
  std::vector<std::filesystem::path> files;
  for (const TableFile& table : tables) files.push_back(table.file);
  const auto write_as = [&](bool is_complete) {
    nlohmann::ordered_json described = metadata;
    kept.describe_end(is_complete, described);
    kept.describe_files(files, described);
    write_metadata(metadata_file, described);
  };
  write_as(false);
  for (const TableFile& table : tables) write_file(table.file, kept.joined(table.file, table.table).csv());
  for (const TableFile& table : tables) note_table(table.file, table.table, metadata);
  describe_tables_of_run(files, tables.empty() ? Table() : tables.front().table, metadata);
  write_as(true);
}

}  // namespace

Json entry_of_stage(const std::string& stage, const std::vector<TableFile>& added) {
  Json tables = Json::array();
  for (const TableFile& one : added) {
    Json facts = Json::object();
    for (const auto& [column, of] : one.table.facts()) {
      facts[column] = {{"unit", of.unit},
                       {"meaning", of.meaning},
                       {"kind", static_cast<unsigned>(of.type.kind)},
                       {"may_be_empty", of.type.may_be_empty}};
    }
    tables.push_back({{"name", one.file.stem().string()},
                      {"csv", one.table.csv()},
                      {"facts", std::move(facts)},
                      {"key", one.table.key()},
                      {"not_measured", one.not_measured}});
  }
  return {{"stage", stage}, {"tables", std::move(tables)}};
}

std::vector<TableFile> tables_of_stage(const Json& entry, const std::filesystem::path& store) {
  std::vector<TableFile> tables;
  const JsonPlace place(entry, store.string());
  static_cast<void>(place.at("stage").text());
  for (const JsonPlace& json : place.at("tables").entries()) {
    const std::string name = json.at("name").text();
    if (!name.starts_with(store.stem().string()) || name.find('/') != std::string::npos) {
      throw Error("{} names the table \"{}\", which this run does not write; remove the file", store.string(), name);
    }
    TableFile& one = tables.emplace_back(TableFile{.file = store.parent_path() / (name + ".csv"),
                                                   .table = Table::from_csv(json.at("csv").text()),
                                                   .not_measured = json.at("not_measured").count()});
    for (const auto& [column, of] : json.at("facts").members()) {
      const FieldType type{static_cast<FieldKind>(of.at("kind").count()), of.at("may_be_empty").boolean()};
      one.table.describe({{column, {of.at("unit").text(), of.at("meaning").text(), type}}});
    }
    one.table.set_key(json.at("key").texts());
  }
  return tables;
}

TableRun::TableRun(std::string name, CommandLine& line, Resumes resumes)
    : name_(std::move(name)),
      command_line_(parse(line, out_, summary_, resumes == Resumes::yes ? &fresh_ : nullptr)),
      folder_(out_),
      lock_(out_ / name_),
      progress_(name_, summary_.are_quiet()),
      scope_(interrupt_requested, 0.0) {
  require_writable(out_ / (name_ + ".json"));
  if (resumes == Resumes::no) return;
  const Json metadata = describe_run(command_line_);
  store_ = {out_ / (name_ + ".rows"),
            header_of_store(identity_of(name_, metadata, line.values_for_results()), metadata)};
  if (!fresh_) resume();
}

void TableRun::resume() {
  for (const Json& entry : store_.resume()) {
    for (TableFile& table : tables_of_stage(entry, store_.file())) take(std::move(table));
    stages_.insert(entry.at("stage"));
    store_.keep(entry);
  }
  if (!stages_.empty() && summary_.are_for_people()) {
    print_line(fmt::format("{}: resuming an interrupted run with {} finished; use --fresh to measure everything again",
                           name_, counted(stages_.size(), "stage")));
  }
}

void TableRun::stage(const std::string& name, const std::function<void()>& measure) {
  if (stages_.contains(name)) return;
  added_.clear();
  try {
    measure();
  } catch (...) {
    if (interrupt_requested() && !stages_.empty() && summary_.are_for_people()) {
      print_line(fmt::format("{}: {} finished; the same command resumes it", name_,
                             counted(stages_.size(), "stage is", "stages are")));
    }
    throw;
  }
  stages_.insert(name);
  store_.append(entry_of_stage(name, added_));
  store_.sync();
}

const Table& TableRun::table(const std::string& file) const {
  const auto found = std::ranges::find(tables_, out_ / (file + ".csv"), &TableFile::file);
  if (found == tables_.end()) throw Error("no stage of {} has written {}.csv", name_, file);
  return found->table;
}

SolverOptions TableRun::solver_options() {
  SolverOptions options;
  options.stop_requested = interrupt_requested;
  return options;
}

std::vector<std::shared_ptr<const Problem>> TableRun::selected(const ProblemOptions& asked) {
  std::vector<std::shared_ptr<const Problem>> problems = asked.selected();
  for (const auto& problem : problems) statements_.insert(statement_of(*problem));
  return problems;
}

void TableRun::show(const std::string& activity) const {
  throw_if_interrupted();
  progress_.show(activity);
}

void TableRun::add(const std::string& file, const Table& table, std::ptrdiff_t not_measured) {
  added_.push_back({out_ / (file + ".csv"), with_statements(table, statements_), not_measured});
  take(added_.back());
}

void TableRun::take(TableFile added) {
  const auto earlier = std::ranges::find(tables_, added.file, &TableFile::file);
  if (earlier == tables_.end()) return tables_.push_back(std::move(added));
  for (const Row& row : added.table.rows()) earlier->table.append(row);
  earlier->not_measured += added.not_measured;
}

int TableRun::write() const {
  throw_if_interrupted();
  std::set<Statement> own = statements_;
  for (const TableFile& table : tables_) {
    for (const Row& row : table.table.rows())
      own.insert({row.text("problem"), row.text("library"), row.text("settings")});
  }
  KeptRows kept(out_ / name_, std::move(own));
  for (const TableFile& table : tables_) kept.read(table.file);
  write_tables(tables_, out_ / (name_ + ".json"), command_line_, kept);
  store_.remove();
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  constexpr std::size_t few_tables = 4;
  const bool has_many = tables_.size() > few_tables;
  if (has_many && summary_.are_for_people())
    print_line(fmt::format("{}: {} tables: {}*.csv", name_, tables_.size(), (out_ / name_).string()));
  std::ptrdiff_t not_measured = 0;
  for (const TableFile& table : tables_) {
    not_measured += table.not_measured;
    files.push_back(table.file.string());
    const std::string gaps = table.not_measured > 0 ? fmt::format(", {} not measured", table.not_measured) : "";
    if (!has_many && summary_.are_for_people()) {
      print_line(
          fmt::format("{}: {}{}: {}", name_, counted(table.table.rows().size(), "row"), gaps, table.file.string()));
    }
  }
  const int code = not_measured > 0 ? 1 : 0;
  summary_.end({{"experiment", name_}, {"exit_code", code}, {"not_measured", not_measured}, {"files", files}});
  return code;
}

}  // namespace dmocbench
