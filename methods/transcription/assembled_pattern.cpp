#include "methods/transcription/assembled_pattern.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace dmocbench {

namespace {

/// A stretch of a diagonal, a row or a column: one local entry over all intervals, or two that meet at the nodes. A
/// local entry of two shared places is a single one.
struct Run {
  std::size_t row;
  std::size_t column;
  bool row_steps;
  bool column_steps;
  std::size_t length;
  std::size_t begin = 0;
};

}  // namespace

AssembledPattern assemble_pattern(const LocalEntries& entries) {
  using Head = std::tuple<std::size_t, std::size_t, bool, bool>;  // row, column, whether they step
  const std::size_t count = entries.rows.size();
  const auto head_of = [&](std::size_t e) {
    return Head{entries.rows[e].first, entries.columns[e].first, !entries.rows[e].shared, !entries.columns[e].shared};
  };
  std::map<Head, std::size_t> run_at;  // a run's head -> its number
  std::vector<Run> runs;
  std::vector<std::pair<std::size_t, std::size_t>> place_of(count);  // run, offset
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return head_of(a) < head_of(b); });
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
      runs[left->second].length = entries.intervals + 1;
      place_of[e] = {left->second, 1};
    } else {
      run_at[{row, column, row_steps, column_steps}] = runs.size();
      place_of[e] = {runs.size(), 0};
      runs.push_back({row, column, row_steps, column_steps, row_steps || column_steps ? entries.intervals : 1});
    }
  }
  AssembledPattern assembled;
  for (Run& run : runs) {
    run.begin = assembled.pattern.size();
    for (std::size_t k = 0; k < run.length; ++k) {
      assembled.pattern.rows.push_back(static_cast<int>(run.row + (run.row_steps ? k : 0)));
      assembled.pattern.columns.push_back(static_cast<int>(run.column + (run.column_steps ? k : 0)));
    }
  }
  for (const auto& [number, offset] : place_of) {
    const Run& run = runs[number];
    assembled.places.emplace_back(run.begin + offset, !run.row_steps && !run.column_steps);
  }
  return assembled;
}

std::vector<ColumnPlace> extend_pattern(SparsityPattern& pattern, const LocalEntries& entries) {
  std::map<std::pair<int, int>, std::size_t> wanted;  // position -> place in the array of values
  const std::size_t absent = pattern.size() + entries.rows.size();
  const auto position = [&](std::size_t e) {
    return std::pair(static_cast<int>(entries.rows[e].first), static_cast<int>(entries.columns[e].first));
  };
  for (std::size_t e = 0; e < entries.rows.size(); ++e) wanted.emplace(position(e), absent);
  for (std::size_t e = 0; e < pattern.size(); ++e) {
    const auto found = wanted.find({pattern.rows[e], pattern.columns[e]});
    if (found != wanted.end()) found->second = e;
  }
  std::vector<ColumnPlace> places;
  for (std::size_t e = 0; e < entries.rows.size(); ++e) {
    std::size_t& place = wanted.at(position(e));
    if (place == absent) {
      place = pattern.size();
      pattern.rows.push_back(position(e).first);
      pattern.columns.push_back(position(e).second);
    }
    places.emplace_back(place);
  }
  return places;
}

}  // namespace dmocbench
