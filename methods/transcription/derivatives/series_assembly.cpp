#include "methods/transcription/derivatives/series_assembly.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "methods/error.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/runtime/vector_loops.hpp"

namespace dmocbench {

SeriesAssembly::SeriesAssembly(AssemblyPlan plan) : plan_(std::move(plan)), columns_(plan_.places.size()) {
  std::vector<std::size_t> order(columns_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t column) { return plan_.places[column].first; });
  std::size_t covered = 0;  // entries below are written, set to zero or added to
  const auto zero_until = [&](std::size_t end) {
    if (covered >= end || plan_.mode != AssemblyMode::whole) return;
    zeros_.push_back({covered, end});
    covered = end;
  };
  for (const std::size_t column : order) {
    const SeriesPlace& place = plan_.places[column];
    const std::size_t end = place.at(plan_.intervals - 1) + 1;
    if (end > plan_.size) throw Error("a column exceeds the array into which it is assembled");
    if (plan_.mode == AssemblyMode::part || place.is_global || place.first < covered) {
      additions_.push_back({column, additions_.size() * plan_.intervals});
      zero_until(end);
    } else {
      zero_until(place.first);
      covered = end;
    }
  }
  zero_until(plan_.size);
  scratch_.resize(additions_.size() * plan_.intervals);
}

std::span<double* const> SeriesAssembly::open(VectorOut& result) {
  if (static_cast<std::size_t>(result.size()) != plan_.size) {
    throw Error("columns are assembled into an array of the wrong length");
  }
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    columns_[column] = result.data() + plan_.places[column].first;
  }
  for (const Addition& addition : additions_) columns_[addition.column] = scratch_.data() + addition.scratch;
  return columns_;
}

void SeriesAssembly::close(VectorOut& result) const {
  // Threads share the entries of the result and not the columns: an entry gets its contributions in the order of the
  // columns, and is still in a cache when the next one adds to it.
  constexpr std::size_t entries_per_part = 65536;
  const std::size_t parts = part_count(plan_.size, entries_per_part);
  double* const entries = result.data();
  for_each_part(parts, [&](std::size_t part) {
    const Stretch within{begin_of_part(part, parts, plan_.size), begin_of_part(part + 1, parts, plan_.size)};
    for (const Stretch& zeros : zeros_) {
      const std::size_t begin = std::max(zeros.begin, within.begin);
      const std::size_t end = std::min(zeros.end, within.end);
      if (begin < end) std::fill(entries + begin, entries + end, 0.0);
    }
    for (const Addition& addition : additions_) add_column(addition, within, entries);
  });
}

/// Adds the values whose entries of the result lie within a stretch.
void SeriesAssembly::add_column(const Addition& addition, Stretch within, double* result) const {
  const SeriesPlace& place = plan_.places[addition.column];
  const double* const source = scratch_.data() + addition.scratch;
  const std::size_t first = place.first;
  if (place.is_global) {
    if (first < within.begin || first >= within.end) return;
    result[first] += Eigen::Map<const Eigen::VectorXd>(source, static_cast<Eigen::Index>(intervals())).sum();
    return;
  }
  const std::size_t begin = std::max(first, within.begin);
  const std::size_t end = std::min(first + intervals(), within.end);
  if (begin >= end) return;
  double* const target = result + begin;
  vector_loops().set_to_sum(target, target, 1.0, source + (begin - first), static_cast<std::ptrdiff_t>(end - begin));
}

AssembledTape::AssembledTape(const Schedule& schedule, AssemblyPlan plan)
    : tape_(schedule), assembly_(std::move(plan)) {
  if (assembly_.columns() != tape_.output_count()) throw Error("an assembled tape needs one place per output");
  for (std::size_t part = 0; part < part_count(assembly_.intervals()); ++part) workspaces_.emplace_back(tape_);
}

void AssembledTape::evaluate(std::span<const Tape::Input> inputs, VectorOut result) {
  const auto columns = assembly_.open(result);
  const std::size_t parts = workspaces_.size();
  const auto begin_of = [&](std::size_t part) {
    return begin_of_part(part, parts, assembly_.intervals(), Tape::block_width);
  };
  for_each_part(parts, [&](std::size_t part) {
    tape_.evaluate(begin_of(part), begin_of(part + 1), inputs, columns, workspaces_[part]);
  });
  assembly_.close(result);
}

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
