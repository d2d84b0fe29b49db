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

std::vector<std::string> parse(CommandLine& line, std::filesystem::path& out) {
  line.option("--out", out, "folder for the results");
  std::vector<std::string> command_line = line.parse();
  listen_for_interrupt();  // what the folder is made of goes when the run ends
  return command_line;
}

}  // namespace

void write_tables(const std::vector<TableFile>& tables, const std::filesystem::path& metadata_file,
                  const std::vector<std::string>& command_line) {
  nlohmann::ordered_json metadata = describe_run(command_line);
  const auto write_as = [&](bool is_complete) {
    metadata["complete"] = is_complete;
    write_metadata(metadata_file, metadata);
  };
  write_as(false);
  std::vector<std::filesystem::path> files;
  for (const TableFile& table : tables) write_file(files.emplace_back(table.file), table.table.csv());
  for (const TableFile& table : tables) add_meanings(metadata, table.file, table.table);
  describe_tables_of_run(files, tables.empty() ? Table() : tables.front().table, metadata);
  write_as(true);
}

TableRun::TableRun(std::string name, CommandLine& line)
    : name_(std::move(name)),
      command_line_(parse(line, out_)),
      folder_(out_),
      lock_(out_ / name_),
      scope_(interrupt_requested, 0.0) {
  require_writable(out_ / (name_ + ".json"));
}

SolverOptions TableRun::solver_options() {
  SolverOptions options;
  options.stop_requested = interrupt_requested;
  return options;
}

void TableRun::show(const std::string& activity) const {
  throw_if_interrupted();
  progress_.show(activity);
}

void TableRun::add(const std::string& file, const Table& table, std::ptrdiff_t not_measured) {
  const std::string gaps = not_measured > 0 ? fmt::format(", {} not measured", not_measured) : "";
  tables_.push_back({out_ / (file + ".csv"), table});
  rows_of_tables_.push_back(counted(table.rows().size(), "row") + gaps);
  not_measured_ += not_measured;
}

int TableRun::write() const {
  throw_if_interrupted();
  write_tables(tables_, out_ / (name_ + ".json"), command_line_);
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    fmt::print("{}: {}: {}\n", name_, rows_of_tables_[i], tables_[i].file.string());
  }
  return not_measured_ > 0 ? 1 : 0;
}

}  // namespace dmocbench
