#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/speed/interval_benchmark.hpp"
#include "bench/speed/kernels.hpp"

namespace dmocbench::speed {

namespace {

/// A level of memory, from the fastest to the slowest, with the capacity that the system reports.
struct MemoryLevel {
  std::string name;            ///< "l1", "l2", "l3" or "memory"
  std::size_t capacity = 0;    ///< bytes; no limit for the last
  std::size_t triad_size = 0;  ///< bytes of the three arrays by which its rate is measured
};

/// The value that the system reports, or else a common size.
std::size_t size_or(int name, std::size_t common) {
  const long told = ::sysconf(name);
  return told > 0 ? static_cast<std::size_t>(told) : common;
}

/// A rate with this many in every iteration.
benchmark::Counter per_iteration(double count) { return {count, benchmark::Counter::kIsIterationInvariantRate}; }

/// All triads share `memory`, which grows as needed, up to an eighth of the machine's.
void measure_triad(benchmark::State& state, TriadLoop triad, std::size_t bytes, std::vector<CacheLine>& memory) {
  constexpr std::size_t block = 8;  // arrays a few blocks of lines long, for loops without a rest
  const std::size_t lines = bytes / (3 * block * sizeof(CacheLine)) * block;
  if (memory.size() < 3 * lines) {
    memory = {};
    memory.resize(3 * lines, CacheLine{});
  }
  const std::size_t size = lines * CacheLine{}.numbers.size();
  double* a = memory.front().numbers.data();
  const double* b = memory[lines].numbers.data();
  const double* c = memory[2 * lines].numbers.data();
  for ([[maybe_unused]] auto turn : state) {
    triad(size, a, b, c, 0.5);
    benchmark::ClobberMemory();
  }
  state.counters["bytes_per_second"] = per_iteration(static_cast<double>(3 * sizeof(double) * size));
}

std::vector<MemoryLevel> memory_levels() {
  constexpr std::size_t kibibyte = 1024;
  const std::size_t l1 = size_or(_SC_LEVEL1_DCACHE_SIZE, 32 * kibibyte);
  const std::size_t l2 = size_or(_SC_LEVEL2_CACHE_SIZE, 1024 * kibibyte);
  const std::size_t l3 = std::max(size_or(_SC_LEVEL3_CACHE_SIZE, 16 * l2), 2 * l2);
  const std::size_t all = size_or(_SC_PHYS_PAGES, l3) * size_or(_SC_PAGESIZE, 4 * kibibyte);
  return {
      {"l1", l1, l1 / 2},
      {"l2", l2, l2 / 2},
      // A cache that many processors share is not all ours.
      {"l3", l3, std::min(8 * l2, l3 / 2)},
      {"memory", std::numeric_limits<std::size_t>::max(), std::min(2 * l3, all / 8)},
  };
}

}  // namespace

void register_machine_benchmarks() {
  const auto memory = std::make_shared<std::vector<CacheLine>>();
  for (const InstructionSet set : available_instruction_sets()) {
    const Kernels kernels = kernels_of(set);
    const std::string label = fmt::format("instruction_set={} limit=", name_of(set));
    benchmark::RegisterBenchmark(fmt::format("machine/arithmetic/{}", name_of(set)).c_str(),
                                 [kernels, label](benchmark::State& state) {
                                   constexpr std::size_t turns = 10000;
                                   for ([[maybe_unused]] auto turn : state)
                                     benchmark::DoNotOptimize(kernels.arithmetic(turns));
                                   const auto operations = static_cast<double>(turns * kernels.operations_of_a_turn);
                                   state.counters["operations_per_second"] = per_iteration(operations);
                                   state.SetLabel(label + "arithmetic");
                                 });
    std::size_t smaller = 0;  // the capacity of the level before
    for (const MemoryLevel& level : memory_levels()) {
      // Keys are columns of the table of `bench/speed/page`, and the sizes of the arrays that a level holds.
      const std::string of_level = fmt::format("{}{} array_bytes={} more_than_bytes={} up_to_bytes={}", label,
                                               level.name, level.triad_size, smaller, level.capacity);
      smaller = level.capacity;
      benchmark::RegisterBenchmark(fmt::format("machine/triad_{}/{}", level.name, name_of(set)).c_str(),
                                   [kernels, size = level.triad_size, of_level, memory](benchmark::State& state) {
                                     measure_triad(state, kernels.triad, size, *memory);
                                     state.SetLabel(of_level);
                                   });
    }
  }
}

}  // namespace dmocbench::speed
