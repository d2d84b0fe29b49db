#include "bench/speed/solve_reporter.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include "methods/program/status.hpp"

namespace dmocbench::speed {

namespace {

std::optional<double> counter(const benchmark::UserCounters& counters, const std::string& name) {
  const auto found = counters.find(name);
  return found == counters.end() ? std::nullopt : std::optional<double>(found->second.value);
}

}  // namespace

void record(benchmark::State& state, const SolveMeasurement& measured) {
  const Solution& solution = measured.solution;
  state.counters["iterations"] = solution.major_iterations.value_or(0);
  if (solution.linear_systems) state.counters["linear_systems"] = *solution.linear_systems;
  state.counters["objective"] = solution.objective;
  state.counters["solved"] = is_solved(solution.status) ? 1.0 : 0.0;
  state.counters["evaluation_share"] = measured.evaluation_seconds / measured.seconds;
  state.counters["intervals"] = measured.intervals;
  state.counters["ns_per_interval_iteration"] =
      1e9 * measured.seconds / measured.intervals / std::max(1, solution.major_iterations.value_or(0));
  if (measured.bytes) state.counters["bytes_per_interval"] = *measured.bytes / measured.intervals;
  state.counters["setup_seconds"] = measured.setup_seconds;
}

void SolveReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
    Solves& solves = solves_[SolveName::parse(run.run_name.function_name)];
    solves.seconds.push_back(run.real_accumulated_time / static_cast<double>(run.iterations));
    solves.setup_seconds.push_back(run.counters.at("setup_seconds"));
    solves.iterations = run.counters.at("iterations");
    solves.objective = run.counters.at("objective");
    solves.evaluation_share = run.counters.at("evaluation_share");
    solves.is_solved = run.counters.at("solved") == 1.0;
    solves.linear_systems = counter(run.counters, "linear_systems");
    solves.bytes_per_interval = counter(run.counters, "bytes_per_interval");
  }
  std::vector<Run> shown;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(shown),
               [](const Run& run) { return run.aggregate_name == "median" || run.repetitions <= 1; });
  if (shown.empty()) return;
  ConsoleReporter::ReportRuns(shown);
  GetOutputStream().flush();  // hours may pass until the next
}

}  // namespace dmocbench::speed
