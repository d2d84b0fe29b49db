#include "bench/speed/speed_tables.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bench/summary/selection.hpp"
#include "methods/diagnostics/convergence_order.hpp"

namespace dmocbench::speed {

namespace {

constexpr double nanoseconds = 1e9;  // of a second
constexpr double second = 1e-9;      // of a nanosecond

/// The roof as (nanoseconds, limit), from the rows of the machine; none where a benchmark that it takes did not run.
std::optional<std::pair<double, std::string>> roof_of(const Selection& machine, double operations, double bytes,
                                                      double working_set) {
  const Row& arithmetic = machine.where("limit", "arithmetic").front();
  const Selection holds_arrays = machine.where([&](const Row& level) {
    return working_set > level.number("more_than_bytes", working_set) &&
           working_set <= level.number("up_to_bytes", 0.0);
  });
  const Row& memory = holds_arrays.front();
  const auto computing = ratio(nanoseconds * operations, arithmetic.number("rate"));
  const auto moving = ratio(nanoseconds * bytes, memory.number("rate"));
  if (!computing || !moving) return std::nullopt;
  return *computing >= *moving ? std::pair(*computing, arithmetic.text("limit"))
                               : std::pair(*moving, memory.text("limit"));
}

Row interval_row(const Benchmark& benchmark, double time, const Selection& machine) {
  Row row = row_of(benchmark);
  const double operations = benchmark.median_of(operations_per_interval).value_or(0.0);
  row.set("repetitions", benchmark.numbers.at(ns_per_interval).size());
  row.set("nanoseconds", time);
  row.set("smallest_nanoseconds", benchmark.smallest_of(ns_per_interval));
  row.set("operations", operations);
  row.set("operations_per_second", nanoseconds * operations / time);
  const auto bytes = benchmark.median_of(bytes_per_interval);
  if (!bytes) return row;
  row.set("bytes", bytes);
  row.set("operations_per_byte", operations / *bytes);
  const double working_set = *bytes * row.number("intervals", 0.0);
  if (const auto roof = roof_of(machine.matching(row, {"instruction_set"}), operations, *bytes, working_set)) {
    row.set("roof_nanoseconds", roof->first);
    row.set("roof_limit", roof->second);
    row.set("roof_share", roof->first / time);
  }
  return row;
}

double seconds_per_iteration(const Row& row) {
  return row.number("seconds", 0.0) / std::max(1.0, row.number("iterations", 0.0));
}

Row solve_row(const Benchmark& benchmark) {
  Row row = row_of(benchmark);
  row.set("repetitions", benchmark.numbers.at("real_time").size());
  row.set("seconds", second * *benchmark.median_of("real_time"));
  row.set("smallest_seconds", second * *benchmark.smallest_of("real_time"));
  row.set("iterations", benchmark.median_of("major_iterations"));
  row.set("solved", benchmark.smallest_of("solved") == 1.0 ? 1 : 0);
  for (const char* counter :
       {"linear_systems", "objective", "evaluation_share", "bytes_per_interval", "setup_seconds"}) {
    row.set(counter, benchmark.median_of(counter));
  }
  row.set("ns_per_interval_iteration", seconds_per_iteration(row) / row.number("intervals", 0.0) / second);
  return row;
}

/// The times of the first row over those of the second, if there are both.
void append_ratio(Table& table, const std::string& quantity, const Selection& slower, const Selection& faster) {
  if (slower.empty() || faster.empty()) return;
  const Row& slow = slower.front();
  const Row& fast = faster.front();
  constexpr double same_objective = 1e-9;
  Row row = fields_of(fast, {"problem", "method", "intervals"});
  row.set("quantity", quantity);
  const double objective = fast.number("objective", 0.0);
  if (slow.text("solved") != "1" || fast.text("solved") != "1") {
    row.set("verdict", "not both solved");
  } else if (std::abs(slow.number("objective", 0.0) - objective) <= same_objective * std::abs(objective)) {
    row.set("verdict", "same");
    row.set("ratio", ratio(slow.number("seconds"), fast.number("seconds")));
    row.set("ratio_of_smallest", ratio(slow.number("smallest_seconds"), fast.number("smallest_seconds")));
  } else {
    row.set("verdict", "other branch");
  }
  table.append(std::move(row));
}

}  // namespace

Row row_of(const Benchmark& benchmark, const std::vector<std::string>& counters) {
  Row row;
  for (const auto& [key, value] : benchmark.labels) row.set(key, value);
  for (const std::string& counter : counters) row.set(counter, benchmark.median_of(counter));
  return row;
}

Table interval_table(const Benchmarks& benchmarks) {
  Table table({"way", "quantity", "problem", "links", "method", "tableau", "stages", "instruction_set", "intervals",
               "repetitions", "nanoseconds", "smallest_nanoseconds", "operations", "bytes", "operations_per_byte",
               "operations_per_second", "roof_nanoseconds", "roof_limit", "roof_share"});
  const Table machine = machine_table(benchmarks);
  for (const auto& [name, benchmark] : benchmarks) {
    if (const auto time = benchmark.median_of(ns_per_interval)) table.append(interval_row(benchmark, *time, machine));
  }
  return table;
}

Table machine_table(const Benchmarks& benchmarks) {
  Table table({"instruction_set", "limit", "rate", "array_bytes"});
  for (const auto& [name, benchmark] : benchmarks) {
    const auto operations = benchmark.median_of(operations_per_second);
    const auto rate = operations ? operations : benchmark.median_of(bytes_per_second);
    if (!rate) continue;
    Row row = row_of(benchmark);
    row.set("rate", rate);
    table.append(std::move(row));
  }
  return table;
}

Table solve_table(const Benchmarks& benchmarks) {
  std::vector<Row> rows;
  rows.reserve(benchmarks.size());
  for (const auto& [name, benchmark] : benchmarks) rows.push_back(solve_row(benchmark));
  std::ranges::sort(rows, {}, [](const Row& row) {
    return std::tuple(row.text("problem"), row.text("method"), row.number("intervals"), row.text("solver"),
                      row.text("threads"));
  });
  Table table({"problem", "method", "intervals", "solver", "threads", "repetitions", "seconds", "smallest_seconds",
               "iterations", "linear_systems", "solved", "objective", "ns_per_interval_iteration", "evaluation_share",
               "bytes_per_interval", "setup_seconds"});
  for (Row& row : rows) table.append(std::move(row));
  return table;
}

Table solve_ratios(const Table& solves) {
  Table table({"problem", "method", "intervals", "quantity", "ratio", "ratio_of_smallest", "verdict"});
  for (const Selection& program : Selection(solves).group_by({"problem", "method", "intervals"})) {
    const Selection ours = program.where("solver", "interior_point");
    const Selection by_one = ours.where("threads", "1");
    append_ratio(table, "solver", program.where("solver", "ipopt").where("threads", "1"), by_one);
    append_ratio(table, "threads", by_one, ours.where("threads", "2"));
  }
  return table;
}

Table solve_exponents(const Table& solves) {
  constexpr double coarsest_grid = 1024;
  constexpr int fewest_grids = 3;
  Table table({"problem", "method", "solver", "threads", "exponent", "standard_error", "grids", "coarsest", "finest"});
  // By solvers first: two threads begin on a finer grid, and stand behind one all the same.
  for (const Selection& by_solver : Selection(solves).group_by({"problem", "method", "solver"})) {
    for (const Selection& curve : by_solver.group_by({"threads"})) {
      std::vector<GridError> points;
      for (const Row& row : curve.where("solved", "1")) {
        const double intervals = row.number("intervals", 0.0);
        if (intervals >= coarsest_grid) points.push_back({intervals, seconds_per_iteration(row)});
      }
      const auto line = fit_order(points);
      if (!line || line->points < fewest_grids) continue;
      Row row = fields_of(curve.front(), {"problem", "method", "solver", "threads"});
      row.set("exponent", line->order);
      row.set("standard_error", line->standard_error);
      row.set("grids", line->points);
      // The abscissa is N instead of a step: the smallest is that of the coarsest grid.
      row.set("coarsest", line->finest);
      row.set("finest", line->coarsest);
      table.append(std::move(row));
    }
  }
  return table;
}

}  // namespace dmocbench::speed
