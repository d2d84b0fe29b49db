#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/speed/measurements.hpp"
#include "methods/runtime/instruction_set.hpp"

namespace dmocbench::speed {

/// A level of memory, and how large an array stays in it.
struct MemoryLevel {
  std::string name;            ///< "l1", "l2", "l3" or "memory"
  std::size_t capacity = 0;    ///< bytes; no limit for the last
  std::size_t triad_size = 0;  ///< bytes of the three arrays by which its rate is measured
};

/// From the fastest to the slowest, with the capacities that the system tells.
[[nodiscard]] const std::vector<MemoryLevel>& memory_levels();

/// machine/arithmetic/SET: operations per second of fused multiplications and additions on registers (separate ones
/// where the set has no fused ones); machine/triad_LEVEL/SET: bytes per second of a_i = b_i + s c_i with arrays in that
/// level.
void register_machine_benchmarks();

/// What a machine can do at most with an instruction set, by the medians of those benchmarks.
class Machine {
 public:
  Machine(const Measurements& measurements, InstructionSet set);

  /// The least time of `operations` that read and write `bytes`, and what sets it.
  struct Roof {
    double nanoseconds = 0.0;
    std::string limit;  ///< "arithmetic", or the name of the level
  };
  /// Per interval, of evaluations whose arrays together have `working_set` bytes. Nothing if a benchmark it takes was
  /// left out of the run.
  [[nodiscard]] std::optional<Roof> roof(double operations, double bytes, double working_set) const;

  [[nodiscard]] std::optional<double> operations_per_second() const { return operations_per_second_; }
  /// In the order of `memory_levels`.
  [[nodiscard]] const std::vector<std::optional<double>>& bytes_per_second() const { return bytes_per_second_; }

 private:
  std::optional<double> operations_per_second_;
  std::vector<std::optional<double>> bytes_per_second_;
};

}  // namespace dmocbench::speed
