#pragma once

#include "bench/compare/benchmark_file.hpp"
#include "bench/experiment/table.hpp"

namespace dmocbench::speed {

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
