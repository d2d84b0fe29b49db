#pragma once

#include <array>
#include <cstddef>

#include "methods/kkt/intervals/segment_kernel.hpp"

namespace dmocbench::kkt {

/// Terms of four entries of `PassInputBlocks`, `slot` to `slot` + 3: interval k adds `sign` times the entry `first` + k
/// of an array to each. The last of those with the same slot says so.
struct PassGather {
  struct Term {
    Source source{};
    bool from_before = false;  ///< reads entry `first` + k - 1, and 0 for the first interval
    std::ptrdiff_t first = 0;
    double sign = 0.0;
  };
  std::array<Term, 4> terms{};
  int slot = 0;
  bool is_last = false;
};

/// A single pass over all intervals of a horizon, the last one first, and its memory (pass_blocks.hpp).
struct Pass {
  int intervals = 0;
  double* value = nullptr;            ///< the cost-to-go
  double* records = nullptr;          ///< one per interval
  double* end_records = nullptr;      ///< the same, of intervals that carry ν
  double* workspace = nullptr;        ///< PassKernel::workspace_size numbers, zeros at first
  double* state = nullptr;            ///< X where the forward sweep is, in the workspace
  const Scatter* scatters = nullptr;  ///< with indices into `PassForwardBlocks`
  int scatter_count = 0;
  const PassGather* gathers = nullptr;
  int gather_count = 0;
  const int* unit_slots = nullptr;  ///< entries of `PassInputBlocks` that are 1
  int unit_count = 0;
  const int* places_of_rows = nullptr;  ///< of equalities, in the order of elimination
  int prepared = 0;                     ///< intervals from this one on are prepared
  double smallest_ratio = 0.0;          ///< smallest pivot of the equalities, relative to the usual one
  bool pivots_hold = true;              ///< all pivots of the inputs' Hessians are positive, beyond rounding
  bool is_negative = false;             ///< a pivot is negative, beyond doubt
};

/// The parts of a single pass for one shape and one instruction set.
struct PassKernel {
  std::size_t (*workspace_size)(const EliminationPlan& plan);
  /// Begins before the last interval, where the state is d: its node_sums last entries are `last_sums`, the others 0.
  void (*start)(const EliminationPlan& plan, const double* last_sums, Pass& pass);
  /// Eliminates intervals `end` - 1 to `begin`, as long as pivots hold; with or without ν.
  void (*backward)(const EliminationPlan& plan, const NewtonArrays& arrays, int begin, int end, bool carries_nu,
                   Pass& pass);
  /// The steps of the intervals `begin` to `end` - 1 from `Pass::state` on; `nu` is null where they do not carry it.
  void (*forward)(const EliminationPlan& plan, const Pass& pass, int begin, int end, const double* nu,
                  double* primal_step, double* multiplier_step);
};

[[nodiscard]] PassKernel pass_kernel_baseline(const Shape& shape);
[[nodiscard]] PassKernel pass_kernel_avx2(const Shape& shape);
[[nodiscard]] PassKernel pass_kernel_avx512(const Shape& shape);

}  // namespace dmocbench::kkt
