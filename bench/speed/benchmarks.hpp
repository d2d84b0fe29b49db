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

// Names are those of `BenchmarkName`. The subjects, DMOC with the midpoint rule, must outlive the run.

/// tape/...: bare tapes, one by one ("residual", "jacobian", "hessian"), one after the other ("separate") and the three
/// made one tape ("fused"), on every instruction set there is.
void register_tape_benchmarks(const Subjects& subjects);
/// replay/...: the same schedules on one double after the other.
void register_replay_benchmarks(const Subjects& subjects);
/// adolc/...: the Hessian by ADOL-C, one interval at a time ("hessian") or a block of them by one tape of ADOL-C
/// ("hessian_block"). Nothing where ADOL-C is missing.
void register_adolc_benchmarks(const Subjects& subjects);

/// hand/...: the paper's problems written by hand, see kernels.hpp, on every instruction set there is. Throws `Error`
/// if a subject is another problem.
void register_hand_benchmarks(const Subjects& subjects);

/// program/...: the assembled program's evaluations, one by one and one after the other ("separate"), for every method,
/// Gauss with 1 to 3 stages, the paper's problems and chains of 2 to 8 links. A program is made when the first
/// benchmark wants it.
void register_program_benchmarks();

inline constexpr const char* ns_per_interval = "ns_per_interval";
inline constexpr const char* operations_per_interval = "operations";
inline constexpr const char* bytes_per_interval = "bytes";

/// What an evaluation takes and gives, per interval.
struct Work {
  std::size_t operations = 0;  ///< of the formulas
  double bytes = 0.0;          ///< of arrays read and written, each once; 0: not counted

  Work& operator+=(const Work& other) {
    operations += other.operations;
    bytes += other.bytes;
    return *this;
  }
};

/// The work of a schedule on a subject's point that writes `arrays_written` numbers per interval.
[[nodiscard]] inline Work work_of(const Schedule& schedule, const Subject& subject, double arrays_written) {
  const auto arrays = static_cast<double>(arrays_read(schedule, subject.columns())) + arrays_written;
  return {.operations = schedule.operation_count(), .bytes = sizeof(double) * arrays};
}

/// The same where every output is a column of its own.
[[nodiscard]] inline Work work_of(const Schedule& schedule, const Subject& subject) {
  return work_of(schedule, subject, static_cast<double>(schedule.outputs().size()));
}

/// To be called behind the timed loop, each turn of which treats all intervals once.
inline void count_intervals(benchmark::State& state, const Work& work) {
  using benchmark::Counter;
  constexpr auto intervals = static_cast<double>(Subject::intervals);
  constexpr double seconds_per_ns = 1e-9;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(Subject::intervals));
  state.counters[ns_per_interval] =
      Counter(intervals * seconds_per_ns, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters[operations_per_interval] = Counter(static_cast<double>(work.operations));
  if (work.bytes > 0.0) state.counters[bytes_per_interval] = Counter(work.bytes);
}

}  // namespace dmocbench::speed
