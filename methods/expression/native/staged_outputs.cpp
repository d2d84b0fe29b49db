#include "methods/expression/native/staged_outputs.hpp"

#include <algorithm>

namespace dmocbench {

namespace {

/// Lines this far apart share a place in caches of 32 KB with 8 ways, and of 48 KB with 12.
constexpr std::size_t period_bytes = 4096;
constexpr std::size_t line_bytes = 64;
/// The most lines that share a place. With 12 ways, staging becomes the faster way between 10 and 15 outputs.
constexpr std::size_t most_sharing = 12;

}  // namespace

StagedOutputs::StagedOutputs(std::size_t count, std::uint32_t first_output, std::uint32_t first_column)
    : first_output_(first_output),
      first_column_(first_column),
      series_(std::make_unique_for_overwrite<Series[]>(count)) {  // NOLINT(*-avoid-c-arrays)
  copies_.reserve(count);
  for (std::uint32_t j = 0; j < count; ++j) copies_.push_back(copy_instruction(first_output + j, first_column + j));
}

bool StagedOutputs::are_needed(std::span<double* const> columns) noexcept {
  if (columns.size() <= most_sharing) return false;
  std::array<std::size_t, period_bytes / line_bytes> sharing{};
  for (const double* column : columns) {
    const auto address = reinterpret_cast<std::uintptr_t>(column);  // NOLINT: its place in the cache
    const std::size_t first = address % period_bytes / line_bytes;
    // A vector that does not begin with a line takes two.
    const std::size_t last = (address + line_bytes - 1) % period_bytes / line_bytes;
    ++sharing[first];
    if (last != first) ++sharing[last];
  }
  return *std::ranges::max_element(sharing) > most_sharing;
}

void StagedOutputs::redirect(std::span<double*> table) noexcept {
  for (std::size_t j = 0; j < copies_.size(); ++j) {
    table[first_column_ + j] = table[first_output_ + j];
    table[first_output_ + j] = series_[j].numbers.data();
  }
}

}  // namespace dmocbench
