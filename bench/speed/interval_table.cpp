#include "bench/speed/interval_table.hpp"

#include <optional>

#include <fmt/format.h>

#include "bench/speed/benchmark_name.hpp"
#include "bench/speed/benchmarks.hpp"
#include "bench/speed/machine.hpp"

namespace dmocbench::speed {

namespace {

std::optional<InstructionSet> set_named(const std::string& name) {
  for (const InstructionSet set : available_instruction_sets()) {
    if (name == name_of(set)) return set;
  }
  return std::nullopt;
}

void set_formulas(Row& row, const BenchmarkName& name) {
  const std::string chain = "link_chain_";
  const bool is_chain = name.problem.starts_with(chain);
  row.set("problem", Cell(is_chain ? chain.substr(0, chain.size() - 1) : name.problem));
  if (is_chain) row.set("links", Cell(name.problem.substr(chain.size())));
  row.set("method", Cell(name.method));
  row.set("tableau", "gauss");
  row.set("stages", Cell(static_cast<long long>(name.stages)));
}

void set_roof(Row& row, const Measurements& measurements, InstructionSet set, double operations, double bytes,
              double nanoseconds) {
  const auto roof = Machine(measurements, set).roof(operations, bytes, bytes * static_cast<double>(Subject::intervals));
  if (!roof) return;
  row.set("roof_nanoseconds", Cell(roof->nanoseconds));
  row.set("roof_limit", Cell(roof->limit));
  row.set("roof_share", Cell(roof->nanoseconds / nanoseconds));
}

}  // namespace

Table interval_table(const Measurements& measurements) {
  Table table({"way", "quantity", "problem", "links", "method", "tableau", "stages", "instruction_set", "intervals",
               "repetitions", "nanoseconds", "smallest_nanoseconds", "operations", "bytes", "operations_per_byte",
               "operations_per_second", "roof_nanoseconds", "roof_limit", "roof_share"});
  for (const std::string& text : measurements.names()) {
    const auto nanoseconds = measurements.median(text, ns_per_interval);
    if (!nanoseconds) continue;
    const BenchmarkName name = BenchmarkName::parse(text);
    const double operations = measurements.median(text, operations_per_interval).value_or(0.0);
    const double bytes = measurements.median(text, bytes_per_interval).value_or(0.0);
    Row row;
    row.set("way", Cell(name.way));
    row.set("quantity", Cell(name.quantity));
    set_formulas(row, name);
    row.set("instruction_set", Cell(name.instruction_set));
    row.set("intervals", Cell(static_cast<long long>(Subject::intervals)));
    row.set("repetitions", Cell(static_cast<long long>(measurements.repetitions(text))));
    row.set("nanoseconds", Cell(*nanoseconds));
    row.set("smallest_nanoseconds", measurements.smallest(text, ns_per_interval));
    row.set("operations", Cell(operations));
    constexpr double per_nanosecond = 1e9;
    row.set("operations_per_second", Cell(per_nanosecond * operations / *nanoseconds));
    const auto set = set_named(name.instruction_set);
    if (set && bytes > 0.0) {
      row.set("bytes", Cell(bytes));
      row.set("operations_per_byte", Cell(operations / bytes));
      set_roof(row, measurements, *set, operations, bytes, *nanoseconds);
    }
    table.append(row);
  }
  return table;
}

Table machine_table(const Measurements& measurements) {
  Table table({"instruction_set", "limit", "rate", "array_bytes"});
  for (const InstructionSet set : available_instruction_sets()) {
    const Machine machine(measurements, set);
    const auto add = [&](const std::string& limit, std::optional<double> rate, std::optional<std::size_t> bytes) {
      if (!rate) return;
      Row row;
      row.set("instruction_set", Cell(std::string(name_of(set))));
      row.set("limit", Cell(limit));
      row.set("rate", rate);
      row.set("array_bytes", bytes);
      table.append(row);
    };
    add("arithmetic", machine.operations_per_second(), std::nullopt);
    for (std::size_t i = 0; i < memory_levels().size(); ++i) {
      add(memory_levels()[i].name, machine.bytes_per_second()[i], memory_levels()[i].triad_size);
    }
  }
  return table;
}

std::string roofline(const Table& intervals) {
  std::string text;
  for (const Row& row : intervals.rows()) {
    if (!row.number("roof_share")) continue;
    const auto number = [&](const char* column) { return row.number(column).value_or(0.0); };
    const BenchmarkName name{.way = row.text("way"),
                             .quantity = row.text("quantity"),
                             .problem = row.text("problem") + (row.number("links") ? "_" + row.text("links") : ""),
                             .method = row.text("way") == "program" ? row.text("method") : "",
                             .stages = static_cast<int>(number("stages")),
                             .instruction_set = row.text("instruction_set")};
    text +=
        fmt::format("{:<62}{:>8.0f}{:>8.0f}{:>8.2f}{:>10.2f} {:<12}{:>8.2f}{:>8.0f} %\n", name.text(),
                    number("operations"), number("bytes"), number("operations_per_byte"), number("roof_nanoseconds"),
                    row.text("roof_limit"), number("nanoseconds"), 100.0 * number("roof_share"));
  }
  if (text.empty()) return text;
  return fmt::format("\nroofline, per interval\n{:<62}{:>8}{:>8}{:>8}{:>10} {:<12}{:>8}{:>10}\n", "", "op", "bytes",
                     "op/byte", "roof [ns]", "set by", "ns", "of roof") +
         text;
}

}  // namespace dmocbench::speed
