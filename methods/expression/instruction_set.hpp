#pragma once

#include <string_view>
#include <vector>

namespace dmocbench {

/// A family of vector instructions the tape's kernel is compiled for.
enum class InstructionSet { baseline, avx2, avx512 };

/// "baseline", "avx2" or "avx512".
[[nodiscard]] std::string_view name_of(InstructionSet set) noexcept;

/// The sets that this processor has and this library was built with, narrowest first; never empty.
[[nodiscard]] const std::vector<InstructionSet>& available_instruction_sets();

/// The widest available set, unless the environment variable DMOCBENCH_INSTRUCTION_SET names another available one.
/// Throws `Error` if the variable names a set that is not available.
[[nodiscard]] InstructionSet preferred_instruction_set();

}  // namespace dmocbench
