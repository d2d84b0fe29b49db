#pragma once

#include <string>
#include <vector>

#include "bench/run/column.hpp"
#include "bench/speed/benchmark_file.hpp"

namespace dmocbench::speed {

// Counters of the program `speed`.
inline constexpr const char* ns_per_interval = "ns_per_interval";              ///< time
inline constexpr const char* operations_per_interval = "operations";           ///< of floating point, per interval
inline constexpr const char* bytes_per_interval = "bytes";                     ///< read and written per interval
inline constexpr const char* operations_per_second = "operations_per_second";  ///< of the machine
inline constexpr const char* bytes_per_second = "bytes_per_second";            ///< of the machine

/// The column of a word of the label; `Record` is a benchmark, or derived from it.
template <class Record = Benchmark>
[[nodiscard]] Column<Record> label_column(const std::string& name, const std::string& meaning,
                                          FieldKind kind = FieldKind::text) {
  const auto label = [name](const Record& record) { return Cell(record.label(name)); };
  return {name, "", meaning, FieldReader<Record>(label, FieldType{.kind = kind, .may_be_empty = true})};
}

/// The column of a counter: the median of the repetitions.
template <class Record = Benchmark>
[[nodiscard]] Column<Record> counter_column(const std::string& name, const std::string& unit,
                                            const std::string& meaning) {
  return {name, unit, meaning, [name](const Record& record) { return record.median_of(name); }};
}

/// The benchmarks without their names.
[[nodiscard]] std::vector<Benchmark> without_names(const Benchmarks& benchmarks);

/// A row per benchmark with `ns_per_interval`, all of an interval, medians of the repetitions.
///
/// The roof is the least time that the machine takes for that many operations on that many bytes. It stands where bytes
/// are counted and the machine was measured with the same instruction set: its arithmetic and the level of memory that
/// holds the arrays of all intervals.
[[nodiscard]] Table interval_table(const Benchmarks& benchmarks);

/// A row per benchmark of the machine.
[[nodiscard]] Table machine_table(const Benchmarks& benchmarks);

/// A row per benchmark of the program `solves`, medians of the repetitions. Values that a solver or the system does not
/// report are empty.
[[nodiscard]] Table solve_table(const Benchmarks& benchmarks);

/// A row per pair of rows of `solve_table` that
/// differ in `quantity`: "solver", Ipopt's seconds over `interior_point`'s, or "threads", the seconds of one
/// thread over the seconds of two. A ratio stands only where both solved the program with objectives that are equal to
/// 1e-9 (the verdict is "same"): a pair on different branches is not comparable.
[[nodiscard]] Table solve_ratios(const Table& solves);

/// Time per iteration ~ N^exponent, a row per curve of at least three grids from N = 1024 on that were solved. Below
/// that a solve's fixed costs bend the line.
[[nodiscard]] Table solve_exponents(const Table& solves);

}  // namespace dmocbench::speed
