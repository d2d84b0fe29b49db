#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/speed/subject.hpp"

namespace dmocbench::speed {

using Subjects = std::vector<std::unique_ptr<Subject>>;

// Names are WAY/QUANTITY/PROBLEM, and /INSTRUCTION_SET where the way has one. The subjects must outlive the run.

/// tape/...: bare tapes, one by one ("residual", "jacobian", "hessian"), one after the other ("separate") and the three
/// made one tape ("fused"), on every instruction set there is.
void register_tape_benchmarks(const Subjects& subjects);
/// replay/...: the same schedules on one double after the other.
void register_replay_benchmarks(const Subjects& subjects);
/// program/...: the assembled program's evaluations.
void register_program_benchmarks(const Subjects& subjects);
/// adolc/...: the Hessian by ADOL-C, one interval at a time ("hessian") or a block of them by one tape of ADOL-C
/// ("hessian_block"). Nothing where ADOL-C is missing.
void register_adolc_benchmarks(const Subjects& subjects);

inline constexpr const char* ns_per_interval = "ns_per_interval";
inline constexpr const char* operations_per_interval = "operations";

/// To be called behind the timed loop, each turn of which treats all intervals once. `operations`: of the formulas, per
/// interval.
inline void count_intervals(benchmark::State& state, std::size_t operations) {
  using benchmark::Counter;
  constexpr auto intervals = static_cast<double>(Subject::intervals);
  constexpr double seconds_per_ns = 1e-9;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(Subject::intervals));
  state.counters[ns_per_interval] =
      Counter(intervals * seconds_per_ns, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters[operations_per_interval] = Counter(static_cast<double>(operations));
}

}  // namespace dmocbench::speed
