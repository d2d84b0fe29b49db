#include "bench/run/table_run.hpp"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/meanings.hpp"
#include "bench/run/metadata.hpp"
#include "bench/run/process_pool.hpp"
#include "bench/run/written_tables.hpp"
#include "methods/runtime/counted.hpp"

namespace dmocbench {

namespace {

std::vector<std::string> parse(CommandLine& line, std::filesystem::path& out, Findings& findings) {
  line.group(group_of_output);
  line.option("--out", out, "folder for the results");
  findings.add_to(line);
  std::vector<std::string> command_line = line.parse();
  listen_for_interrupt();  // created folders are removed when the run ends
  return command_line;
}

}  // namespace

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

TableRun::TableRun(std::string name, CommandLine& line)
    : name_(std::move(name)),
      command_line_(parse(line, out_, findings_)),
      folder_(out_),
      lock_(out_ / name_),
      progress_(name_, findings_.are_quiet()),
      scope_(interrupt_requested, 0.0) {
  require_writable(out_ / (name_ + ".json"));
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
  const std::string gaps = not_measured > 0 ? fmt::format(", {} not measured", not_measured) : "";
  tables_.push_back({out_ / (file + ".csv"), with_statements(table, statements_)});
  rows_of_tables_.push_back(counted(table.rows().size(), "row") + gaps);
  not_measured_ += not_measured;
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
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  constexpr std::size_t few_tables = 4;
  const bool has_many = tables_.size() > few_tables;
  if (has_many && findings_.are_for_people())
    print_line(fmt::format("{}: {} tables: {}*.csv", name_, tables_.size(), (out_ / name_).string()));
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    files.push_back(tables_[i].file.string());
    if (!has_many && findings_.are_for_people())
      print_line(fmt::format("{}: {}: {}", name_, rows_of_tables_[i], tables_[i].file.string()));
  }
  const int code = not_measured_ > 0 ? 1 : 0;
  findings_.end({{"experiment", name_}, {"exit_code", code}, {"not_measured", not_measured_}, {"files", files}});
  return code;
}

}  // namespace dmocbench
