#include "methods/solvers/interior_point/pattern_runs.hpp"

namespace dmocbench::interior_point {

namespace {

/// How many of `size` >= 1 numbers, from the first on, are each by `step` larger than the one before.
std::size_t length_of_progression(const int* numbers, std::size_t size, int step) {
  constexpr std::size_t at_once = 64;
  std::size_t length = 1;
  const auto deviates = [&](std::size_t i) { return numbers[i] - numbers[i - 1] - step; };
  while (length + at_once <= size) {
    int deviation = 0;
    for (std::size_t i = length; i < length + at_once; ++i) deviation |= deviates(i);
    if (deviation != 0) break;
    length += at_once;
  }
  while (length < size && deviates(length) == 0) ++length;
  return length;
}

}  // namespace

std::vector<PatternRun> pattern_runs(const SparsityPattern& pattern) {
  std::vector<PatternRun> runs;
  const std::vector<int>& rows = pattern.rows;
  const std::vector<int>& columns = pattern.columns;
  const auto is_step = [](int step) { return step == 0 || step == 1; };
  for (std::size_t begin = 0; begin < pattern.size();) {
    std::size_t length = 1;
    int row_step = 0;
    int column_step = 0;
    const std::size_t rest = pattern.size() - begin;
    if (rest > 1 && is_step(rows[begin + 1] - rows[begin]) && is_step(columns[begin + 1] - columns[begin])) {
      row_step = rows[begin + 1] - rows[begin];
      column_step = columns[begin + 1] - columns[begin];
      const std::size_t in_rows = length_of_progression(rows.data() + begin, rest, row_step);
      length = length_of_progression(columns.data() + begin, in_rows, column_step);
    }
    runs.push_back({static_cast<Eigen::Index>(begin), rows[begin], columns[begin], row_step, column_step,
                    static_cast<Eigen::Index>(length)});
    begin += length;
  }
  return runs;
}

namespace {

/// Entries `begin` .. `end` - 1 of a run.
PatternRun part_of(const PatternRun& run, Eigen::Index begin, Eigen::Index end) {
  return {run.entry + begin,
          run.row + begin * run.row_step,
          run.column + begin * run.column_step,
          run.row_step,
          run.column_step,
          end - begin};
}

}  // namespace

std::vector<PatternRun> cut_at_diagonal(const std::vector<PatternRun>& runs) {
  std::vector<PatternRun> cut;
  for (const PatternRun& run : runs) {
    // Where row and column become equal, if one of them moves alone.
    const Eigen::Index step = run.row_step - run.column_step;
    const Eigen::Index meeting = step == 0 ? -1 : (run.column - run.row) / step;
    if (meeting < 0 || meeting >= run.length) {
      cut.push_back(run);
      continue;
    }
    if (meeting > 0) cut.push_back(part_of(run, 0, meeting));
    cut.push_back(part_of(run, meeting, meeting + 1));
    if (meeting + 1 < run.length) cut.push_back(part_of(run, meeting + 1, run.length));
  }
  return cut;
}

}  // namespace dmocbench::interior_point
