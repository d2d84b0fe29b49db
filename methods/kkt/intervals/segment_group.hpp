#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "methods/kkt/intervals/segment_kernel.hpp"

namespace dmocbench::kkt {

/// The smallest trusted pivot of the equalities, relative to the pivots by which the order of elimination was chosen.
inline constexpr double smallest_trusted_ratio = 1e-7;

/// One number of every lane, aligned as vector registers require.
struct alignas(lane_count * sizeof(double)) NumberLine {
  std::array<double, lane_count> numbers;
};
// NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): a vector would write zeros
using NumberLines = std::unique_ptr<NumberLine[]>;

/// Eight segments and their memory, which is first touched by the thread that fills it.
class GroupMemory {
 public:
  /// Memory for the intervals `begin` to `end` - 1. Where `keeps_records` is false the forward sweep makes them again.
  GroupMemory(const Shape& shape, std::size_t begin, std::size_t end, bool keeps_records);

  /// Memory for eight instances, one per lane, with as many intervals each.
  [[nodiscard]] static GroupMemory of_instances(const Shape& shape, std::size_t intervals);

  /// Makes room for a plan's sweeps: `numbers` is SegmentKernel::workspace_size of it.
  void make_workspace(std::size_t numbers);

  [[nodiscard]] SegmentGroup& group() noexcept { return group_; }
  [[nodiscard]] const SegmentGroup& group() const noexcept { return group_; }

 private:
  GroupMemory() = default;
  void allocate(const Shape& shape);

  SegmentGroup group_;
  NumberLines blocks_;
  NumberLines workspace_;
};

/// Cuts the horizon into groups of eight segments: one for a short one, and one per part of a long one (parallel.hpp),
/// whose groups threads share.
[[nodiscard]] std::vector<GroupMemory> cut_into_groups(const Shape& shape, std::size_t intervals);

/// The kernel for a shape, of the preferred instruction set.
[[nodiscard]] SegmentKernel segment_kernel_for(const Shape& shape);
/// The choice among the kernels of a set.
[[nodiscard]] SegmentKernelChoice segment_kernels_of(InstructionSet set);

}  // namespace dmocbench::kkt
