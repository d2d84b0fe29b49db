#include "bench/speed/solve_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/compare/benchmark_file.hpp"
#include "methods/diagnostics/convergence_order.hpp"

namespace dmocbench::speed {

namespace {

constexpr double same_objective = 1e-9;
constexpr int coarsest_of_exponent = 1024;
constexpr int fewest_grids_of_exponent = 3;
constexpr const char* fast_solver = "interior_point";
constexpr const char* slow_solver = "ipopt";

const Solves* find(const SolvesByName& solves, const SolveName& name) {
  const auto found = solves.find(name);
  return found == solves.end() ? nullptr : &found->second;
}

SolveName by_solver(SolveName name, const std::string& solver) {
  name.solver = solver;
  return name;
}

SolveName by_two_threads(SolveName name) {
  name.threads = 2;
  return name;
}

double iterations_of(const Solves& solves) { return std::max(1.0, solves.iterations); }

double nanoseconds_per_interval(const SolveName& name, const Solves& solves) {
  constexpr double nanoseconds = 1e9;
  return nanoseconds * solves.median() / name.intervals / iterations_of(solves);
}

void set_what(Row& row, const SolveName& name) {
  row.set("problem", Cell(name.problem));
  row.set("method", Cell(name.method));
}

void set_how(Row& row, const SolveName& name) {
  row.set("solver", Cell(name.solver));
  row.set("threads", Cell(static_cast<long long>(name.threads)));
}

std::string verdict_of(const Solves& a, const Solves& b) {
  if (!a.is_solved || !b.is_solved) return "not both solved";
  return std::abs(a.objective - b.objective) <= same_objective * std::abs(b.objective) ? "same" : "other branch";
}

Row ratio_row(const SolveName& name, const std::string& quantity, const Solves& slow, const Solves& fast) {
  Row row;
  set_what(row, name);
  row.set("intervals", Cell(static_cast<long long>(name.intervals)));
  row.set("quantity", Cell(quantity));
  const std::string verdict = verdict_of(slow, fast);
  row.set("verdict", Cell(verdict));
  if (verdict == "same") {
    row.set("ratio", Cell(slow.median() / fast.median()));
    row.set("ratio_of_smallest", Cell(slow.smallest() / fast.smallest()));
  }
  return row;
}

std::string time_of(const Solves* solves) {
  if (solves == nullptr) return "-";
  return fmt::format("{:.3f} ({:.3f}) [{:.0f}]", 1e3 * solves->median(), 1e3 * solves->smallest(), solves->iterations);
}

/// The ratio, or why there is none.
std::string ratio_of(const Table& ratios, const SolveName& name, const std::string& quantity) {
  for (const Row& row : ratios.rows()) {
    if (row.text("problem") != name.problem || row.text("method") != name.method) continue;
    if (row.text("intervals") != std::to_string(name.intervals) || row.text("quantity") != quantity) continue;
    const auto ratio = row.number("ratio");
    if (!ratio) return row.text("verdict");
    return fmt::format("{:.{}f} ({:.{}f})", *ratio, quantity == "threads" ? 2 : 1,
                       row.number("ratio_of_smallest").value_or(0.0), quantity == "threads" ? 2 : 1);
  }
  return "-";
}

/// Without solver and threads, in the order of the names.
std::vector<SolveName> cases_of(const SolvesByName& solves) {
  std::vector<SolveName> cases;
  for (const auto& [name, unused] : solves) {
    SolveName what = name;
    what.solver.clear();
    what.threads = 1;
    if (cases.empty() || cases.back() != what) cases.push_back(what);
  }
  return cases;
}

/// `name` is that of a curve: without a number of intervals.
void append_exponent(Table& table, const SolveName& name, const std::vector<GridError>& points) {
  const auto line = fit_order(points);
  if (!line || line->points < fewest_grids_of_exponent) return;
  Row row;
  set_what(row, name);
  set_how(row, name);
  row.set("exponent", Cell(line->slope));
  row.set("standard_error", Cell(line->standard_error));
  row.set("grids", Cell(static_cast<long long>(line->points)));
  row.set("coarsest", Cell(static_cast<long long>(line->finest)));  // the smallest abscissa: here N instead of a step
  row.set("finest", Cell(static_cast<long long>(line->coarsest)));
  table.append(row);
}

std::string exponents_as_text(const Table& exponents) {
  if (exponents.rows().empty()) return "";
  std::string text = fmt::format("\nexponent of the time per iteration over N\n");
  for (const Row& row : exponents.rows()) {
    text += fmt::format("{:<62}{:>8.3f} ± {:.3f}, {} grids from {} to {}\n",
                        fmt::format("{} {} {}{}", row.text("problem"), row.text("method"), row.text("solver"),
                                    row.text("threads") == "1" ? "" : ", threads: " + row.text("threads")),
                        row.number("exponent").value_or(0.0), row.number("standard_error").value_or(0.0),
                        row.text("grids"), row.text("coarsest"), row.text("finest"));
  }
  return text;
}

}  // namespace

double Solves::median() const { return seconds.empty() ? 0.0 : median_of(seconds); }

double Solves::smallest() const { return seconds.empty() ? 0.0 : *std::min_element(seconds.begin(), seconds.end()); }

double Solves::setup() const { return setup_seconds.empty() ? 0.0 : median_of(setup_seconds); }

Table solve_rows(const SolvesByName& solves) {
  Table table({"problem", "method", "intervals", "solver", "threads", "repetitions", "seconds", "smallest_seconds",
               "iterations", "linear_systems", "solved", "objective", "ns_per_interval_iteration", "evaluation_share",
               "bytes_per_interval", "setup_seconds"});
  for (const auto& [name, of_name] : solves) {
    Row row;
    set_what(row, name);
    set_how(row, name);
    row.set("intervals", Cell(static_cast<long long>(name.intervals)));
    row.set("repetitions", Cell(static_cast<long long>(of_name.seconds.size())));
    row.set("seconds", Cell(of_name.median()));
    row.set("smallest_seconds", Cell(of_name.smallest()));
    row.set("iterations", Cell(of_name.iterations));
    row.set("linear_systems", of_name.linear_systems);
    row.set("solved", Cell(of_name.is_solved ? 1LL : 0LL));
    row.set("objective", Cell(of_name.objective));
    row.set("ns_per_interval_iteration", Cell(nanoseconds_per_interval(name, of_name)));
    row.set("evaluation_share", Cell(of_name.evaluation_share));
    row.set("bytes_per_interval", of_name.bytes_per_interval);
    row.set("setup_seconds", Cell(of_name.setup()));
    table.append(row);
  }
  return table;
}

Table solve_ratios(const SolvesByName& solves) {
  Table table({"problem", "method", "intervals", "quantity", "ratio", "ratio_of_smallest", "verdict"});
  for (const SolveName& what : cases_of(solves)) {
    const Solves* const fast = find(solves, by_solver(what, fast_solver));
    if (fast == nullptr) continue;
    const Solves* const slow = find(solves, by_solver(what, slow_solver));
    const Solves* const by_two = find(solves, by_two_threads(by_solver(what, fast_solver)));
    if (slow != nullptr) table.append(ratio_row(what, "solver", *slow, *fast));
    if (by_two != nullptr) table.append(ratio_row(what, "threads", *fast, *by_two));
  }
  return table;
}

Table solve_exponents(const SolvesByName& solves) {
  std::map<SolveName, std::vector<GridError>> curves;  // without the number of intervals
  for (const auto& [name, of_name] : solves) {
    if (name.intervals < coarsest_of_exponent || !of_name.is_solved) continue;
    SolveName curve = name;
    curve.intervals = 0;
    curves[curve].push_back({static_cast<double>(name.intervals), of_name.median() / iterations_of(of_name)});
  }
  Table table({"problem", "method", "solver", "threads", "exponent", "standard_error", "grids", "coarsest", "finest"});
  for (const auto& [name, points] : curves) append_exponent(table, name, points);
  return table;
}

std::string solve_summary(const SolvesByName& solves) {
  // One width per column, whatever its type.
  constexpr const char* line = "{:<46}{:>26}{:>28}{:>22}{:>17}{:>12}{:>18}{:>16}{:>13}\n";
  std::string text = "\nms per solve on one thread: median (smallest) of the repetitions, in brackets the iterations\n";
  text +=
      fmt::format(fmt::runtime(line), "", fast_solver, slow_solver, "ipopt/interior_point", "one/two threads",
                  "evaluation", "ns/(interval it)", "bytes/interval", "set-up [ms]");  // the last four: interior_point
  const Table ratios = solve_ratios(solves);
  for (const SolveName& what : cases_of(solves)) {
    const Solves* const fast = find(solves, by_solver(what, fast_solver));
    const Solves* const slow = find(solves, by_solver(what, slow_solver));
    const auto of_fast = [&](const char* format, double value) {
      return fast == nullptr ? "-" : fmt::format(fmt::runtime(format), value);
    };
    text += fmt::format(
        fmt::runtime(line), fmt::format("{} {} N = {}", what.problem, what.method, what.intervals), time_of(fast),
        time_of(slow), ratio_of(ratios, what, "solver"), ratio_of(ratios, what, "threads"),
        of_fast("{:.0f} %", fast == nullptr ? 0.0 : 100.0 * fast->evaluation_share),
        of_fast("{:.0f}", fast == nullptr ? 0.0 : nanoseconds_per_interval(what, *fast)),
        fast == nullptr || !fast->bytes_per_interval ? "-" : fmt::format("{:.0f}", *fast->bytes_per_interval),
        of_fast("{:.3f}", fast == nullptr ? 0.0 : 1e3 * fast->setup()));
  }
  return text + exponents_as_text(solve_exponents(solves));
}

}  // namespace dmocbench::speed
