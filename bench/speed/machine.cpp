#include "bench/speed/machine.hpp"

#include <algorithm>
#include <limits>
#include <memory>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "bench/speed/kernels.hpp"

namespace dmocbench::speed {

namespace {

constexpr const char* operation_rate = "operations_per_second";
constexpr const char* byte_rate = "bytes_per_second";

std::string arithmetic_name(InstructionSet set) { return "machine/arithmetic/" + std::string(name_of(set)); }
std::string triad_name(const MemoryLevel& level, InstructionSet set) {
  return "machine/triad_" + level.name + "/" + std::string(name_of(set));
}

/// What the system tells, or a common size where it does not.
std::size_t size_or(int name, std::size_t common) {
  const long told = ::sysconf(name);
  return told > 0 ? static_cast<std::size_t>(told) : common;
}

void measure_arithmetic(benchmark::State& state, const Kernels& kernels) {
  constexpr std::size_t turns = 10000;
  for ([[maybe_unused]] auto turn : state) benchmark::DoNotOptimize(kernels.arithmetic(turns));
  const auto operations = static_cast<double>(turns * kernels.operations_of_a_turn);
  state.counters[operation_rate] = benchmark::Counter(operations, benchmark::Counter::kIsIterationInvariantRate);
}

/// Three arrays in one piece of memory, which all triads share: that of the main memory is as large as is decent.
class TriadArrays {
 public:
  double* of(std::size_t bytes) {
    const std::size_t size = bytes / sizeof(double) + line;
    if (values_.size() < size) {
      values_ = {};
      values_.assign(size, 1.0);
    }
    void* head = values_.data();
    std::size_t space = values_.size() * sizeof(double);
    return static_cast<double*>(std::align(line * sizeof(double), sizeof(double), head, space));
  }

 private:
  static constexpr std::size_t line = 8;
  std::vector<double> values_;
};

void measure_triad(benchmark::State& state, TriadLoop triad, std::size_t bytes, TriadArrays& arrays) {
  constexpr std::size_t block = 64;
  const std::size_t size = bytes / (3 * sizeof(double)) / block * block;
  double* a = arrays.of(bytes);
  const double* b = a + size;
  const double* c = b + size;
  for ([[maybe_unused]] auto turn : state) {
    triad(size, a, b, c, 0.5);
    benchmark::ClobberMemory();
  }
  const auto moved = static_cast<double>(3 * sizeof(double) * size);
  state.counters[byte_rate] = benchmark::Counter(moved, benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

const std::vector<MemoryLevel>& memory_levels() {
  static const std::vector<MemoryLevel> levels = [] {
    constexpr std::size_t kibibyte = 1024;
    const std::size_t l1 = size_or(_SC_LEVEL1_DCACHE_SIZE, 32 * kibibyte);
    const std::size_t l2 = size_or(_SC_LEVEL2_CACHE_SIZE, 1024 * kibibyte);
    const std::size_t l3 = std::max(size_or(_SC_LEVEL3_CACHE_SIZE, 16 * l2), 2 * l2);
    const std::size_t all = size_or(_SC_PHYS_PAGES, l3) * size_or(_SC_PAGESIZE, 4 * kibibyte);
    return std::vector<MemoryLevel>{
        {"l1", l1, l1 / 2},
        {"l2", l2, l2 / 2},
        // A cache that many processors share is not all ours.
        {"l3", l3, std::min(8 * l2, l3 / 2)},
        {"memory", std::numeric_limits<std::size_t>::max(), std::min(2 * l3, all / 8)},
    };
  }();
  return levels;
}

void register_machine_benchmarks() {
  const auto arrays = std::make_shared<TriadArrays>();
  for (const InstructionSet set : available_instruction_sets()) {
    const Kernels kernels = kernels_of(set);
    benchmark::RegisterBenchmark(arithmetic_name(set).c_str(),
                                 [kernels](benchmark::State& state) { measure_arithmetic(state, kernels); });
    for (const MemoryLevel& level : memory_levels()) {
      benchmark::RegisterBenchmark(triad_name(level, set).c_str(), [kernels, &level, arrays](benchmark::State& state) {
        measure_triad(state, kernels.triad, level.triad_size, *arrays);
      });
    }
  }
}

Machine::Machine(const Measurements& measurements, InstructionSet set)
    : operations_per_second_(measurements.median(arithmetic_name(set), operation_rate)) {
  for (const MemoryLevel& level : memory_levels()) {
    bytes_per_second_.push_back(measurements.median(triad_name(level, set), byte_rate));
  }
}

std::optional<Machine::Roof> Machine::roof(double operations, double bytes, double working_set) const {
  const auto level = std::find_if(memory_levels().begin(), memory_levels().end(),
                                  [&](const MemoryLevel& l) { return working_set <= static_cast<double>(l.capacity); });
  const auto rate = bytes_per_second_.at(static_cast<std::size_t>(level - memory_levels().begin()));
  if (!operations_per_second_ || !rate) return std::nullopt;
  constexpr double nanoseconds = 1e9;
  const double of_arithmetic = nanoseconds * operations / *operations_per_second_;
  const double of_memory = nanoseconds * bytes / *rate;
  if (of_arithmetic >= of_memory) return Roof{.nanoseconds = of_arithmetic, .limit = "arithmetic"};
  return Roof{.nanoseconds = of_memory, .limit = level->name};
}

}  // namespace dmocbench::speed
