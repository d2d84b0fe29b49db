#include "methods/transcription/assembled_tape.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "methods/error.hpp"

namespace dmocbench {

AssembledTape::AssembledTape(const Schedule& schedule, const std::vector<std::size_t>& firsts, std::size_t size,
                             std::size_t intervals)
    : tape_(schedule), workspace_(tape_), assembly_(firsts, size, intervals) {
  if (firsts.size() != tape_.output_count()) throw Error("an assembled tape needs one place per output");
}

void AssembledTape::evaluate(std::span<const Tape::Input> inputs, VectorOut result) {
  tape_.evaluate(assembly_.intervals(), inputs, assembly_.open(result), workspace_);
  assembly_.close(result);
}

AssembledPattern assemble_pattern(const std::vector<std::size_t>& row_firsts,
                                  const std::vector<std::size_t>& column_firsts, std::size_t intervals) {
  // A run is a stretch of a diagonal: one local entry over all intervals, or two that meet at the nodes.
  struct Run {
    std::size_t row;
    std::size_t column;
    std::size_t length;
    std::size_t begin = 0;
  };
  std::vector<std::pair<std::size_t, std::size_t>> positions;
  for (std::size_t e = 0; e < row_firsts.size(); ++e) positions.emplace_back(row_firsts[e], column_firsts[e]);

  std::map<std::pair<std::size_t, std::size_t>, std::size_t> run_at;  // position of a run's head -> number of the run
  std::vector<Run> runs;
  std::vector<std::pair<std::size_t, std::size_t>> place_of(positions.size());  // run, offset
  std::vector<std::size_t> order(positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return positions[a] < positions[b]; });
  for (const std::size_t e : order) {
    const auto [row, column] = positions[e];
    const auto same = run_at.find({row, column});
    const auto left = row > 0 && column > 0 ? run_at.find({row - 1, column - 1}) : run_at.end();
    if (same != run_at.end()) {
      place_of[e] = {same->second, 0};
    } else if (left != run_at.end()) {
      runs[left->second].length = intervals + 1;
      place_of[e] = {left->second, 1};
    } else {
      run_at[{row, column}] = runs.size();
      place_of[e] = {runs.size(), 0};
      runs.push_back({row, column, intervals});
    }
  }
  AssembledPattern assembled;
  for (Run& run : runs) {
    run.begin = assembled.pattern.size();
    for (std::size_t k = 0; k < run.length; ++k) {
      assembled.pattern.rows.push_back(static_cast<int>(run.row + k));
      assembled.pattern.columns.push_back(static_cast<int>(run.column + k));
    }
  }
  for (const auto& [run, offset] : place_of) assembled.firsts.push_back(runs[run].begin + offset);
  return assembled;
}

}  // namespace dmocbench
