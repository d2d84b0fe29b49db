#include "methods/transcription/derivatives/assembled_pattern.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace dmocbench {

AssembledPattern assemble_pattern(const LocalEntries& entries) {
  using Head = std::tuple<std::size_t, std::size_t, bool, bool>;  // row, column, whether they step
  const std::size_t count = entries.rows.size();
  const auto head_of = [&](std::size_t e) {
    return Head{entries.rows[e].first, entries.columns[e].first, !entries.rows[e].is_global,
                !entries.columns[e].is_global};
  };
  // One local entry over all intervals is a run, or two that meet at the nodes; an entry of two shared places is
  // single.
  std::map<Head, std::size_t> run_at;  // a run's head -> its number
  std::vector<PatternRun> runs;
  std::vector<std::pair<std::size_t, std::size_t>> place_of(count);  // run, offset
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return head_of(a) < head_of(b); });
  const auto intervals = static_cast<Eigen::Index>(entries.intervals);
  for (const std::size_t e : order) {
    const auto [row, column, row_steps, column_steps] = head_of(e);
    const std::size_t row_step = row_steps ? 1 : 0;
    const std::size_t column_step = column_steps ? 1 : 0;
    const bool has_left = row_step + column_step > 0 && row >= row_step && column >= column_step;
    const auto same = run_at.find({row, column, row_steps, column_steps});
    const auto left =
        has_left ? run_at.find({row - row_step, column - column_step, row_steps, column_steps}) : run_at.end();
    if (same != run_at.end()) {
      place_of[e] = {same->second, 0};
    } else if (left != run_at.end()) {
      runs[left->second].length = intervals + 1;
      place_of[e] = {left->second, 1};
    } else {
      run_at[{row, column, row_steps, column_steps}] = runs.size();
      place_of[e] = {runs.size(), 0};
      runs.push_back({.row = static_cast<Eigen::Index>(row),
                      .column = static_cast<Eigen::Index>(column),
                      .row_step = row_steps ? 1 : 0,
                      .column_step = column_steps ? 1 : 0,
                      .length = row_steps || column_steps ? intervals : 1});
    }
  }
  AssembledPattern assembled;
  for (PatternRun& run : runs) run.entry = static_cast<Eigen::Index>(assembled.pattern.append(run));
  for (const auto& [number, offset] : place_of) {
    const PatternRun& run = runs[number];
    const bool is_shared = run.row_step == 0 && run.column_step == 0;
    assembled.places.emplace_back(static_cast<std::size_t>(run.entry) + offset, is_shared);
  }
  return assembled;
}

std::vector<SeriesPlace> extend_pattern(BlockPattern& pattern, const LocalEntries& entries) {
  std::vector<SeriesPlace> places;
  for (std::size_t e = 0; e < entries.rows.size(); ++e) {
    const std::size_t row = entries.rows[e].first;
    const std::size_t column = entries.columns[e].first;
    const auto found = pattern.find(row, column);
    places.emplace_back(found ? *found : pattern.append(row, column));
  }
  return places;
}

}  // namespace dmocbench
