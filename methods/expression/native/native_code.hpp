#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "methods/expression/native/native_plan.hpp"
#include "methods/expression/tape_kernel.hpp"
#include "methods/runtime/instruction_set.hpp"

namespace dmocbench {

/// Machine code for the stages of a plan, made while the program runs.
///
/// For each vector of intervals a stage loads its operands, computes in registers and stores the results that others
/// read, by the operations of the tape's kernel, so that values are the same bit by bit; functions are the kernel's
/// own. Threads may share it.
struct NativeCode {
  /// A stage of the plan.
  struct Stage {
    /// Its arithmetic on the first `width` numbers of the series; at least `vector_width`.
    ///
    /// Vectors follow each other; the last one ends with the last number, and computes again the intervals that the one
    /// before it has in common with it. As nothing is overwritten that a stage reads, the values are the same.
    void (*arithmetic)(double* const* series, std::size_t width);
    std::vector<TapeInstruction> functions;  ///< carried out next
  };
  std::vector<Stage> stages;           ///< one after the other
  std::size_t vector_width = 0;        ///< numbers that are computed together
  std::size_t slots = 0;               ///< of the plan
  std::shared_ptr<const void> memory;  ///< in which the code is

  /// Evaluates the first `width` >= `vector_width` intervals of the series.
  void run(TapeKernel kernel, double* const* series, std::size_t width) const {
    for (const Stage& stage : stages) {
      stage.arithmetic(series, width);
      if (!stage.functions.empty()) kernel(stage.functions.data(), stage.functions.size(), series, width);
    }
  }
};

/// Whether this library can make machine code for an instruction set: AVX2 and AVX-512, if it was built with xbyak.
[[nodiscard]] bool has_native_code(InstructionSet set) noexcept;

/// The code for a plan; null where there can be none: no code for the set, or no executable memory from the system.
[[nodiscard]] std::unique_ptr<const NativeCode> make_native_code(const NativePlan& plan, InstructionSet set);

}  // namespace dmocbench
