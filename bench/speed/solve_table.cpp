#include "bench/speed/solve_table.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include <fmt/format.h>

namespace dmocbench::speed {

namespace {

constexpr double same_objective = 1e-9;

/// PROBLEM/METHOD/INTERVALS/SOLVER, and what Google Benchmark appends.
std::pair<SolveCase, std::string> parts_of(const std::string& name) {
  std::istringstream text(name);
  SolveCase subject;
  std::string intervals;
  std::string solver;
  std::getline(text, subject.problem, '/');
  std::getline(text, subject.method, '/');
  std::getline(text, intervals, '/');
  std::getline(text, solver, '/');
  subject.intervals = std::stoi(intervals);
  return {subject, solver};
}

std::optional<Solves> find(const SolvesByCase& solves, const SolveCase& subject, const std::string& solver) {
  const auto found = solves.find({subject, solver});
  return found == solves.end() ? std::nullopt : std::optional(found->second);
}

std::string ratio(const std::optional<Solves>& slow, const std::optional<Solves>& fast) {
  if (!slow || !fast) return "-";
  if (!slow->is_solved || !fast->is_solved) return "not both solved";
  if (!(std::abs(slow->objective - fast->objective) <= same_objective * std::abs(fast->objective))) {
    return "other branch";
  }
  return fmt::format("{:.1f} ({:.1f})", slow->median() / fast->median(), slow->smallest() / fast->smallest());
}

std::string time_of(const std::optional<Solves>& solves) {
  return solves ? fmt::format("{:.3f} ({:.3f}) [{:.0f}]", 1e3 * solves->median(), 1e3 * solves->smallest(),
                              solves->iterations)
                : "-";
}

std::string per_interval(const std::optional<Solves>& solves, int intervals) {
  if (!solves) return "-";
  constexpr double nanoseconds = 1e9;
  return fmt::format("{:.0f}", nanoseconds * solves->median() / intervals / std::max(1.0, solves->iterations));
}

}  // namespace

std::string name_of_solve(const SolveCase& subject, const std::string& solver) {
  return fmt::format("{}/{}/{}/{}", subject.problem, subject.method, subject.intervals, solver);
}

double Solves::median() const {
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  return sorted.empty() ? 0.0 : sorted[sorted.size() / 2];
}

double Solves::smallest() const { return seconds.empty() ? 0.0 : *std::min_element(seconds.begin(), seconds.end()); }

void record(benchmark::State& state, const Solution& solution, int intervals, double evaluation_share) {
  state.counters["iterations"] = solution.major_iterations.value_or(0);
  state.counters["objective"] = solution.objective;
  state.counters["solved"] = is_solved(solution.status) ? 1.0 : 0.0;
  state.counters["evaluation_share"] = evaluation_share;
  state.counters["intervals"] = intervals;
}

void SolveReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
    Solves& solves = solves_[parts_of(run.run_name.function_name)];
    solves.seconds.push_back(run.real_accumulated_time / static_cast<double>(run.iterations));
    solves.iterations = run.counters.at("iterations");
    solves.objective = run.counters.at("objective");
    solves.evaluation_share = run.counters.at("evaluation_share");
    solves.is_solved = run.counters.at("solved") == 1.0;
  }
  std::vector<Run> shown;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(shown),
               [](const Run& run) { return run.aggregate_name == "median"; });
  if (!shown.empty()) ConsoleReporter::ReportRuns(shown);
}

std::string solve_table(const SolvesByCase& solves) {
  std::vector<SolveCase> cases;
  for (const auto& [key, unused] : solves) {
    if (cases.empty() || cases.back() != key.first) cases.push_back(key.first);
  }
  std::string text = "\nms per solve: median (smallest) of the repetitions, in brackets the iterations\n";
  text += fmt::format("{:<42}{:>26}{:>30}{:>22}{:>16}{:>12}\n", "", "interior_point", "ipopt", "ipopt/interior_point",
                      "ns/(interval it)", "evaluation");
  for (const SolveCase& subject : cases) {
    const auto fast = find(solves, subject, "interior_point");
    const auto slow = find(solves, subject, "ipopt");
    text += fmt::format("{:<42}{:>26}{:>30}{:>22}{:>16}{:>12}\n",
                        fmt::format("{} {} N = {}", subject.problem, subject.method, subject.intervals), time_of(fast),
                        time_of(slow), ratio(slow, fast), per_interval(fast, subject.intervals),
                        fast ? fmt::format("{:.0f} %", 100.0 * fast->evaluation_share) : "-");
  }
  return text;
}

}  // namespace dmocbench::speed
