// What interior_point solves of the library beside Ipopt and beside an earlier build, as a page for readers.
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/run/command_line.hpp"
#include "bench/speed/measured_page.hpp"
#include "bench/tables/paired_solves.hpp"
#include "methods/error.hpp"
#include "methods/numerics/quantile.hpp"
#include "methods/tables/table_file.hpp"

namespace dmocbench::speed {

namespace {

constexpr const char* ours = "interior_point";
constexpr const char* other = "ipopt";
constexpr double bearable = 1.5;  // iterations of ours over those of Ipopt

const ColumnNames columns_of_cell{"problem", "method", "stages", "intervals"};
const ColumnNames columns_of_start{"problem", "method", "stages", "intervals", "start"};

/// Iterations, or how a solve failed.
std::string outcome(const Row& row) {
  const std::string& status = row.text("status");
  if (status.empty()) return "-";
  if (status == "solved") return row.text("major_iterations");
  return fmt::format("{} ({})", status, row.text("major_iterations"));
}

std::string described(const Row& row, const ColumnNames& columns) {
  const auto text = [&](const std::string& column) {
    if (column == "stages") return "s = " + row.text(column);
    if (column == "intervals") return "N = " + row.text(column);
    return column == "start" ? "start " + row.text(column) : row.text(column);
  };
  std::vector<std::string> words;
  for (const std::string& column : columns) words.push_back(text(column));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string lost_list(const std::vector<SolvePair>& pairs, const ColumnNames& columns, const std::string& first,
                      const std::string& second) {
  const std::vector<SolvePair> lost = lost_by_first(pairs);
  if (lost.empty()) return fmt::format("None of {}.\n\n", pairs.size());
  std::string text = fmt::format("{} of {}:\n\n", lost.size(), pairs.size());
  for (const SolvePair& pair : lost) {
    text += fmt::format("- {}: {} {}, {} {}\n", described(pair.first, columns), first, outcome(pair.first), second,
                        outcome(pair.second));
  }
  return text + "\n";
}

std::string iterations_in_words(const std::vector<SolvePair>& pairs) {
  const std::vector<double> ratios = iteration_ratios(pairs);
  if (ratios.empty()) return "No program is solved by both.\n\n";
  const auto above = std::ranges::count_if(ratios, [](double ratio) { return ratio > bearable; });
  const auto at = [&](double share) { return quantile(ratios, share).value_or(ratios.back()); };
  return fmt::format(
      "Iterations of interior_point over those of Ipopt, of the {} that both solve: median {:.3g}, quartiles {:.3g} "
      "and {:.3g}, largest {:.3g}; above {} in {:.1f} %.\n\n",
      ratios.size(), at(0.5), at(0.25), at(0.75), ratios.back(), bearable,
      100.0 * static_cast<double>(above) / static_cast<double>(ratios.size()));
}

std::string solved_of(const Selection& rows) {
  return rows.empty() ? "-" : fmt::format("{} of {}", rows.where(solves_program).size(), rows.size());
}

/// What became of cells that were solved before. Earlier builds did not ask whether an answer is settled.
std::string lost_since(const std::vector<SolvePair>& pairs) {
  const auto unsettled = std::ranges::count_if(lost_by_first(pairs), [](const SolvePair& pair) {
    const Row& now = pair.first;
    return now.text("status") == "not confirmed" && now.needed("kkt_residual") <= now.needed("tolerance");
  });
  std::string text = lost_list(pairs, columns_of_cell, "now", "before");
  if (unsettled > 0) {
    text += fmt::format(
        "Of these, {} have a KKT residual within the tolerance as before and are \"not confirmed\" because a Newton "
        "step would still move the answer, which earlier builds did not ask.\n\n",
        unsettled);
  }
  return text;
}

/// How many cells each solves, by number of intervals and stages.
std::string totals(const Selection& now, const Selection& ipopt, const Selection& before) {
  std::vector<Row> rows;
  for (const Selection& cells : now.group_by({"intervals", "stages"})) {
    const ColumnNames columns{"intervals", "stages"};
    Row row = fields_of(cells.front(), columns);
    row.set("now", solved_of(cells));
    row.set("ipopt", solved_of(ipopt.matching(row, columns)));
    row.set("before", solved_of(before.matching(row, columns)));
    rows.push_back(std::move(row));
  }
  return page_table(rows,
                    {{"intervals", "N", 9}, {"stages", "s"}, {"now", ours}, {"ipopt", "Ipopt"}, {"before", "before"}});
}

/// Iterations or statuses of every cell of one number of intervals.
std::string cells_table(const Selection& now, const Selection& ipopt, const Selection& before) {
  std::vector<Row> rows;
  for (const Selection& cells : now.group_by({"problem", "method"})) {
    Row row = fields_of(cells.front(), {"problem", "method"});
    for (const Row& cell : cells) {
      const std::string& stages = cell.text("stages");
      row.set("before " + stages, outcome(before.matching(cell, columns_of_cell).front()));
      row.set("now " + stages, outcome(cell));
      row.set("ipopt " + stages, outcome(ipopt.matching(cell, columns_of_cell).front()));
    }
    rows.push_back(std::move(row));
  }
  std::vector<PageColumn> columns{{"problem", "problem"}, {"method", "method"}};
  for (const std::string& stages : now.distinct("stages")) {
    for (const auto& [name, title] : {std::pair{"before ", "before"}, {"now ", "now"}, {"ipopt ", "Ipopt"}}) {
      columns.push_back({name + stages, fmt::format("s = {}: {}", stages, title), 9});
    }
  }
  return page_table(rows, columns);
}

std::string verdict_on(const ShareInterval& difference) {
  if (difference.lower > 0.0) return "more";
  return difference.upper < 0.0 ? "fewer" : "not apart";
}

Row row_of_starts(const std::string& name, const std::vector<SolvePair>& pairs) {
  const PairedCount count = count_of(pairs);
  const ShareInterval interval = paired_difference_interval(count);
  const std::vector<double> ratios = iteration_ratios(pairs);
  Row row;
  row.set("problem", name);
  row.set("starts", count.trials());
  row.set("ours", count.first().hits);
  row.set("ipopt", count.second().hits);
  row.set("ours_only", count.first_only);
  row.set("ipopt_only", count.second_only);
  row.set("difference", count.first().share() - count.second().share());
  row.set("lower", interval.lower);
  row.set("upper", interval.upper);
  row.set("verdict", verdict_on(interval));
  row.set("iterations", quantile(ratios, 0.5));
  return row;
}

std::string starts_section(const Selection& starts) {
  const Selection of_ours = starts.where("solver", ours);
  const Selection of_other = starts.where("solver", other);
  std::vector<Row> rows;
  for (const Selection& problem : of_ours.group_by({"problem"})) {
    const auto pairs = paired_solves(problem, of_other, columns_of_start);
    if (!pairs.empty()) rows.push_back(row_of_starts(problem.front().text("problem"), pairs));
  }
  const auto all = paired_solves(of_ours, of_other, columns_of_start);
  if (all.empty()) throw Error("--starts: no start was given to both interior_point and ipopt");
  rows.push_back(row_of_starts("all", all));
  std::string text =
      "## From cold starts\n\nBoth from the same starts, which `cold_start --seed 1` draws (start 0 is the problem's "
      "guess). Difference of the shares, interior_point less Ipopt, with the 95 % interval for paired data (Newcombe "
      "1998, method 10), which takes starts as independent; iterations: median of the ratio where both solve.\n\n";
  text += page_table(rows, {{"problem", "problem"},
                            {"starts", "starts", 9},
                            {"ours", ours, 9},
                            {"ipopt", "Ipopt", 9},
                            {"ours_only", "interior_point alone", 9},
                            {"ipopt_only", "Ipopt alone", 9},
                            {"difference", "difference", 2},
                            {"lower", "from", 2},
                            {"upper", "to", 2},
                            {"verdict", "interior_point solves"},
                            {"iterations", "iterations"}});
  text += iterations_in_words(all);
  text += fmt::format(
      "At the limit of time ended {} starts by interior_point and {} by Ipopt: on a busy machine they might have been "
      "solved.\n\n",
      of_ours.where("status", "time limit").size(), of_other.where("status", "time limit").size());
  text += "Starts that Ipopt solves and interior_point does not: " + lost_list(all, columns_of_start, ours, "Ipopt");
  return text;
}

/// A table whose rows know their places, for errors.
Table placed_table(const std::filesystem::path& file) {
  Table table = read_table(file);
  table.name_places(file.filename().string());
  return table;
}

int write_robustness(CommandLine& line, const std::vector<std::string>& command) {
  std::filesystem::path solves;
  std::filesystem::path earlier;
  std::filesystem::path starts;
  std::filesystem::path out = "results/robustness.md";
  line.option("--solves", solves, "table of `profile` with both solvers");
  line.option("--before", earlier, "the same by an earlier build, of interior_point alone; may be left out");
  line.option("--starts", starts, "table of `cold_start` with both solvers; may be left out");
  line.option("--out", out, "the page");
  line.parse();
  if (solves.empty()) throw Error("--solves: name the table of `profile` that the page is made of");
  static_cast<void>(is_busy());
  const Table table = placed_table(solves);
  const Table before = earlier.empty() ? Table() : placed_table(earlier);
  const Selection now = Selection(table).where("solver", ours);
  const Selection ipopt = Selection(table).where("solver", other);
  const Selection then = Selection(before).where("solver", ours);

  std::string page =
      "Every problem from its own guess by every method with Gauss of s stages on N intervals, tolerance 1e-8, 500 "
      "iterations at most; `bench/speed/robustness` runs it. Numbers are iterations; in words how a solve failed. An "
      "answer that is \"too coarse\" is a solved program whose grid is too coarse for a motion: it counts as solved. "
      "\"before\" is an earlier build of interior_point; - where it does not know the problem.\n\n"
      "## How many are solved\n\n";
  page += totals(now, ipopt, then);
  const auto beside_ipopt = paired_solves(now, ipopt, columns_of_cell);
  page += "Cells that Ipopt solves and interior_point does not: ";
  page += lost_list(beside_ipopt, columns_of_cell, ours, "Ipopt");
  page += "Cells that interior_point alone solves: ";
  page += lost_list(paired_solves(ipopt, now, columns_of_cell), columns_of_cell, "Ipopt", ours);
  page += "Cells that interior_point solved before and does not now: ";
  page += lost_since(paired_solves(now, then, columns_of_cell));
  page += iterations_in_words(beside_ipopt);
  if (!starts.empty()) page += starts_section(placed_table(starts));
  for (const Selection& cells : now.group_by({"intervals"})) {
    page += fmt::format("## N = {}\n\n", cells.front().text("intervals"));
    page += cells_table(cells, ipopt, then);
  }
  write_page(out, {"Robustness of interior_point over the library", page, {}}, command);
  return 0;
}

}  // namespace

}  // namespace dmocbench::speed

int main(int argc, char** argv) {
  return dmocbench::run_program("robustness_page",
                                "What interior_point solves of the library beside Ipopt, as a page for readers.", argc,
                                argv, [&](dmocbench::CommandLine& line) {
                                  return dmocbench::speed::write_robustness(line, {argv, argv + argc});
                                });
}
