// How the time of a solve by interior_point grows with the number of intervals and of configurations, what further
// threads gain, and what a prepared solve saves. `page` turns the result into the tables of scaling.md.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/speed/benchmark_program.hpp"
#include "bench/speed/guessed_program.hpp"
#include "methods/error.hpp"
#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/prepared_solve.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// A program with a start. A cold one is the problem's guess; a warm one is the motion, with its multipliers, that is
/// optimal for an end state whose nonzero entries are smaller by one percent, moved to the ends.
struct StartedProgram {
  GuessedProgram made;
  Eigen::VectorXd start;
  Eigen::VectorXd multipliers;

  StartedProgram(const std::string& problem, const std::string& method, int intervals, bool is_warm)
      : made(make_problem(problem), method, intervals), start(made.start) {
    if (!is_warm) return;
    Transcription& program = *made.program;
    BoundaryState end = made.problem->final_state();
    end.q *= 0.99;
    end.v *= 0.99;
    program.set_final_state(end);
    const Solution neighbour = make_solver("interior_point")->solve(program, made.start);
    if (!is_solved(neighbour.status)) throw Error("the neighbour that gives the warm start is not solved");
    multipliers = neighbour.multipliers;
    const Motion motion = smooth_motion(read_trajectory(program, neighbour.primal, multipliers));
    program.set_final_state(made.problem->final_state());
    start = sample(program, moved_to_ends(motion, program.bounds()));
  }
};

/// A solve that can be repeated, on threads as set: "plain" by `Solver::solve`, "prepared" by a `PreparedSolve`, or
/// "residuals" by one that judges by residuals only.
std::function<const Solution&()> repeatable(const StartedProgram& given, const std::string& way) {
  NonlinearProgram& program = *given.made.program;
  if (way == "plain") {
    return [&given, &program, solver = std::shared_ptr(make_solver("interior_point")),
            solution = std::make_shared<Solution>()]() -> const Solution& {
      return *solution = solver->solve(program, given.start, given.multipliers);
    };
  }
  using Judgement = PreparedSolve::Judgement;
  const auto prepared = std::make_shared<PreparedSolve>(
      program, "interior_point", SolverOptions(), way == "prepared" ? Judgement::confirmed : Judgement::residuals_only);
  static_cast<void>(prepared->solve(given.start, given.multipliers));  // takes its memory
  return [&given, prepared]() -> const Solution& { return prepared->solve(given.start, given.multipliers); };
}

/// Differs where two answers differ in a digit; a counter holds it exactly.
double digest(const Eigen::VectorXd& answer) {
  const auto bytes = static_cast<std::size_t>(answer.size()) * sizeof(double);
  const std::string_view text(reinterpret_cast<const char*>(answer.data()), bytes);  // NOLINT(*-reinterpret-cast)
  return static_cast<std::uint32_t>(std::hash<std::string_view>()(text));
}

/// The time of a solve: the solver's own, without judging the answer, or of all that the call does.
enum class SolveTime : std::uint8_t { of_solver, of_call };

void time_solves(benchmark::State& state, const std::function<const Solution&()>& solve, SolveTime time) {
  const Solution* solution = nullptr;
  for ([[maybe_unused]] auto turn : state) {
    const Clock::time_point begin = Clock::now();
    solution = &solve();
    state.SetIterationTime(time == SolveTime::of_solver ? solution->seconds : seconds_since(begin));
  }
  state.counters["iterations"] = solution->major_iterations.value_or(0);
  state.counters["solved"] = is_solved(solution->status) ? 1.0 : 0.0;
  state.counters["digest"] = digest(solution->primal);
}

/// grids/PROBLEM/METHOD/INTERVALS/threads_COUNT, from the guess.
void add_grid(const std::string& problem, const std::string& method, int intervals, std::size_t threads) {
  add_benchmark(fmt::format("grids/{}/{}/{}/threads_{}", problem, method, intervals, threads), benchmark::kMillisecond,
                [=](benchmark::State& state) {
                  set_thread_count(threads);
                  const StartedProgram given(problem, method, intervals, false);
                  time_solves(state, repeatable(given, "plain"), SolveTime::of_solver);
                  state.SetLabel(
                      fmt::format("problem={} method={} intervals={} threads={}", problem, method, intervals, threads));
                });
}

/// repeated/PROBLEM/METHOD/INTERVALS/START/WAY, on one thread.
void add_repeated(const std::string& problem, const std::string& method, int intervals, const std::string& start,
                  const std::string& way) {
  add_benchmark(fmt::format("repeated/{}/{}/{}/{}/{}", problem, method, intervals, start, way), benchmark::kMicrosecond,
                [=](benchmark::State& state) {
                  set_thread_count(1);
                  const StartedProgram given(problem, method, intervals, start == "warm");
                  time_solves(state, repeatable(given, way), SolveTime::of_call);
                  state.SetLabel(fmt::format("problem={} method={} start={} intervals={} way={}", problem, method,
                                             start, intervals, way));
                });
}

constexpr int intervals_of_chain = 256;

GuessedProgram chain_of(int links) {
  const std::shared_ptr<Problem> problem = make_problem("link_chain");
  problem->set_parameter("links", links);
  return {problem, "dmoc", intervals_of_chain};
}

/// The evaluations of an iteration of `interior_point` at the guess of a chain, and the system that it then eliminates.
/// A shift makes the Hessian positive definite, as the solver does where it is not.
class Iteration {
 public:
  explicit Iteration(const GuessedProgram& made)
      : program_(*made.program), start_(made.start), step_(start_.size()), gradient_(start_.size()) {
    constexpr double small_multiplier = 0.01;
    constexpr double large_shift = 1e4;
    const auto constraints = static_cast<Eigen::Index>(program_.constraint_count());
    multipliers_ = Eigen::VectorXd::Constant(constraints, small_multiplier);
    shift_ = Eigen::VectorXd::Constant(start_.size(), large_shift);
    hessian_.resize(static_cast<Eigen::Index>(program_.hessian_structure().size()));
    jacobian_.resize(static_cast<Eigen::Index>(program_.jacobian_structure().size()));
    residuals_.resize(constraints);
    step_of_multipliers_.resize(constraints);
    auto kkt = kkt::IntervalKkt::make(program_);
    if (!kkt) throw Error(kkt.error());
    kkt_ = std::move(*kkt);
    evaluate();
  }

  void evaluate() {
    program_.constraints(start_, residuals_);
    program_.gradient(start_, gradient_);
    program_.jacobian(start_, jacobian_);
    program_.hessian(start_, 1.0, multipliers_, hessian_);
  }

  void eliminate() {
    const kkt::FactorisationStatus status = kkt_->solve({hessian_, jacobian_, shift_, no_compliance_},
                                                        {gradient_, residuals_}, {step_, step_of_multipliers_});
    if (status != kkt::FactorisationStatus::solved) throw Error("the linear system of the chain could not be solved");
  }

 private:
  Transcription& program_;
  Eigen::VectorXd start_;
  Eigen::VectorXd step_;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd multipliers_;
  Eigen::VectorXd shift_;
  Eigen::VectorXd no_compliance_;
  Eigen::VectorXd hessian_;
  Eigen::VectorXd jacobian_;
  Eigen::VectorXd residuals_;
  Eigen::VectorXd step_of_multipliers_;
  std::unique_ptr<kkt::IntervalKkt> kkt_;
};

/// Times evaluations, eliminations, or the making of the program of a chain.
void time_chain(benchmark::State& state, const std::string& quantity, const GuessedProgram& made, int links) {
  Iteration iteration(made);
  for ([[maybe_unused]] auto turn : state) {
    const Clock::time_point begin = Clock::now();
    if (quantity == "evaluation") iteration.evaluate();
    if (quantity == "elimination") iteration.eliminate();
    if (quantity == "making") benchmark::DoNotOptimize(chain_of(links));
    state.SetIterationTime(seconds_since(begin));
  }
}

/// chains/LINKS/QUANTITY
void add_chain(int links, const std::string& quantity) {
  add_benchmark(fmt::format("chains/{}/{}", links, quantity), benchmark::kMicrosecond, [=](benchmark::State& state) {
    set_thread_count(1);
    const GuessedProgram made = chain_of(links);
    time_chain(state, quantity, made, links);
    state.SetLabel(fmt::format("quantity={} links={} intervals={}", quantity, links, intervals_of_chain));
    const LocalFunctions& functions = made.program->functions();
    state.counters["lagrangian_operations"] = static_cast<double>(functions.lagrangian.operation_count());
    state.counters["hessian_operations"] = static_cast<double>(functions.hessian.schedule.operation_count());
  });
}

void register_scaling() {
  constexpr int fewest_intervals_of_threads = 16384;  // the next shorter grid is a single part of the work
  const std::size_t all = std::max<std::size_t>(2, thread_count());
  for (const std::string& problem : paper_problem_names()) {
    for (const char* method : {"dmoc", "hamiltonian"}) {
      for (const int intervals : {64, 1024, 16384, 65536, 262144, 1048576}) {
        add_grid(problem, method, intervals, 1);
        if (intervals >= fewest_intervals_of_threads) add_grid(problem, method, intervals, all);
      }
    }
    for (const std::string& method : paper_families()) {
      for (const int intervals : {16, 64}) {
        for (const char* start : {"cold", "warm"}) {
          for (const char* way : {"plain", "prepared", "residuals"}) {
            add_repeated(problem, method, intervals, start, way);
          }
        }
      }
    }
  }
  for (const int links : {2, 3, 4, 6, 8, 10, 16, 32}) {
    for (const char* quantity : {"evaluation", "elimination", "making"}) add_chain(links, quantity);
  }
}

}  // namespace

int run_scaling(int argc, char** argv) {
  const BenchmarkProgram program{
      .name = "scaling",
      .description = "Measures times of interior_point over intervals, links and threads, and of prepared solves.",
      .default_filter = "^grids/.*/(1024|65536)/|^repeated/.*/dmoc/|^chains/",
      .register_benchmarks = register_scaling};
  return program.run(argc, argv);
}

}  // namespace dmocbench::speed

int main(int argc, char** argv) { return dmocbench::speed::run_scaling(argc, argv); }
