#include "bench/speed/interval_tables.hpp"

#include <optional>
#include <string>

namespace dmocbench::speed {

namespace {

constexpr double nanoseconds = 1e9;  // of a second

/// Operations or bytes per second; none if it is no benchmark of the machine.
std::optional<double> rate_of(const Benchmark& benchmark) {
  const auto operations = benchmark.median_of(operations_per_second);
  return operations ? operations : benchmark.median_of(bytes_per_second);
}

struct Roof {
  double nanoseconds = 0.0;
  std::string limit;
};

/// None where a benchmark that it takes did not run.
std::optional<Roof> roof_of(const Benchmarks& benchmarks, const std::string& instruction_set, double operations,
                            double bytes, double working_set) {
  std::optional<Roof> arithmetic;
  std::optional<Roof> memory;
  for (const auto& [name, benchmark] : benchmarks) {
    const auto rate = rate_of(benchmark);
    if (!rate || benchmark.label("instruction_set") != instruction_set) continue;
    const std::string limit = benchmark.label("limit");
    if (limit == "arithmetic") {
      arithmetic = {nanoseconds * operations / *rate, limit};
    } else if (working_set > std::stod(benchmark.label("more_than_bytes")) &&
               working_set <= std::stod(benchmark.label("up_to_bytes"))) {
      memory = {nanoseconds * bytes / *rate, limit};
    }
  }
  if (!arithmetic || !memory) return std::nullopt;
  return arithmetic->nanoseconds >= memory->nanoseconds ? arithmetic : memory;
}

Row row_of_labels(const Benchmark& benchmark) {
  Row row;
  for (const auto& [key, value] : benchmark.labels) row.set(key, Cell(value));
  return row;
}

Row interval_row(const Benchmark& benchmark, double time, const Benchmarks& all) {
  Row row = row_of_labels(benchmark);
  const double operations = benchmark.median_of(operations_per_interval).value_or(0.0);
  row.set("repetitions", Cell(static_cast<long long>(benchmark.numbers.at(ns_per_interval).size())));
  row.set("nanoseconds", Cell(time));
  row.set("smallest_nanoseconds", benchmark.smallest_of(ns_per_interval));
  row.set("operations", Cell(operations));
  row.set("operations_per_second", Cell(nanoseconds * operations / time));
  const auto bytes = benchmark.median_of(bytes_per_interval);
  if (!bytes) return row;
  row.set("bytes", bytes);
  row.set("operations_per_byte", Cell(operations / *bytes));
  const double working_set = *bytes * row.number("intervals").value_or(0.0);
  if (const auto roof = roof_of(all, row.text("instruction_set"), operations, *bytes, working_set)) {
    row.set("roof_nanoseconds", Cell(roof->nanoseconds));
    row.set("roof_limit", Cell(roof->limit));
    row.set("roof_share", Cell(roof->nanoseconds / time));
  }
  return row;
}

}  // namespace

Table interval_table(const Benchmarks& benchmarks) {
  Table table({"way", "quantity", "problem", "links", "method", "tableau", "stages", "instruction_set", "intervals",
               "repetitions", "nanoseconds", "smallest_nanoseconds", "operations", "bytes", "operations_per_byte",
               "operations_per_second", "roof_nanoseconds", "roof_limit", "roof_share"});
  for (const auto& [name, benchmark] : benchmarks) {
    if (const auto time = benchmark.median_of(ns_per_interval))
      table.append(interval_row(benchmark, *time, benchmarks));
  }
  return table;
}

Table machine_table(const Benchmarks& benchmarks) {
  Table table({"instruction_set", "limit", "rate", "array_bytes"});
  for (const auto& [name, benchmark] : benchmarks) {
    const auto rate = rate_of(benchmark);
    if (!rate) continue;
    Row row = row_of_labels(benchmark);
    row.set("rate", rate);
    table.append(row);
  }
  return table;
}

}  // namespace dmocbench::speed
