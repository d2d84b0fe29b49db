#include "bench/run/table_run.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/meanings.hpp"
#include "bench/run/metadata.hpp"
#include "bench/run/process_pool.hpp"
#include "bench/run/run_identity.hpp"
#include "bench/run/written_tables.hpp"
#include "methods/runtime/counted.hpp"

namespace dmocbench {

namespace {

std::vector<std::string> parse(CommandLine& line, std::filesystem::path& out, Findings& findings, bool* fresh) {
  line.group(group_of_output);
  line.option("--out", out, "folder for the results", OptionRole::place);
  findings.add_to(line);
  if (fresh != nullptr) {
    line.flag("--fresh", *fresh, "measure everything instead of resuming an interrupted run", OptionRole::machine);
  }
  std::vector<std::string> command_line = line.parse();
  listen_for_interrupt();  // created folders are removed when the run ends
  return command_line;
}

/// Writes tables, and next to them the metadata of their run with the JSON Schema of their rows. Columns that a table
/// leaves unexplained have the meanings of the first table. Rows kept from earlier runs precede the others. The
/// metadata contain `"complete": false` until all tables are there.
/// Throws `Error` if a file cannot be written.
void write_tables(const std::vector<TableFile>& tables, const std::filesystem::path& metadata_file,
                  const std::vector<std::string>& command_line, const KeptRows& kept) {
  nlohmann::ordered_json metadata = describe_run(command_line);
  kept.describe_runs(metadata);
  std::vector<std::filesystem::path> files;
  std::set<std::string> names;
  for (const TableFile& table : tables) names.insert(files.emplace_back(table.file).filename().string());
  const auto write_as = [&](bool is_complete) {
    nlohmann::ordered_json described = metadata;
    kept.describe_end(is_complete, described);
    kept.describe_files(names, described);
    write_metadata(metadata_file, described);
  };
  write_as(false);
  for (const TableFile& table : tables) write_file(table.file, kept.joined(table.file, table.table).csv());
  for (const TableFile& table : tables) add_meanings(metadata, table.file, table.table);
  describe_tables_of_run(files, tables.empty() ? Table() : tables.front().table, metadata);
  write_as(true);
}

}  // namespace

TableRun::TableRun(std::string name, CommandLine& line, Resumes resumes)
    : name_(std::move(name)),
      command_line_(parse(line, out_, findings_, resumes == Resumes::yes ? &fresh_ : nullptr)),
      folder_(out_),
      lock_(out_ / name_),
      progress_(name_, findings_.are_quiet()),
      scope_(interrupt_requested, 0.0) {
  require_writable(out_ / (name_ + ".json"));
  if (resumes == Resumes::no) return;
  finished_ = {out_ / (name_ + ".unfinished"),
               identity_of(name_, describe_run(command_line_), line.values_for_results())};
  if (fresh_) return;
  tables_ = finished_.resume();
  if (finished_.count() > 0 && findings_.are_for_people()) {
    print_line(fmt::format("{}: resumes an interrupted run, which has finished {}; --fresh measures everything", name_,
                           counted(finished_.count(), "stage")));
  }
}

void TableRun::stage(const std::string& name, const std::function<void()>& measure) {
  if (finished_.contain(name)) return;
  try {
    measure();
  } catch (...) {
    if (interrupt_requested() && finished_.count() > 0 && findings_.are_for_people()) {
      print_line(fmt::format("{}: {} finished; the same command resumes it", name_,
                             counted(finished_.count(), "stage is", "stages are")));
    }
    throw;
  }
  finished_.add(name, tables_);
}

const Table& TableRun::table(const std::string& file) const {
  const auto found = std::ranges::find(tables_, out_ / (file + ".csv"), &TableFile::file);
  if (found == tables_.end()) throw Error(fmt::format("no stage of {} has made {}.csv", name_, file));
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
  const std::filesystem::path path = out_ / (file + ".csv");
  Table added = with_statements(table, statements_);
  const auto earlier = std::ranges::find(tables_, path, &TableFile::file);
  if (earlier == tables_.end()) {
    tables_.push_back({path, std::move(added), not_measured});
    return;
  }
  for (const Row& row : added.rows()) earlier->table.append(row);
  earlier->not_measured += not_measured;
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
  finished_.forget();
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  constexpr std::size_t few_tables = 4;
  const bool has_many = tables_.size() > few_tables;
  if (has_many && findings_.are_for_people())
    print_line(fmt::format("{}: {} tables: {}*.csv", name_, tables_.size(), (out_ / name_).string()));
  std::ptrdiff_t not_measured = 0;
  for (const TableFile& table : tables_) {
    not_measured += table.not_measured;
    files.push_back(table.file.string());
    const std::string gaps = table.not_measured > 0 ? fmt::format(", {} not measured", table.not_measured) : "";
    if (!has_many && findings_.are_for_people()) {
      print_line(
          fmt::format("{}: {}{}: {}", name_, counted(table.table.rows().size(), "row"), gaps, table.file.string()));
    }
  }
  const int code = not_measured > 0 ? 1 : 0;
  findings_.end({{"experiment", name_}, {"exit_code", code}, {"not_measured", not_measured}, {"files", files}});
  return code;
}

}  // namespace dmocbench
