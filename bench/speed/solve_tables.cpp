#include "bench/speed/solve_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "methods/diagnostics/convergence_order.hpp"

namespace dmocbench::speed {

namespace {

double number_in(const Row& row, std::string_view column) { return row.number(column).value_or(0.0); }

double seconds_per_iteration(const Row& row) {
  return number_in(row, "seconds") / std::max(1.0, number_in(row, "iterations"));
}

Row solve_row(const Benchmark& benchmark) {
  constexpr double second = 1e-9;  // of a nanosecond
  Row row;
  for (const auto& [key, value] : benchmark.labels) row.set(key, Cell(value));
  const auto& times = benchmark.numbers.at("real_time");
  row.set("repetitions", Cell(static_cast<long long>(times.size())));
  row.set("seconds", Cell(second * *benchmark.median_of("real_time")));
  row.set("smallest_seconds", Cell(second * *benchmark.smallest_of("real_time")));
  row.set("iterations", benchmark.median_of("major_iterations"));
  row.set("solved", Cell(benchmark.smallest_of("solved") == 1.0 ? 1LL : 0LL));
  for (const char* counter :
       {"linear_systems", "objective", "evaluation_share", "bytes_per_interval", "setup_seconds"}) {
    row.set(counter, benchmark.median_of(counter));
  }
  row.set("ns_per_interval_iteration", Cell(seconds_per_iteration(row) / number_in(row, "intervals") / second));
  return row;
}

Row ratio_row(const std::string& quantity, const Row& slow, const Row& fast) {
  constexpr double same_objective = 1e-9;
  Row row;
  for (const char* column : {"problem", "method", "intervals"}) row.set(column, Cell(fast.text(column)));
  row.set("quantity", Cell(quantity));
  const double difference = std::abs(number_in(slow, "objective") - number_in(fast, "objective"));
  if (slow.text("solved") != "1" || fast.text("solved") != "1") {
    row.set("verdict", "not both solved");
  } else if (difference <= same_objective * std::abs(number_in(fast, "objective"))) {
    row.set("verdict", "same");
    row.set("ratio", Cell(number_in(slow, "seconds") / number_in(fast, "seconds")));
    row.set("ratio_of_smallest", Cell(number_in(slow, "smallest_seconds") / number_in(fast, "smallest_seconds")));
  } else {
    row.set("verdict", "other branch");
  }
  return row;
}

}  // namespace

Table solve_table(const Benchmarks& benchmarks) {
  std::vector<Row> rows;
  for (const auto& [name, benchmark] : benchmarks) rows.push_back(solve_row(benchmark));
  std::ranges::sort(rows, {}, [](const Row& row) {
    return std::tuple(row.text("problem"), row.text("method"), number_in(row, "intervals"), row.text("solver"),
                      row.text("threads"));
  });
  Table table({"problem", "method", "intervals", "solver", "threads", "repetitions", "seconds", "smallest_seconds",
               "iterations", "linear_systems", "solved", "objective", "ns_per_interval_iteration", "evaluation_share",
               "bytes_per_interval", "setup_seconds"});
  for (Row& row : rows) table.append(std::move(row));
  return table;
}

Table solve_ratios(const Table& solves) {
  const std::string fast_solver = "interior_point";
  Table table({"problem", "method", "intervals", "quantity", "ratio", "ratio_of_smallest", "verdict"});
  for (const Row& fast : solves.rows()) {
    if (fast.text("solver") != fast_solver || fast.text("threads") != "1") continue;
    const auto find = [&](const std::string& solver, const std::string& threads) {
      return std::ranges::find_if(solves.rows(), [&](const Row& row) {
        return row.text("solver") == solver && row.text("threads") == threads &&
               row.text("intervals") == fast.text("intervals") && row.text("method") == fast.text("method") &&
               row.text("problem") == fast.text("problem");
      });
    };
    const auto by_ipopt = find("ipopt", "1");
    const auto by_two = find(fast_solver, "2");
    if (by_ipopt != solves.rows().end()) table.append(ratio_row("solver", *by_ipopt, fast));
    if (by_two != solves.rows().end()) table.append(ratio_row("threads", fast, *by_two));
  }
  return table;
}

Table solve_exponents(const Table& solves) {
  constexpr double coarsest_grid = 1024;
  constexpr int fewest_grids = 3;
  const std::array<const char*, 4> keys{"problem", "method", "solver", "threads"};
  std::map<std::array<std::string, 4>, std::vector<GridError>> curves;
  for (const Row& row : solves.rows()) {
    const double intervals = number_in(row, "intervals");
    if (intervals < coarsest_grid || row.text("solved") != "1") continue;
    std::array<std::string, 4> curve;
    std::ranges::transform(keys, curve.begin(), [&](const char* key) { return row.text(key); });
    curves[curve].push_back({intervals, seconds_per_iteration(row)});
  }
  Table table({"problem", "method", "solver", "threads", "exponent", "standard_error", "grids", "coarsest", "finest"});
  for (const auto& [curve, points] : curves) {
    const auto line = fit_order(points);
    if (!line || line->points < fewest_grids) continue;
    Row row;
    for (std::size_t i = 0; i < keys.size(); ++i) row.set(keys[i], Cell(curve[i]));
    row.set("exponent", Cell(line->order));
    row.set("standard_error", Cell(line->standard_error));
    row.set("grids", Cell(static_cast<long long>(line->points)));
    // The abscissa is N instead of a step: the smallest is that of the coarsest grid.
    row.set("coarsest", Cell(static_cast<long long>(line->finest)));
    row.set("finest", Cell(static_cast<long long>(line->coarsest)));
    table.append(row);
  }
  return table;
}

}  // namespace dmocbench::speed
