#pragma once

#include <cstddef>
#include <cstdint>

#include "methods/expression/operation.hpp"

namespace dmocbench {

/// How two numbers x and y are combined; `subtract_from` is y - x.
enum class Combination : std::uint8_t { add, subtract, multiply, subtract_from };

/// The codes of all instructions of a tape's kernel: a single operation, sine and cosine of one number, or two or three
/// sums, differences and products whose intermediate values stay in registers. A store into the first-level cache takes
/// as long as two or three operations, so a value that has no other reader is not stored.
///
/// The innermost combination is never `subtract_from`, since its operands can be swapped.
namespace instruction_code {

inline constexpr std::size_t innermost = 3;     // add, subtract, multiply
inline constexpr std::size_t combinations = 4;  // and subtract_from

inline constexpr std::size_t sine_and_cosine = static_cast<std::size_t>(Operation::power) + 1;
inline constexpr std::size_t first_pair = sine_and_cosine + 1;
inline constexpr std::size_t pairs = innermost * combinations;
inline constexpr std::size_t first_chain = first_pair + pairs;
inline constexpr std::size_t chains = pairs * combinations;
inline constexpr std::size_t first_tree = first_chain + chains;
inline constexpr std::size_t trees = innermost * innermost * innermost;
inline constexpr std::size_t count = first_tree + trees;

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

}  // namespace dmocbench
