#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "methods/expression/replay.hpp"
#include "methods/expression/tape.hpp"
#include "tests/expression/terms.hpp"

namespace dmocbench::tests {

/// Entry k belongs to interval k. Every series is a block of memory of its own, not one number
/// longer than it has to be, so that a sanitizer notices a step beyond its end.
using SeriesTable = std::vector<std::vector<double>>;

/// Numbers of intervals around the widths of vectors and blocks.
inline const std::vector<std::size_t>& interval_counts() {
  static const std::vector<std::size_t> counts{0, 1, 2, 3, 7, 8, 9, 63, 64, 65, 127, 128, 1000};
  return counts;
}

/// The outputs of a tape whose inputs all vary.
inline SeriesTable evaluate(const Tape& tape, const SeriesTable& inputs, std::size_t count) {
  SeriesTable outputs(tape.output_count(), std::vector<double>(count));
  std::vector<Tape::Input> places;
  places.reserve(inputs.size());
  for (const std::vector<double>& series : inputs) places.push_back({series.data(), false});
  std::vector<double*> results;
  results.reserve(outputs.size());
  for (std::vector<double>& series : outputs) results.push_back(series.data());
  Tape::Workspace workspace(tape);
  tape.evaluate(count, places, results, workspace);
  return outputs;
}

/// The outputs in one interval, step by step and with the sum of the magnitudes of their terms.
inline std::vector<Terms> replay_interval(const Schedule& schedule, const SeriesTable& inputs, std::size_t interval) {
  std::vector<Terms> numbers;
  numbers.reserve(inputs.size());
  for (const std::vector<double>& series : inputs) numbers.emplace_back(series[interval]);
  return replay<Terms>(schedule, std::span<const Terms>(numbers));
}

}  // namespace dmocbench::tests
