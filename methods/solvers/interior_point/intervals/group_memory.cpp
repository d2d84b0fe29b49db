#include "methods/solvers/interior_point/intervals/group_memory.hpp"

#include <algorithm>

#include "methods/runtime/parallel.hpp"

namespace dmocbench::interior_point {

namespace {

/// Beyond this number of intervals, records of all of them no longer fit the second-level cache, and to eliminate once
/// more is not slower than to fetch them. Measured with DMOC, whole solves: to 8,192 intervals both take the same, from
/// 16,384 on recomputing is 1.0 (orbit) to 1.4 (two-link) times faster.
constexpr std::size_t most_recorded = 12288;
/// Intervals of a group of a long horizon: what they read still fits the second-level cache, and a column's eight
/// segments a few pages of memory.
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
  group_.steps = *std::ranges::max_element(group_.length);
  group_.shortest = *std::ranges::min_element(group_.length);
  group_.recorded_steps = keeps_records ? group_.steps : std::min(group_.steps, steps_per_chunk);
  const auto make = [](LaneArray& array, std::size_t numbers) {
    array.resize(numbers * lane_count);
    return array.data();
  };
  const auto X = static_cast<std::size_t>(state_size(shape));
  const auto record = static_cast<std::size_t>(RecordBlocks<Shape>{shape}.size());
  group_.records = make(records_, static_cast<std::size_t>(group_.recorded_steps) * record);
  group_.value = make(value_, X * (2 * X + 1));
  group_.reach = make(reach_, X * (X + 1));
  group_.state = make(state_, X);
  group_.multiplier = make(multiplier_, X);
  if (group_.recorded_steps < group_.steps) {
    const int chunks = (group_.steps + group_.recorded_steps - 1) / group_.recorded_steps;
    group_.checkpoints = make(checkpoints_, static_cast<std::size_t>(chunks) * X * (2 * X + 1));
  }
}

void GroupMemory::make_workspace(std::size_t numbers) {
  workspace_.resize(numbers);
  group_.workspace = workspace_.data();
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

}  // namespace dmocbench::interior_point
