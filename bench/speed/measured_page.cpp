#include "bench/speed/measured_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/experiment/metadata.hpp"
#include "bench/experiment/result_file.hpp"

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

}  // namespace

bool is_busy() {
  constexpr double idle = 0.5;
  return load_at_start() > idle;
}

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
        "solve of a millisecond ends before it has to share its processor and a longer one does not. Nothing is judged "
        "but that a time is below a target.\n";
  }
  return head + "\n";
}

void write_page(const std::filesystem::path& file, const std::string& page) {
  write_file(file, page);
  fmt::print("{}\n", file.string());
}

int run_page_program(const std::string& name, const std::string& description, int argc, char** argv,
                     const std::function<int(CommandLine& line, const std::vector<std::string>& command)>& run) {
  const std::vector<std::string> command(argv, argv + argc);
  return run_program(name, description, argc, argv, [&](CommandLine& line) { return run(line, command); });
}

void set_median(Row& row, const std::string& column, std::span<const double> of_rounds) {
  const RatioInterval interval = ratio_interval(of_rounds);
  row.set(column, interval.ratio);
  row.set(column + "_lower", interval.lower);
  row.set(column + "_upper", interval.upper);
}

std::string verdict_on_target(const RatioInterval& time, double target) {
  if (time.rounds < fewest_rounds) return "too few rounds";
  if (time.upper <= target) return "below";
  if (is_busy()) return "not judged on a busy machine";
  return time.lower > target ? "above" : "undecided";
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
