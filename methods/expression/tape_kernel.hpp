#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dmocbench {

/// Intervals evaluated together: 128 numbers are a kilobyte, so some 30 series stay in a first-level cache.
inline constexpr std::size_t tape_block_width = 128;

/// Operands an instruction has at most.
inline constexpr std::size_t most_operands = 4;

/// One operation on whole series of numbers, one number per interval. Results and operands are positions in a table of
/// series.
struct TapeInstruction {
  std::uint32_t code;  ///< an `instruction_code`
  std::uint32_t result;
  std::uint32_t second_result;  ///< the cosine beside a sine
  std::array<std::uint32_t, most_operands> operands;
  double exponent;  ///< of a power
};

/// Carries out `instructions` on the first `width` (<= tape_block_width) numbers of the series that they name. Nothing
/// is read or written beyond `width`.
using TapeKernel = void (*)(const TapeInstruction* instructions, std::size_t count, double* const* series,
                            std::size_t width);

// The same source, tape_kernel.cpp, compiled once per instruction set.
void run_tape_baseline(const TapeInstruction* instructions, std::size_t count, double* const* series,
                       std::size_t width);
void run_tape_avx2(const TapeInstruction* instructions, std::size_t count, double* const* series, std::size_t width);
void run_tape_avx512(const TapeInstruction* instructions, std::size_t count, double* const* series, std::size_t width);

}  // namespace dmocbench
