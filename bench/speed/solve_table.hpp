#pragma once

#include <compare>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "methods/program/solution.hpp"

namespace dmocbench::speed {

/// Beyond it a solve counts as failed.
inline constexpr double most_seconds_of_a_solve = 60.0;

struct SolveCase {
  std::string problem;
  std::string method;
  int intervals = 0;
  friend auto operator<=>(const SolveCase&, const SolveCase&) = default;
};

/// PROBLEM/METHOD/INTERVALS/SOLVER.
[[nodiscard]] std::string name_of_solve(const SolveCase& subject, const std::string& solver);

/// What all repetitions of a solve tell.
struct Solves {
  std::vector<double> seconds;
  double iterations = 0.0;
  double objective = 0.0;
  double evaluation_share = 0.0;
  bool is_solved = false;

  [[nodiscard]] double median() const;
  [[nodiscard]] double smallest() const;
};

using SolvesByCase = std::map<std::pair<SolveCase, std::string>, Solves>;

/// Puts what `SolveReporter` reads into a benchmark's counters.
void record(benchmark::State& state, const Solution& solution, int intervals, double evaluation_share);

/// Prints one line per benchmark, its median, and keeps all repetitions.
class SolveReporter final : public benchmark::ConsoleReporter {
 public:
  SolveReporter() : ConsoleReporter(OO_None) {}
  void ReportRuns(const std::vector<Run>& runs) override;  // NOLINT(readability-identifier-naming): the base's name
  [[nodiscard]] const SolvesByCase& solves() const noexcept { return solves_; }

 private:
  SolvesByCase solves_;
};

/// Times and ratios. A ratio stands only where both solvers solved the program, confirmed by our residual, with equal
/// objectives to 1e-9: a pair on different branches says nothing.
[[nodiscard]] std::string solve_table(const SolvesByCase& solves);

}  // namespace dmocbench::speed
