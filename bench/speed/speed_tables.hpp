#pragma once

#include <string>
#include <vector>

#include "bench/compare/benchmark_file.hpp"
#include "methods/tables/table.hpp"

namespace dmocbench::speed {

// Counters of the program `speed`.
inline constexpr const char* ns_per_interval = "ns_per_interval";              ///< time
inline constexpr const char* operations_per_interval = "operations";           ///< of floating point, per interval
inline constexpr const char* bytes_per_interval = "bytes";                     ///< read and written per interval
inline constexpr const char* operations_per_second = "operations_per_second";  ///< of the machine
inline constexpr const char* bytes_per_second = "bytes_per_second";            ///< of the machine

/// The row of a benchmark: what its label tells, each word in its column, and the medians of these counters.
[[nodiscard]] Row row_of(const Benchmark& benchmark, const std::vector<std::string>& counters = {});

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

/// problem,method,intervals,solver,threads,repetitions,seconds,smallest_seconds,iterations,linear_systems,solved,
/// objective,ns_per_interval_iteration,evaluation_share,bytes_per_interval,setup_seconds: a row per benchmark of the
/// program `solves`, medians of the repetitions. What a solver or the system does not tell is empty.
[[nodiscard]] Table solve_table(const Benchmarks& benchmarks);

/// problem,method,intervals,quantity,ratio,ratio_of_smallest,verdict: a row per pair of rows of `solve_table` that
/// differ in `quantity`: "solver", Ipopt's seconds over those of `interior_point`, or "threads", those of one thread
/// over those of two. A ratio stands only where both solved the program with objectives that are equal to 1e-9 (the
/// verdict is "same"): a pair on different branches says nothing.
[[nodiscard]] Table solve_ratios(const Table& solves);

/// problem,method,solver,threads,exponent,standard_error,grids,coarsest,finest: time per iteration ~ N^exponent, a row
/// per curve of at least three grids from N = 1024 on that were solved. Below that a solve's fixed costs bend the line.
[[nodiscard]] Table solve_exponents(const Table& solves);

}  // namespace dmocbench::speed
