#pragma once

#include <cstddef>
#include <cstdint>

#include "methods/expression/operation.hpp"

namespace dmocbench {

/// Intervals evaluated together: 64 numbers are 512 bytes, so some 60 columns stay in a first-level cache.
inline constexpr std::size_t tape_block_width = 64;

/// One operation on whole columns of numbers; `result`, `left` and `right` are positions in a table of columns.
struct TapeInstruction {
  Operation operation;
  std::uint32_t result;
  std::uint32_t left;
  std::uint32_t right;
  double exponent;  ///< of a power
};

/// Carries out `instructions` on the first `width` (<= tape_block_width) numbers of the columns they name. Beyond
/// `width` nothing is read and nothing is written.
using TapeKernel = void (*)(const TapeInstruction* instructions, std::size_t count, double* const* columns,
                            std::size_t width);

// The same source, tape_kernel.cpp, compiled once per instruction set.
void run_tape_baseline(const TapeInstruction* instructions, std::size_t count, double* const* columns,
                       std::size_t width);
void run_tape_avx2(const TapeInstruction* instructions, std::size_t count, double* const* columns, std::size_t width);
void run_tape_avx512(const TapeInstruction* instructions, std::size_t count, double* const* columns, std::size_t width);

}  // namespace dmocbench
