// Included by segment_kernel.cpp alone, see lanes.hpp.

/// Steps of a segment whose numbers are collected together: eight, so that whole cache lines are read.
inline constexpr int block_steps = 8;

inline Lanes load(const double* from) {
  Lanes lanes;
  __builtin_memcpy(&lanes.v, from, sizeof lanes.v);
  return lanes;
}

/// The interval of a lane at a step. Lanes whose segment is shorter repeat an interval there.
inline std::ptrdiff_t interval_at(const SegmentGroup& group, int lane, int step) {
  const int inside = step < group.length[lane] ? step : group.length[lane] - 1;
  return group.first[lane] + (inside > 0 ? inside : 0);
}

/// Reads entry `first` + interval - `lag` of `array` for the steps `begin` .. `begin` + `count` - 1 of every lane; 0
/// where there is no such interval.
inline void read_block(const double* array, const SegmentGroup& group, int begin, int count, int lag,
                       Lanes (&block)[8]) {
  const bool all_there = count == block_steps && begin + count <= group.shortest && group.first[0] + begin - lag >= 0;
  if (all_there) {
    array -= lag;
    Lanes::Vector rows[8];
    for (int lane = 0; lane < lane_count; ++lane) {
      __builtin_memcpy(&rows[lane], array + group.first[lane] + begin, sizeof rows[lane]);
    }
    transpose(rows);
    for (int step = 0; step < block_steps; ++step) block[step].v = rows[step];
    return;
  }
  for (int step = 0; step < count; ++step) {
    for (int lane = 0; lane < lane_count; ++lane) {
      const std::ptrdiff_t interval = interval_at(group, lane, begin + step) - lag;
      block[step].v[lane] = interval >= 0 ? array[interval] : 0.0;
    }
  }
}

/// Asks for the cache lines that hold some steps of every lane. These are hundreds of places in memory, more than the
/// processor itself follows. An address outside of the array does no harm.
inline void fetch(const double* array, const SegmentGroup& group, int step) {
  for (int lane = 0; lane < lane_count; ++lane) __builtin_prefetch(array + group.first[lane] + step);
}

/// Fills the local blocks of some steps; entries that nothing is collected for are left alone. What is collected next
/// is `ahead` steps from here; 0 if it is in the cache anyway.
inline void collect(const EliminationPlan& plan, const NewtonArrays& arrays, const SegmentGroup& group, int begin,
                    int count, int ahead, Lanes* locals, int local_size) {
  Lanes block[8];
  for (const Collected& item : plan.collected) {
    if (ahead != 0) fetch(arrays.of(item.source) + item.first, group, begin + ahead);
    read_block(arrays.of(item.source) + item.first, group, begin, count, item.from_before ? 1 : 0, block);
    if (item.adds) {
      for (int step = 0; step < count; ++step) block[step] += locals[step * local_size + item.slot];
    }
    for (int step = 0; step < count; ++step) locals[step * local_size + item.slot] = block[step];
    if (item.mirror == item.slot) continue;
    for (int step = 0; step < count; ++step) locals[step * local_size + item.mirror] = block[step];
  }
}

/// Writes what `block` holds for the steps `begin` .. to entry `first` + interval of `array`.
inline void write_block(const Lanes (&block)[8], const SegmentGroup& group, int begin, int count, double* array) {
  const bool all_there = count == block_steps && begin + count <= group.shortest;
  if (all_there) {
    Lanes::Vector rows[8];
    for (int step = 0; step < block_steps; ++step) rows[step] = block[step].v;
    transpose(rows);
    for (int lane = 0; lane < lane_count; ++lane) {
      __builtin_memcpy(array + group.first[lane] + begin, &rows[lane], sizeof rows[lane]);
    }
    return;
  }
  for (int step = 0; step < count; ++step) {
    for (int lane = 0; lane < lane_count; ++lane) {
      if (begin + step < group.length[lane]) array[group.first[lane] + begin + step] = block[step].v[lane];
    }
  }
}
