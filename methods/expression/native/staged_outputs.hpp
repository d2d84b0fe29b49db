#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "methods/expression/tape_kernel.hpp"

namespace dmocbench {

/// The way of machine code's outputs to columns that compete for the first-level cache.
///
/// For each vector of intervals machine code writes all outputs, one after the other. A cache keeps only a few of the
/// lines that are a multiple of 4096 bytes apart, and with 512 or 1024 intervals all columns of a program are. Where
/// there are more of them, every line leaves the cache before it is full, and the processor waits for each vector. Then
/// the code writes to series of its own, which use the whole cache, and a kernel copies them column by column.
class StagedOutputs {
 public:
  /// Stages `count` outputs. In the table of series the code finds the outputs from `first_output` on; from
  /// `first_column` on there is room for the columns that they go to.
  StagedOutputs(std::size_t count, std::uint32_t first_output, std::uint32_t first_column);

  /// Whether more of the columns share a place in the first-level cache than it has ways.
  [[nodiscard]] static bool are_needed(std::span<double* const> columns) noexcept;

  /// Puts series of this into a table in place of the outputs, and the columns that stood there after all others.
  void redirect(std::span<double*> table) noexcept;

  /// The copies from these series to the columns, for a block of intervals.
  [[nodiscard]] std::span<const TapeInstruction> copies() const noexcept { return copies_; }

 private:
  // An output of a block, and a line more, so that these do not compete either.
  struct alignas(64) Series {
    std::array<double, tape_block_width + 8> numbers;
  };

  std::uint32_t first_output_;
  std::uint32_t first_column_;
  std::vector<TapeInstruction> copies_;
  std::unique_ptr<Series[]> series_;  // NOLINT(*-avoid-c-arrays): not cleared
};

}  // namespace dmocbench
