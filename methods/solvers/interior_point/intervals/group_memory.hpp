#pragma once

#include <cstddef>
#include <vector>

#include "methods/runtime/lane_array.hpp"
#include "methods/solvers/interior_point/intervals/segment_kernel.hpp"

namespace dmocbench::interior_point {

/// Eight segments and their memory.
class GroupMemory {
 public:
  /// Of the intervals `begin` .. `end` - 1. Where `keeps_records` is false the forward sweep makes them again.
  GroupMemory(const Shape& shape, std::size_t begin, std::size_t end, bool keeps_records);

  /// Makes room for a plan's sweeps: `numbers` is SegmentKernel::workspace_size of it.
  void make_workspace(std::size_t numbers);

  [[nodiscard]] SegmentGroup& group() noexcept { return group_; }
  [[nodiscard]] const SegmentGroup& group() const noexcept { return group_; }

 private:
  SegmentGroup group_;
  LaneArray records_;
  LaneArray checkpoints_;
  LaneArray workspace_;
  LaneArray value_;
  LaneArray reach_;
  LaneArray state_;
  LaneArray multiplier_;
};

/// Cuts the horizon into groups of eight segments: one for a short one, and one per part of a long one (parallel.hpp),
/// whose groups threads share.
[[nodiscard]] std::vector<GroupMemory> cut_into_groups(const Shape& shape, std::size_t intervals);

}  // namespace dmocbench::interior_point
