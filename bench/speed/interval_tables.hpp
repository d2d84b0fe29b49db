#pragma once

#include "bench/compare/benchmark_file.hpp"
#include "bench/experiment/table.hpp"

namespace dmocbench::speed {

// Counters of the program `speed`.
inline constexpr const char* ns_per_interval = "ns_per_interval";
inline constexpr const char* operations_per_interval = "operations";
inline constexpr const char* bytes_per_interval = "bytes";
inline constexpr const char* operations_per_second = "operations_per_second";
inline constexpr const char* bytes_per_second = "bytes_per_second";

/// way,quantity,problem,links,method,tableau,stages,instruction_set,intervals,repetitions,nanoseconds,
/// smallest_nanoseconds,operations,bytes,operations_per_byte,operations_per_second,roof_nanoseconds,roof_limit,
/// roof_share: a row per benchmark with `ns_per_interval`, all of an interval, medians of the repetitions.
///
/// The roof is the least time that the machine takes for that many operations on that many bytes. It stands where bytes
/// are counted and the machine was measured with the same instruction set: its arithmetic and the level of memory that
/// holds the arrays of all intervals.
[[nodiscard]] Table interval_table(const Benchmarks& benchmarks);

/// instruction_set,limit,rate,array_bytes: a row per benchmark of the machine. The limit is "arithmetic" or a level of
/// memory, the rate operations or bytes per second.
[[nodiscard]] Table machine_table(const Benchmarks& benchmarks);

}  // namespace dmocbench::speed
