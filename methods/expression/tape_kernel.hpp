#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "methods/expression/operation.hpp"

namespace dmocbench {

/// Intervals evaluated together: 128 numbers are a kilobyte, so some 30 series stay in a first-level cache.
inline constexpr std::size_t tape_block_width = 128;

/// The combinations of two numbers x and y; `subtract_from` is y - x.
enum class Combination : std::uint8_t { add, subtract, multiply, subtract_from };

/// The codes of all instructions of a tape's kernel: a single operation, sine and cosine of one number, or two or three
/// sums, differences and products whose intermediate values stay in registers. A store into the first-level cache takes
/// as long as two or three operations, so a value that has no other reader is not stored.
///
/// The innermost combination is never `subtract_from`, since its operands can be swapped.
namespace instruction_code {

inline constexpr std::size_t innermost = 3;     ///< add, subtract, multiply
inline constexpr std::size_t combinations = 4;  ///< these and subtract_from

/// The code of both at once.
inline constexpr std::size_t sine_and_cosine = static_cast<std::size_t>(Operation::unit_step) + 1;
inline constexpr std::size_t first_pair = sine_and_cosine + 1;           ///< the code of the first pair of operations
inline constexpr std::size_t pairs = innermost * combinations;           ///< how many pairs there are
inline constexpr std::size_t first_chain = first_pair + pairs;           ///< the code of the first chain of three
inline constexpr std::size_t chains = pairs * combinations;              ///< how many chains there are
inline constexpr std::size_t first_tree = first_chain + chains;          ///< the code of the first tree of three
inline constexpr std::size_t trees = innermost * innermost * innermost;  ///< how many trees there are
inline constexpr std::size_t count = first_tree + trees;                 ///< how many codes there are

/// The code of a single operation.
[[nodiscard]] constexpr std::size_t of(Operation operation) { return static_cast<std::size_t>(operation); }

/// (a ∘ b) ∘ c
[[nodiscard]] constexpr std::size_t pair(Combination inner, Combination outer) {
  return first_pair + static_cast<std::size_t>(inner) * combinations + static_cast<std::size_t>(outer);
}

/// ((a ∘ b) ∘ c) ∘ d
[[nodiscard]] constexpr std::size_t chain(Combination inner, Combination middle, Combination outer) {
  return first_chain + (pair(inner, middle) - first_pair) * combinations + static_cast<std::size_t>(outer);
}

/// (a ∘ b) ∘ (c ∘ d), none of them `subtract_from`
[[nodiscard]] constexpr std::size_t tree(Combination left, Combination right, Combination outer) {
  return first_tree + (static_cast<std::size_t>(left) * innermost + static_cast<std::size_t>(right)) * innermost +
         static_cast<std::size_t>(outer);
}

}  // namespace instruction_code

/// Operands an instruction has at most.
inline constexpr std::size_t most_operands = 4;

/// One operation on whole series of numbers, one number per interval. Results and operands are positions in a table of
/// series.
struct TapeInstruction {
  std::uint32_t code;                                 ///< an `instruction_code`
  std::uint32_t result;                               ///< the slot that is written
  std::uint32_t second_result;                        ///< the cosine with a sine
  std::array<std::uint32_t, most_operands> operands;  ///< the slots that are read
  double exponent;                                    ///< of a power
};

/// The instruction that copies a series.
[[nodiscard]] constexpr TapeInstruction copy_instruction(std::uint32_t from, std::uint32_t to) {
  return {.code = static_cast<std::uint32_t>(instruction_code::of(Operation::input)),
          .result = to,
          .second_result = to,
          .operands = {from},
          .exponent = 0.0};
}

/// Carries out `instructions` on the first `width` (<= tape_block_width) numbers of the series that they name. Nothing
/// is read or written beyond `width`.
using TapeKernel = void (*)(const TapeInstruction* instructions, std::size_t count, double* const* series,
                            std::size_t width);

// The same source, tape_kernel.cpp, compiled once per instruction set.
/// The kernel for any processor.
void run_tape_baseline(const TapeInstruction* instructions, std::size_t count, double* const* series,
                       std::size_t width);
/// The kernel for processors with AVX2.
void run_tape_avx2(const TapeInstruction* instructions, std::size_t count, double* const* series, std::size_t width);
/// The kernel for processors with AVX-512.
void run_tape_avx512(const TapeInstruction* instructions, std::size_t count, double* const* series, std::size_t width);

}  // namespace dmocbench
