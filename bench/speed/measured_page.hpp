#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/experiment/command_line.hpp"
#include "bench/summary/ratio_interval.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench::speed {

/// The head of a generated page: its title, the command, and commit, compiler, flags and processor of this run. Where
/// other work kept the machine busy, it says that the times are upper bounds.
[[nodiscard]] std::string page_head(const std::string& title, const std::vector<std::string>& command_line);

/// These columns of the rows as a Markdown table: numbers with three digits, or all that a column is asked for.
struct PageColumn {
  std::string column;
  std::string title;
  int digits = 3;
};
[[nodiscard]] std::string page_table(const std::vector<Row>& rows, const std::vector<PageColumn>& columns);

/// Writes a page whole and prints where it is. Throws `Error` if it cannot be written.
void write_page(const std::filesystem::path& file, const std::string& page);

/// A program that writes such a page, as `run_program`; `run` is given the command line as it was typed, too.
[[nodiscard]] int run_page_program(
    const std::string& name, const std::string& description, int argc, char** argv,
    const std::function<int(CommandLine& line, const std::vector<std::string>& command)>& run);

/// Sets COLUMN, COLUMN_lower and COLUMN_upper: the median of what was measured round by round, with its 99 % interval
/// (bootstrap). Throws `Error` as `ratio_interval` does.
void set_median(Row& row, const std::string& column, std::span<const double> of_rounds);

/// Whether a time stays below a target: "below", "above", "undecided", or why nothing is said. A busy machine shows
/// upper bounds, which say nothing against the program.
[[nodiscard]] std::string verdict_on_target(const RatioInterval& time, double target);

/// Whether other programs wanted a processor when this was first asked, which a program does before it measures.
[[nodiscard]] bool is_busy();

}  // namespace dmocbench::speed
