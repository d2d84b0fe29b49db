#include "methods/kkt/intervals/segment_group.hpp"

#include <algorithm>
#include <utility>

#include "methods/runtime/parallel.hpp"

namespace dmocbench::kkt {

namespace {

/// Beyond this number of intervals, their records no longer fit the second-level cache, and eliminating again is
/// not slower than fetching them (`build/bench/speed/solves` at N = 8192 and 16384).
constexpr std::size_t most_recorded = 12288;
/// The same of eight instances: as many records.
constexpr std::size_t most_recorded_of_instances = most_recorded / lane_count;
/// Intervals of a group of a long horizon: their numbers fit the second-level cache, and eight segments of an array
/// fit a few pages of memory.
constexpr std::size_t intervals_per_group = 1024;
/// Steps whose records fit there easily, a multiple of eight.
constexpr int steps_per_chunk = 16;

}  // namespace

GroupMemory::GroupMemory(const Shape& shape, std::size_t begin, std::size_t end, bool keeps_records) {
  const auto begin_of = [&](std::size_t lane) { return begin + lane * (end - begin) / lane_count; };
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    group_.first[lane] = static_cast<std::ptrdiff_t>(begin_of(lane));
    group_.length[lane] = static_cast<int>(begin_of(lane + 1) - begin_of(lane));
  }
  group_.steps = group_.length.back();
  group_.shortest = *std::ranges::min_element(group_.length);
  group_.recorded_steps = keeps_records ? group_.steps : std::min(group_.steps, steps_per_chunk);
  allocate(shape);
}

GroupMemory GroupMemory::of_instances(const Shape& shape, std::size_t intervals) {
  GroupMemory memory;
  SegmentGroup& group = memory.group_;
  group.is_interleaved = true;
  group.length.fill(static_cast<int>(intervals));
  group.steps = group.length.front();
  group.shortest = group.steps;
  group.recorded_steps = intervals <= most_recorded_of_instances ? group.steps : steps_per_chunk;
  memory.allocate(shape);
  return memory;
}

void GroupMemory::allocate(const Shape& shape) {
  const bool has_checkpoints = group_.recorded_steps < group_.steps;
  const int chunks = (group_.steps + group_.recorded_steps - 1) / group_.recorded_steps;
  const int X = state_size(shape);
  const std::array<std::pair<double**, int>, 6> blocks{{
      {&group_.records, group_.recorded_steps * RecordBlocks<Shape>{shape}.size()},
      {&group_.checkpoints, has_checkpoints ? chunks * X * (2 * X + 1) : 0},
      {&group_.value, X * (2 * X + 1)},
      {&group_.reachability, X * (X + 1)},
      {&group_.state, X},
      {&group_.multiplier, X},
  }};
  std::size_t lines = 0;
  for (const auto& [first, count] : blocks) lines += static_cast<std::size_t>(count);
  // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): a vector would write zeros
  blocks_ = std::make_unique_for_overwrite<NumberLine[]>(lines);
  NumberLine* next = blocks_.get();
  for (const auto& [first, count] : blocks) {
    *first = next->numbers.data();
    next += count;
  }
}

void GroupMemory::make_workspace(std::size_t numbers) {
  // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)
  workspace_ = std::make_unique_for_overwrite<NumberLine[]>(numbers / lane_count);
  group_.workspace = workspace_[0].numbers.data();
  group_.has_constants = false;
}

std::vector<GroupMemory> cut_into_groups(const Shape& shape, std::size_t intervals) {
  const std::size_t groups = intervals < intervals_per_part ? 1 : intervals / intervals_per_group;
  std::vector<GroupMemory> memory;
  memory.reserve(groups);
  for (std::size_t g = 0; g < groups; ++g) {
    memory.emplace_back(shape, begin_of_part(g, groups, intervals), begin_of_part(g + 1, groups, intervals),
                        intervals <= most_recorded);
  }
  return memory;
}

SegmentKernelChoice segment_kernels_of(InstructionSet set) {
  static constexpr std::array choices{DMOCBENCH_VERSIONS(segment_kernel)};
  return compiled_for(set, choices);
}

SegmentKernel segment_kernel_for(const Shape& shape) { return segment_kernels_of(preferred_instruction_set())(shape); }

}  // namespace dmocbench::kkt
