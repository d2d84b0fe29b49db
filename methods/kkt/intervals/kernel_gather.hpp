#pragma once

#include <cstddef>

#include "methods/kkt/intervals/kernel_blocks.hpp"

// Reads blocks of steps from the program's arrays and writes them.
// NOLINTBEGIN(*-avoid-c-arrays,*-member-init): arrays that live in registers
namespace dmocbench::kkt {
inline namespace DMOCBENCH_LANES {

/// Steps of a segment whose numbers are gathered together: eight, so that whole cache lines are read.
inline constexpr int block_steps = 8;

/// Some steps of all segments, at most `block_steps`.
struct StepBlock {
  int begin;
  int count;
};

/// Rows become columns: entry j of `rows[i]` becomes entry i of `rows[j]`.
inline void transpose(Lanes::Vector (&rows)[8]) {
  Lanes::Vector pairs[8];
  for (int i = 0; i < 8; i += 2) {
    pairs[i] = __builtin_shufflevector(rows[i], rows[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    pairs[i + 1] = __builtin_shufflevector(rows[i], rows[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  Lanes::Vector fours[8];
  for (int i = 0; i < 8; i += 4) {
    for (int j = 0; j < 2; ++j) {
      fours[i + j] = __builtin_shufflevector(pairs[i + j], pairs[i + j + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      fours[i + j + 2] = __builtin_shufflevector(pairs[i + j], pairs[i + j + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (int j = 0; j < 4; ++j) {
    rows[j] = __builtin_shufflevector(fours[j], fours[j + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    rows[j + 4] = __builtin_shufflevector(fours[j], fours[j + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

/// The interval of a lane at a step. A lane whose segment is shorter repeats an interval there.
inline std::ptrdiff_t interval_at(const SegmentGroup& group, std::size_t lane, int step) {
  const int inside = step < group.length[lane] ? step : group.length[lane] - 1;
  return group.first[lane] + (inside > 0 ? inside : 0);
}

/// Reads entry `first` + interval - `lag` of `array`, for a `lag` of 0 or 1, for the steps of a block, of every lane; 0
/// where there is no such interval. In a shorter block the remaining entries are undefined.
inline void read_block(const double* array, const SegmentGroup& group, const StepBlock& steps, int lag,
                       Lanes (&block)[block_steps]) {
  // The last lane, which reads farthest, is the longest.
  if (steps.begin + block_steps <= group.steps) {
    Lanes::Vector rows[block_steps];
    std::size_t lane = 0;
    if (group.first[0] + steps.begin < lag) {
      __builtin_memcpy(&rows[0], array, sizeof rows[0]);
      rows[0] = __builtin_shufflevector(rows[0], Lanes::Vector{}, 8, 0, 1, 2, 3, 4, 5, 6);
      lane = 1;
    }
    for (; lane < lane_count; ++lane) {
      __builtin_memcpy(&rows[lane], array - lag + group.first[lane] + steps.begin, sizeof rows[lane]);
    }
    transpose(rows);
    __builtin_memcpy(block, rows, sizeof rows);
    return;
  }
  for (int step = 0; step < steps.count; ++step) {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const std::ptrdiff_t interval = interval_at(group, lane, steps.begin + step) - lag;
      block[step].set(lane, interval >= 0 ? array[interval] : 0.0);
    }
  }
}

/// Writes the steps of a block to entry `first` + interval of `array`.
inline void write_block(const Lanes* block, const SegmentGroup& group, const StepBlock& steps, double* array) {
  if (steps.count == block_steps && steps.begin + block_steps <= group.shortest) {
    Lanes::Vector rows[block_steps];
    __builtin_memcpy(rows, block, sizeof rows);
    transpose(rows);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      __builtin_memcpy(array + group.first[lane] + steps.begin, &rows[lane], sizeof rows[lane]);
    }
    return;
  }
  for (int step = 0; step < steps.count; ++step) {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const int at = steps.begin + step;
      if (at < group.length[lane]) array[group.first[lane] + at] = block[step][lane];
    }
  }
}

inline Lanes load_lanes(const double* from) {
  Lanes lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

/// Prefetches the cache lines that hold some steps of every lane. These are hundreds of places in memory, more than the
/// processor follows by itself. An address outside of the array does no harm.
inline void prefetch(const double* array, const SegmentGroup& group, int step) {
  for (std::size_t lane = 0; lane < lane_count; ++lane) __builtin_prefetch(array + group.first[lane] + step);
}

/// `gather` of interleaved lanes: the input of a step has the order of the blocks.
inline void gather_interleaved(const EliminationPlan& plan, const NewtonArrays& arrays, const StepBlock& steps,
                               const MatrixView<Lanes>& locals) {
  for (const Gather& item : plan.gathers) {
    const std::ptrdiff_t first = item.first + steps.begin - (item.from_before ? 1 : 0);
    const double* const array = arrays.of(item.source) + first * lane_count;
    for (int step = item.from_before && steps.begin == 0 ? 1 : 0; step < steps.count; ++step) {
      Lanes numbers = load_lanes(array + std::ptrdiff_t{step} * lane_count);
      if (item.adds) numbers += locals(item.slot, step);
      locals(item.slot, step) = numbers;
      locals(item.mirror, step) = numbers;
    }
    if (item.from_before && steps.begin == 0 && !item.adds) {
      locals(item.slot, 0) = Lanes{};
      locals(item.mirror, 0) = Lanes{};
    }
  }
}

/// Fills the local blocks of some steps; entries that nothing is gathered for keep their values. `ahead`: the distance
/// to the steps that are gathered next, 0 where these are in the cache anyway.
inline void gather(const EliminationPlan& plan, const NewtonArrays& arrays, const SegmentGroup& group,
                   const StepBlock& steps, int ahead, const MatrixView<Lanes>& locals) {
  if (group.is_interleaved) return gather_interleaved(plan, arrays, steps, locals);
  Lanes block[block_steps];
  for (const Gather& item : plan.gathers) {
    const double* const array = arrays.of(item.source) + item.first;
    if (ahead != 0) prefetch(array, group, steps.begin + ahead);
    read_block(array, group, steps, item.from_before ? 1 : 0, block);
    if (item.adds) {
      for (int step = 0; step < steps.count; ++step) block[step] += locals(item.slot, step);
    }
    for (int step = 0; step < steps.count; ++step) locals(item.slot, step) = block[step];
    if (item.mirror == item.slot) continue;
    for (int step = 0; step < steps.count; ++step) locals(item.mirror, step) = block[step];
  }
}

}  // namespace DMOCBENCH_LANES
}  // namespace dmocbench::kkt
// NOLINTEND(*-avoid-c-arrays,*-member-init)
