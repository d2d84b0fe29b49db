// Whole solves, from the problem's own guess: the interior-point method by intervals against Ipopt, on one core and
// with the same derivatives.
#include <algorithm>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/speed/solve_table.hpp"
#include "bench/speed/start_benchmarks.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// A program with its start, made when the first benchmark wants it.
class Case {
 public:
  Case(const std::string& problem, std::string method, int intervals)
      : problem_(make_problem(problem)), method_(std::move(method)), intervals_(intervals) {}

  Transcription& program() {
    if (!program_) {
      program_ = std::make_unique<Transcription>(*problem_, *make_element(method_), make_tableau("gauss", 1),
                                                 Grid::uniform(intervals_), "tape");
      start_ = sample(*program_, guessed_motion(*problem_));
    }
    return *program_;
  }
  [[nodiscard]] const Eigen::VectorXd& start() const { return start_; }
  [[nodiscard]] int intervals() const { return intervals_; }

 private:
  std::unique_ptr<Problem> problem_;
  std::string method_;
  int intervals_;
  std::unique_ptr<Transcription> program_;
  Eigen::VectorXd start_;
};

/// Every turn is one solve; the structure that a solver finds in the program is part of it, the trace and its
/// derivatives are not.
void solve_repeatedly(benchmark::State& state, Case& subject, const std::string& solver_name) {
  Transcription& program = subject.program();
  SolverOptions options;
  options.most_seconds = most_seconds_of_a_solve;
  const auto solver = make_solver(solver_name, options);
  Solution solution;
  double seconds = 0.0;
  double evaluation_seconds = 0.0;
  for ([[maybe_unused]] auto turn : state) {
    solution = solver->solve(program, subject.start());
    state.SetIterationTime(solution.seconds);  // judging the answer is not part of the solve
    seconds += solution.seconds;
    evaluation_seconds += solution.evaluation_seconds;
  }
  record(state, solution, subject.intervals(), evaluation_seconds / seconds);
}

void register_solves(std::vector<std::unique_ptr<Case>>& cases) {
  const std::vector<std::string> solvers{"interior_point", "ipopt"};
  constexpr int most_intervals_of_ipopt = 16384;
  for (const std::string& problem : paper_problem_names()) {
    for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
      for (const int intervals : {64, 1024, 16384, 262144, 1048576}) {
        Case& subject = *cases.emplace_back(std::make_unique<Case>(problem, method, intervals));
        for (const std::string& solver : solvers) {
          if (solver == "ipopt" && intervals > most_intervals_of_ipopt) continue;
          benchmark::RegisterBenchmark(
              name_of_solve({problem, method, intervals}, solver).c_str(),
              [&subject, solver](benchmark::State& state) { solve_repeatedly(state, subject, solver); })
              ->UseManualTime()
              ->Unit(benchmark::kMillisecond);
        }
      }
    }
  }
}

}  // namespace

}  // namespace dmocbench::speed

int main(int argc, char** argv) {
  using namespace dmocbench::speed;  // NOLINT(google-build-using-namespace): the program's own
  const std::span<char* const> arguments(argv, static_cast<std::size_t>(argc));
  try {
    if (!initialize(arguments.front(), arguments.subspan(1), {"--benchmark_filter=/(64|1024)/"})) return 2;
    std::vector<std::unique_ptr<Case>> cases;
    register_solves(cases);
    SolveReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    fmt::print("{}", solve_table(reporter.solves()));
    benchmark::Shutdown();
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "solves: {}\n", error.what());
    return 1;
  }
}
