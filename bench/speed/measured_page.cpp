#include "bench/speed/measured_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/run/metadata.hpp"
#include "bench/run/result_file.hpp"
#include "bench/run/table_run.hpp"

namespace dmocbench::speed {

namespace {

/// How many programs wanted a processor in the minute before this was first called; 0 where the system does not tell.
double load_at_start() {
  static const double load = [] {
    double minute = 0.0;
    return ::getloadavg(&minute, 1) == 1 ? minute : 0.0;
  }();
  return load;
}

/// The title, the command, and commit, compiler, flags and processor of this run. Where other work kept the machine
/// busy, it says that the times are upper bounds.
std::string page_head(const std::string& title, const std::vector<std::string>& command_line) {
  const nlohmann::ordered_json run = describe_run(command_line);
  std::string head = fmt::format("# {}\n\nWritten by `{}`, on\n", title, fmt::join(command_line, " "));
  for (const char* key : {"utc_time", "commit", "compiler", "flags", "instruction_set", "processor"}) {
    head += fmt::format("- {} {}\n", key, run.at(key).get<std::string>());
  }
  head += fmt::format("- cores {}\n- load average at the start {:.1f}\n", run.at("cores").get<long>(), load_at_start());
  if (is_busy()) {
    head +=
        "\nOther work kept the machine busy: times are upper bounds, and ratios are those of this load, because a "
        "solve of a millisecond ends before it has to share its processor and a longer one does not. Nothing is "
        "judged.\n";
  }
  return head + "\n";
}

}  // namespace

bool is_busy() {
  constexpr double idle = 0.5;
  return load_at_start() > idle;
}

void write_page(const std::filesystem::path& file, const MeasuredPage& page, const std::vector<std::string>& command) {
  write_file(file, page_head(page.title, command) + page.text);
  fmt::print("{}\n", file.string());
}

int PageProgram::run(int argc, char** argv) const {
  return run_program(name, description, argc, argv, [&](CommandLine& line) {
    std::filesystem::path out = "results";
    int rounds = 11;
    const std::string prefix = "speed_" + name;
    line.option("--out", out,
                fmt::format("folder for {0}{1}.csv, {0}.json and {0}.md", prefix, fmt::join(ends, ".csv, " + prefix)));
    line.number("--rounds", rounds, 1, 1000, "how often everything is measured, in turn");
    if (options) options(line);
    if (!columns.empty()) line.footer("Columns of the tables:\n" + columns);
    line.parse();
    static_cast<void>(is_busy());
    const OutputFolder folder(out);
    const MeasuredPage page = measure(rounds);
    const std::vector<std::string> command(argv, argv + argc);
    std::vector<TableFile> tables;
    tables.reserve(page.tables.size());
    for (const auto& [end, table] : page.tables) tables.push_back({out / fmt::format("{}{}.csv", prefix, end), table});
    write_tables(tables, out / (prefix + ".json"), command);
    write_page(out / (prefix + ".md"), page, command);
    return 0;
  });
}

std::string page_table(const std::vector<Row>& rows, const std::vector<PageColumn>& columns) {
  std::string header = "|";
  std::string line = "|";
  for (const PageColumn& column : columns) {
    header += fmt::format(" {} |", column.title);
    line += "---|";
  }
  std::string text = header + "\n" + line + "\n";
  for (const Row& row : rows) {
    text += "|";
    for (const PageColumn& column : columns) {
      const auto number = row.number(column.column);
      text +=
          number ? fmt::format(" {:.{}g} |", *number, column.digits) : fmt::format(" {} |", row.text(column.column));
    }
    text += "\n";
  }
  return text + "\n";
}

}  // namespace dmocbench::speed
