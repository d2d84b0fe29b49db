// Why interior_point is faster than Ipopt: one thing is changed at a time. `page` turns the result into factors.md.
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/speed/benchmark_program.hpp"
#include "bench/speed/guessed_program.hpp"
#include "bench/speed/timed_solves.hpp"
#include "methods/error.hpp"
#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/kkt/refined_kkt.hpp"
#include "methods/kkt/sparse_kkt.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "methods/transcription/derivatives/derivative_back_end.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

std::unique_ptr<kkt::KktSystem> by_mumps(NonlinearProgram& program) {
  return std::make_unique<kkt::SparseKkt>(program, kkt::SparseKkt::Order::found);
}

std::unique_ptr<kkt::KktSystem> by_dissection(NonlinearProgram& program) {
  return std::make_unique<kkt::SparseKkt>(program, kkt::SparseKkt::Order::along_the_horizon);
}

/// The elimination by the kernel for any sizes, which takes plain shapes too.
std::unique_ptr<kkt::KktSystem> by_intervals_of_any_size(NonlinearProgram& program) {
  auto made = kkt::IntervalKkt::make(program, [](const kkt::Shape& shape) {
    kkt::Shape any = shape;
    any.is_plain = false;
    return kkt::segment_kernel_for(any);
  });
  if (!made) throw Error(made.error());
  return std::make_unique<kkt::RefinedKkt>(program, std::move(*made));
}

using MakeSystem = std::function<std::unique_ptr<kkt::KktSystem>(NonlinearProgram&)>;

/// A way to solve.
struct Way {
  std::string name;
  MakeSystem make_system = {};  ///< of interior_point, if not its own
  std::size_t threads = 1;

  [[nodiscard]] std::unique_ptr<Solver> solver(SolverOptions options) const {
    options.most_seconds = 60.0;
    if (make_system)
      return std::make_unique<InteriorPointSolver>(options, InteriorPointOptions{.make_kkt_system = make_system});
    return make_solver(name == "ipopt" ? "ipopt" : "interior_point", options);
  }
};

/// PROBLEM/INTERVALS/DERIVATIVES/WAY, by DMOC.
void add(const std::string& problem, int intervals, const std::string& derivatives, double tolerance, const Way& way) {
  add_benchmark(fmt::format("{}/{}/{}/{}", problem, intervals, derivatives, way.name), benchmark::kMillisecond,
                [=](benchmark::State& state) {
                  set_thread_count(way.threads);
                  const GuessedProgram made(make_problem(problem), "dmoc", intervals, 1, derivatives);
                  SolverOptions options;
                  options.tolerance = tolerance;
                  static_cast<void>(time_solves(state, *way.solver(options), made));
                  state.SetLabel(fmt::format("problem={} intervals={} derivatives={} way={}", problem, intervals,
                                             derivatives, way.name));
                });
}

void register_factors() {
  constexpr double tolerance = 1e-10;
  constexpr double of_differences = 1e-6;  // differences reach no lower one: all back ends get one that they can
  const Way ipopt{"ipopt"};
  const Way interior_point{"interior_point"};
  const std::vector<Way> ways{ipopt,
                              {"mumps", by_mumps},
                              {"dissection", by_dissection},
                              {"any_size", by_intervals_of_any_size},
                              interior_point};
  for (const std::string& problem : paper_problem_names()) {
    for (const Way& way : ways) add(problem, 1024, "tape", tolerance, way);
    for (const Way& way : {interior_point, Way{"two_threads", {}, 2}}) add(problem, 65536, "tape", tolerance, way);
    for (const std::string& derivatives : derivative_back_end_names()) {
      if (derivatives == "dense_differences") continue;  // minutes of evaluations, whatever the solver
      for (const Way& way : {ipopt, interior_point}) add(problem, 128, derivatives, of_differences, way);
    }
  }
}

}  // namespace

int run_factors(int argc, char** argv) {
  const BenchmarkProgram program{.name = "factors",
                                 .description = "Why interior_point is faster than Ipopt, one change at a time.",
                                 .default_filter = ".",
                                 .register_benchmarks = register_factors};
  return program.run(argc, argv);
}

}  // namespace dmocbench::speed

int main(int argc, char** argv) { return dmocbench::speed::run_factors(argc, argv); }
