#include "bench/speed/solve_benchmark.hpp"

#include <chrono>

#include <Eigen/Core>

#include "bench/speed/peak_memory.hpp"
#include "bench/speed/solve_reporter.hpp"
#include "bench/speed/two_link_manipulator_bounded.hpp"
#include "methods/error.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

std::unique_ptr<Problem> make_subject(const std::string& name) {
  auto bounded = std::make_unique<TwoLinkManipulatorBounded>();
  if (bounded->name() == name) return bounded;
  return make_problem(name);
}

/// A program with its start, and how long the program took to make.
struct TimedProgram {
  std::unique_ptr<Transcription> program;
  Eigen::VectorXd start;
  double seconds = 0.0;
};

TimedProgram make_program(const Problem& problem, const SolveName& name) {
  using Clock = std::chrono::steady_clock;
  TimedProgram made;
  const auto begin = Clock::now();
  made.program = std::make_unique<Transcription>(problem, *make_element(name.method), make_tableau("gauss", 1),
                                                 Grid::uniform(name.intervals), "tape");
  made.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  made.start = sample(*made.program, guessed_motion(problem));
  return made;
}

std::unique_ptr<Solver> solver_of(const SolveName& name) {
  SolverOptions options;
  options.most_seconds = most_seconds_of_a_solve;
  return make_solver(name.solver, options);
}

}  // namespace

std::vector<std::string> problems_on_all_grids() {
  std::vector<std::string> names = paper_problem_names();
  names.push_back(TwoLinkManipulatorBounded().name());
  return names;
}

SolveBenchmark::SolveBenchmark(SolveName name) : name_(std::move(name)), problem_(make_subject(name_.problem)) {}

std::optional<double> SolveBenchmark::peak_bytes() const {
  const PeakMemory memory;
  const TimedProgram made = make_program(*problem_, name_);
  const Solution solution = solver_of(name_)->solve(*made.program, made.start);
  return memory.growth();
}

void SolveBenchmark::run(benchmark::State& state) {
  try {
    set_thread_count(static_cast<std::size_t>(name_.threads));
    if (!is_memory_known_) bytes_ = peak_bytes();
    is_memory_known_ = true;
    const TimedProgram made = make_program(*problem_, name_);
    const auto solver = solver_of(name_);
    Solution solution;
    double seconds = 0.0;
    double evaluation_seconds = 0.0;
    double turns = 0.0;
    for ([[maybe_unused]] auto turn : state) {
      solution = solver->solve(*made.program, made.start);
      state.SetIterationTime(solution.seconds);
      seconds += solution.seconds;
      evaluation_seconds += solution.evaluation_seconds;
      turns += 1.0;
    }
    record(state, {.solution = solution,
                   .intervals = name_.intervals,
                   .seconds = seconds / turns,
                   .evaluation_seconds = evaluation_seconds / turns,
                   .setup_seconds = made.seconds,
                   .bytes = bytes_});
  } catch (const Error& error) {
    state.SkipWithError(error.what());  // the others go on
  }
}

}  // namespace dmocbench::speed
