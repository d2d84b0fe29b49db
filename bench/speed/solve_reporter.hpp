#pragma once

#include <optional>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/speed/solve_table.hpp"
#include "methods/program/solution.hpp"

namespace dmocbench::speed {

/// What is measured of a solve; times are means of the turns.
struct SolveMeasurement {
  const Solution& solution;
  int intervals = 0;
  double seconds = 0.0;
  double evaluation_seconds = 0.0;
  double setup_seconds = 0.0;
  std::optional<double> bytes;
};

/// Puts what `SolveReporter` reads into a benchmark's counters; what is not known is left out.
void record(benchmark::State& state, const SolveMeasurement& measured);

/// Prints one line per benchmark, its median, and keeps all repetitions.
class SolveReporter final : public benchmark::ConsoleReporter {
 public:
  SolveReporter() : ConsoleReporter(OO_None) {}
  void ReportRuns(const std::vector<Run>& runs) override;  // NOLINT(readability-identifier-naming): the base's name
  [[nodiscard]] const SolvesByName& solves() const noexcept { return solves_; }

 private:
  SolvesByName solves_;
};

}  // namespace dmocbench::speed
