#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bench/run/column.hpp"
#include "bench/run/command_line.hpp"
#include "bench/tables/ratio_interval.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench::speed {

/// These columns of the rows as a Markdown table: numbers with three digits, or all that a column is asked for.
struct PageColumn {
  std::string column;
  std::string title;
  int digits = 3;
};
[[nodiscard]] std::string page_table(const std::vector<Row>& rows, const std::vector<PageColumn>& columns);

/// What a program has measured: a page, and tables beside it.
struct MeasuredPage {
  std::string title;
  std::string text;                                   ///< behind the head
  std::vector<std::pair<std::string, Table>> tables;  ///< by the ends of their names
};

/// A program that measures in rounds and writes results/speed_NAME.md, a table speed_NAMEEND.csv for every end, and the
/// metadata of the tables, speed_NAME.json.
struct PageProgram {
  std::string name;
  std::string description;                         ///< a sentence
  std::vector<std::string> ends = {""};            ///< of the names of its tables
  std::string columns = {};                        ///< of its tables, for `--help`
  std::function<void(CommandLine&)> options = {};  ///< adds what it takes beside `--out` and `--rounds`
  std::function<MeasuredPage(int rounds)> measure;

  /// Returns the exit code, as `run_program`.
  [[nodiscard]] int run(int argc, char** argv) const;
};

/// The page as `PageProgram` writes it, by a program with other options. Prints where it is. Throws `Error` if it
/// cannot be written.
void write_page(const std::filesystem::path& file, const MeasuredPage& page, const std::vector<std::string>& command);

/// The columns NAME, NAME_lower and NAME_upper: the median of what was measured round by round, with its 99 % interval
/// (bootstrap). `rounds` is what `from` takes, and leads to the numbers of the rounds.
template <class Record, class... Members>
[[nodiscard]] Columns<Record> median_columns(const std::string& name, const std::string& unit,
                                             const std::string& meaning, Members... rounds) {
  const auto part = [=](auto of_median) {
    return from(rounds...,
                [of_median](const std::vector<double>& numbers) { return MedianOfRounds(numbers).*of_median; });
  };
  return {{name, unit, meaning + ", the median over the rounds", part(&MedianOfRounds::median)},
          {name + "_lower", unit, "of the interval of 99 % of this median", part(&MedianOfRounds::lower)},
          {name + "_upper", unit, "of the same interval", part(&MedianOfRounds::upper)}};
}

/// Whether other programs wanted a processor when this was first asked, which a program does before it measures.
[[nodiscard]] bool is_busy();

}  // namespace dmocbench::speed
