#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace dmocbench {

/// A family of vector instructions that kernels are compiled for: tapes, loops over vectors, eliminations of segments.
enum class InstructionSet : std::uint8_t { baseline, avx2, avx512 };

/// "baseline", "avx2" or "avx512".
[[nodiscard]] std::string_view name_of(InstructionSet set) noexcept;

/// The sets that this processor has and this library was built with, narrowest first; never empty.
[[nodiscard]] std::span<const InstructionSet> available_instruction_sets();

/// The set that every kernel runs with unless its maker is given another: the widest available one, or that which the
/// environment variable DMOCBENCH_INSTRUCTION_SET names. Throws `Error` if that one is not available.
[[nodiscard]] InstructionSet preferred_instruction_set();

/// The version compiled for a set, out of versions for each, narrowest first (`dmocbench_kernel` in
/// methods/CMakeLists.txt); the widest one there is where the set is wider than all of them.
template <class Compiled, std::size_t count>
[[nodiscard]] constexpr const Compiled& compiled_for(InstructionSet set, const std::array<Compiled, count>& compiled) {
  return compiled[std::min(static_cast<std::size_t>(set), count - 1)];
}

}  // namespace dmocbench

/// The versions of a function or an object, `name`_baseline and so on, for `std::array`.
// NOLINTBEGIN(cppcoreguidelines-macro-usage): it makes names
#ifdef DMOCBENCH_X86_KERNELS
#define DMOCBENCH_VERSIONS(name) name##_baseline, name##_avx2, name##_avx512
#else
#define DMOCBENCH_VERSIONS(name) name##_baseline
#endif
// NOLINTEND(cppcoreguidelines-macro-usage)
