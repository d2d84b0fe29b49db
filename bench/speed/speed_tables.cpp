#include "bench/speed/speed_tables.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>
#include <string>
#include <tuple>
#include <vector>

#include "bench/tables/selection.hpp"
#include "methods/diagnostics/convergence_order.hpp"
#include "methods/runtime/parsed.hpp"

namespace dmocbench::speed {

namespace {

constexpr double nanoseconds = 1e9;  // of a second
constexpr double second = 1e-9;      // of a nanosecond

double number_in_label(const Benchmark& benchmark, const std::string& key, double missing) {
  return parsed<double>(benchmark.label(key)).value_or(missing);
}

/// Operations or bytes per second, of a benchmark of the machine.
std::optional<double> rate_of(const Benchmark& benchmark) {
  const auto operations = benchmark.median_of(operations_per_second);
  return operations ? operations : benchmark.median_of(bytes_per_second);
}

std::vector<Benchmark> of_the_machine(const Benchmarks& benchmarks) {
  std::vector<Benchmark> machine = without_names(benchmarks);
  std::erase_if(machine, [](const Benchmark& benchmark) { return !rate_of(benchmark); });
  return machine;
}

/// The least time of an evaluation on this machine.
struct Roof {
  double nanoseconds = 0.0;
  std::string limit;
};

/// An evaluation of an interval.
struct Evaluation : Benchmark {
  double time = 0.0;                        ///< nanoseconds
  std::optional<Roof> roof = std::nullopt;  ///< empty if a required benchmark did not run

  Evaluation(const Benchmark& benchmark, const std::vector<Benchmark>& machine)
      : Benchmark(benchmark), time(median_of(ns_per_interval).value_or(0.0)) {
    const std::optional<double> moved = bytes();
    if (!moved) return;
    const double working_set = *moved * number_in_label(*this, "intervals", 0.0);
    const auto time_at = [&](double amount, const auto& limits) -> std::optional<Roof> {
      const auto found = std::ranges::find_if(machine, [&](const Benchmark& level) {
        return level.label("instruction_set") == label("instruction_set") && limits(level);
      });
      const auto least = found == machine.end() ? std::nullopt : ratio(nanoseconds * amount, rate_of(*found));
      return least ? std::optional(Roof{*least, found->label("limit")}) : std::nullopt;
    };
    const auto computing =
        time_at(operations(), [](const Benchmark& level) { return level.label("limit") == "arithmetic"; });
    const auto moving = time_at(*moved, [&](const Benchmark& level) {
      return working_set > number_in_label(level, "more_than_bytes", working_set) &&
             working_set <= number_in_label(level, "up_to_bytes", 0.0);
    });
    if (computing && moving) roof = computing->nanoseconds >= moving->nanoseconds ? computing : moving;
  }
  [[nodiscard]] double operations() const { return median_of(operations_per_interval).value_or(0.0); }
  [[nodiscard]] std::optional<double> bytes() const { return median_of(bytes_per_interval); }
};

Columns<Evaluation> evaluation_columns() {
  constexpr auto roof = &Evaluation::roof;
  const auto label = label_column<Evaluation>;
  return {
      label("way", "way of evaluation", FieldKind::text),
      label("quantity", "evaluated quantity", FieldKind::text),
      label("problem", "name of the problem", FieldKind::text),
      label("links", "number of links of a chain", FieldKind::integer),
      label("method", "family of elements", FieldKind::text),
      label("tableau", "family of Butcher tableaus", FieldKind::text),
      label("stages", "number of stages s", FieldKind::integer),
      label("instruction_set", "instruction set of the processor", FieldKind::text),
      label("intervals", "number of intervals N", FieldKind::integer),
      {"repetitions", "", "number of repetitions",
       [](const Evaluation& of) { return of.numbers.at(ns_per_interval).size(); }},
      {"nanoseconds", "ns", "time per interval, the median", &Evaluation::time},
      {"smallest_nanoseconds", "ns", "time per interval, the least",
       [](const Evaluation& of) { return of.smallest_of(ns_per_interval); }},
      {"operations", "", "operations per interval", &Evaluation::operations},
      {"bytes", "", "bytes per interval, read and written", &Evaluation::bytes},
      {"operations_per_byte", "", "operations by bytes",
       [](const Evaluation& of) { return of.bytes() ? std::optional(of.operations() / *of.bytes()) : std::nullopt; }},
      {"operations_per_second", "1/s", "operations by their time",
       [](const Evaluation& of) { return nanoseconds * of.operations() / of.time; }},
      {"roof_nanoseconds", "ns", "least time on this machine", from(roof, &Roof::nanoseconds)},
      {"roof_limit", "", "arithmetic, or a level of memory", from(roof, &Roof::limit)},
      {"roof_share", "", "roof_nanoseconds by nanoseconds",
       [](const Evaluation& of) { return of.roof ? std::optional(of.roof->nanoseconds / of.time) : std::nullopt; }}};
}

double seconds_per_iteration(const Row& row) {
  return row.number("seconds", 0.0) / std::max(1.0, row.number("iterations", 0.0));
}

Columns<Benchmark> solve_columns() {
  const auto seconds = [](const Benchmark& of) { return second * of.median_of("real_time").value_or(NAN); };
  return {label_column("problem", "name of the problem"),
          label_column("method", "family of elements"),
          label_column("intervals", "number of intervals N", FieldKind::integer),
          label_column("solver", "name of the solver"),
          label_column("threads", "number of threads of a solve", FieldKind::integer),
          {"repetitions", "", "number of repetitions",
           [](const Benchmark& of) { return of.numbers.at("real_time").size(); }},
          {"seconds", "s", "time of a solve, the median", seconds},
          {"smallest_seconds", "s", "time of a solve, the least",
           [](const Benchmark& of) { return second * of.smallest_of("real_time").value_or(NAN); }},
          {"iterations", "", "major iterations", [](const Benchmark& of) { return of.median_of("major_iterations"); }},
          counter_column("linear_systems", "", "number of linear systems solved"),
          {"solved", "", "1 if every repetition ended solved",
           [](const Benchmark& of) { return of.smallest_of("solved") == 1.0; }},
          counter_column("objective", "cost", "objective of the answer"),
          {"ns_per_interval_iteration", "ns", "time of a solve by intervals and iterations",
           [seconds](const Benchmark& of) {
             const double iterations = std::max(1.0, of.median_of("major_iterations").value_or(0.0));
             return seconds(of) / iterations / number_in_label(of, "intervals", 0.0) / second;
           }},
          counter_column("evaluation_share", "", "share of derivatives in the time"),
          counter_column("bytes_per_interval", "", "largest memory of a solve, by intervals"),
          counter_column("setup_seconds", "s", "time to make the program")};
}

/// Two solves of a program.
struct SolvesOfPair {
  Row head;  ///< the faster one
  Row slower;
  std::string quantity;

  [[nodiscard]] std::string verdict() const {
    constexpr double same_objective = 1e-9;
    if (slower.text("solved") != "1" || head.text("solved") != "1") return "not both solved";
    const double objective = head.number("objective", 0.0);
    const bool is_same = std::abs(slower.number("objective", 0.0) - objective) <= same_objective * std::abs(objective);
    return is_same ? "same" : "other branch";
  }
  [[nodiscard]] std::optional<double> ratio_of(const char* column) const {
    return verdict() == "same" ? ratio(slower.number(column), head.number(column)) : std::nullopt;
  }
};

Columns<SolvesOfPair> pair_columns() {
  using Pair = SolvesOfPair;
  return head_columns<Pair>({"problem", "method", "intervals"}, in_key) +
         Columns<Pair>{{"quantity", "", "difference of the two solves: solver or threads", &Pair::quantity, in_key},
                       {"ratio", "", "ratio of their seconds, Ipopt's or one thread's in the numerator",
                        [](const Pair& pair) { return pair.ratio_of("seconds"); }},
                       {"ratio_of_smallest", "", "ratio of their smallest seconds",
                        [](const Pair& pair) { return pair.ratio_of("smallest_seconds"); }},
                       {"verdict", "", "same where the costs are equal", &Pair::verdict}};
}

void append_pair(std::vector<SolvesOfPair>& pairs, const std::string& quantity, const Selection& slower,
                 const Selection& faster) {
  if (!slower.empty() && !faster.empty()) pairs.push_back({faster.front(), slower.front(), quantity});
}

/// The line through the times per iteration over N, in logarithms.
struct TimesOverGrids {
  Row head;
  FittedOrder line;
};

Columns<TimesOverGrids> exponent_columns() {
  constexpr auto line = &TimesOverGrids::line;
  return head_columns<TimesOverGrids>({"problem", "method", "solver", "threads"}, in_key) +
         Columns<TimesOverGrids>{
             {"exponent", "", "exponent of N in the time per iteration", from(line, &FittedOrder::order)},
             {"standard_error", "", "standard error of the exponent", from(line, &FittedOrder::standard_error)},
             {"grids", "", "number of grids used", from(line, &FittedOrder::points)},
             {"coarsest", "", "smallest number of intervals used", from(line, &FittedOrder::first_abscissa)},
             {"finest", "", "largest number of intervals used", from(line, &FittedOrder::last_abscissa)}};
}

}  // namespace

std::vector<Benchmark> without_names(const Benchmarks& benchmarks) {
  const auto values = std::views::values(benchmarks);
  return {values.begin(), values.end()};
}

Table interval_table(const Benchmarks& benchmarks) {
  const std::vector<Benchmark> machine = of_the_machine(benchmarks);
  std::vector<Evaluation> evaluations;
  for (const auto& [name, benchmark] : benchmarks) {
    if (benchmark.median_of(ns_per_interval)) evaluations.emplace_back(benchmark, machine);
  }
  return table_of(evaluation_columns(), evaluations);
}

Table machine_table(const Benchmarks& benchmarks) {
  const Columns<Benchmark> columns{label_column("instruction_set", "instruction set of the processor"),
                                   label_column("limit", "arithmetic, or a level of memory"),
                                   {"rate", "1/s", "operations or bytes per second", rate_of},
                                   label_column("array_bytes", "size of the arrays, in bytes", FieldKind::integer)};
  return table_of(columns, of_the_machine(benchmarks));
}

Table solve_table(const Benchmarks& benchmarks) {
  std::vector<Benchmark> solves = without_names(benchmarks);
  std::ranges::sort(solves, {}, [](const Benchmark& of) {
    return std::tuple(of.label("problem"), of.label("method"), number_in_label(of, "intervals", 0.0),
                      of.label("solver"), of.label("threads"));
  });
  return table_of(solve_columns(), solves);
}

Table solve_ratios(const Table& solves) {
  std::vector<SolvesOfPair> pairs;
  for (const Selection& program : Selection(solves).group_by({"problem", "method", "intervals"})) {
    const Selection ours = program.where("solver", "interior_point");
    const Selection by_one = ours.where("threads", "1");
    append_pair(pairs, "solver", program.where("solver", "ipopt").where("threads", "1"), by_one);
    append_pair(pairs, "threads", by_one, ours.where("threads", "2"));
  }
  return table_of(pair_columns(), pairs);
}

Table solve_exponents(const Table& solves) {
  constexpr double coarsest_grid = 1024;
  constexpr int fewest_grids = 3;
  std::vector<TimesOverGrids> all;
  // Grouped by solvers first: two threads begin on a finer grid, but come after one thread.
  for (const Selection& by_solver : Selection(solves).group_by({"problem", "method", "solver"})) {
    for (const Selection& curve : by_solver.group_by({"threads"})) {
      std::vector<GridError> points;
      for (const Row& row : curve.where("solved", "1")) {
        const double intervals = row.number("intervals", 0.0);
        if (intervals >= coarsest_grid) points.push_back({intervals, seconds_per_iteration(row)});
      }
      const auto line = fit_order(points);
      if (line && line->points >= fewest_grids) all.push_back({curve.front(), *line});
    }
  }
  return table_of(exponent_columns(), all);
}

}  // namespace dmocbench::speed
