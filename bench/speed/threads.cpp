// The gain of further threads: whole solves of long horizons on one thread and on several, compared with the machine's
// gain for independent work. `page` turns the result into threads.md.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/speed/benchmark_program.hpp"
#include "bench/speed/guessed_program.hpp"
#include "bench/speed/kernels.hpp"
#include "bench/speed/timed_solves.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/parallel.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// A loop that every thread calls with memory of its own, three arrays of `size` numbers each.
struct Work {
  std::string name;
  std::size_t size = 0;
  std::function<void(double* first)> loop;
};

std::vector<Work> works() {
  constexpr std::size_t in_memory = std::size_t{1} << 22U;  // three arrays of 32 MiB, more than caches hold
  constexpr std::size_t in_cache = std::size_t{1} << 14U;   // of 128 KiB: a second-level cache of its own holds them
  constexpr std::size_t turns_of_arithmetic = 1000000;
  const Kernels kernels = kernels_of(preferred_instruction_set());
  const auto triad = [kernels](std::size_t size, int turns) {
    return [=](double* first) {
      for (int turn = 0; turn < turns; ++turn) kernels.triad(size, first, first + size, first + 2 * size, 0.5);
    };
  };
  return {{"arithmetic", 1, [kernels](double* first) { *first = kernels.arithmetic(turns_of_arithmetic); }},
          {"triad_cache", in_cache, triad(in_cache, 2000)},
          {"triad_memory", in_memory, triad(in_memory, 10)}};
}

/// machine/WORK/threads_COUNT: as much work on every thread as on one.
void add_work(const Work& work, std::size_t threads) {
  add_benchmark(fmt::format("machine/{}/threads_{}", work.name, threads), benchmark::kMillisecond,
                [=](benchmark::State& state) {
                  set_thread_count(threads);
                  std::vector<std::vector<double>> memory(threads);
                  // Everything is written first by the thread that works on it.
                  for_each_part(threads, [&](std::size_t part) { memory[part].assign(3 * work.size, 1.0); });
                  for ([[maybe_unused]] auto turn : state) {
                    const Clock::time_point begin = Clock::now();
                    for_each_part(threads, [&](std::size_t part) { work.loop(memory[part].data()); });
                    state.SetIterationTime(seconds_since(begin));
                  }
                  state.SetLabel(fmt::format("work={} threads={}", work.name, threads));
                });
}

/// Differs where two answers differ in a digit; a counter holds it exactly.
double digest(const Eigen::VectorXd& answer) {
  const auto bytes = static_cast<std::size_t>(answer.size()) * sizeof(double);
  const std::string_view text(reinterpret_cast<const char*>(answer.data()), bytes);  // NOLINT(*-reinterpret-cast)
  return static_cast<std::uint32_t>(std::hash<std::string_view>()(text));
}

/// PROBLEM/METHOD/INTERVALS/threads_COUNT
void add_solve(const std::string& problem, const std::string& method, int intervals, std::size_t threads) {
  add_benchmark(fmt::format("{}/{}/{}/threads_{}", problem, method, intervals, threads), benchmark::kMillisecond,
                [=](benchmark::State& state) {
                  set_thread_count(threads);
                  const GuessedProgram made(make_problem(problem), method, intervals);
                  const Solution solution = time_solves(state, *make_solver("interior_point"), made);
                  state.counters["digest"] = digest(solution.primal);
                  state.SetLabel(
                      fmt::format("problem={} method={} intervals={} threads={}", problem, method, intervals, threads));
                });
}

void register_threads() {
  const std::size_t all = std::max<std::size_t>(2, thread_count());
  for (const std::size_t threads : {std::size_t{1}, all}) {
    for (const Work& work : works()) add_work(work, threads);
    for (const std::string& problem : paper_problem_names()) {
      for (const char* method : {"dmoc", "hamiltonian"}) {
        for (const int intervals : {65536, 262144, 1000000}) add_solve(problem, method, intervals, threads);
      }
    }
  }
}

}  // namespace

int run_threads(int argc, char** argv) {
  const BenchmarkProgram program{
      .name = "threads",
      .description = "The gain of DMOCBENCH_THREADS threads in whole solves, and in independent work.",
      .default_filter = "^machine|/(65536|262144)/",
      .register_benchmarks = register_threads};
  return program.run(argc, argv);
}

}  // namespace dmocbench::speed

int main(int argc, char** argv) { return dmocbench::speed::run_threads(argc, argv); }
