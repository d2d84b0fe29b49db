#pragma once

#include <cstdint>
#include <string_view>

namespace dmocbench {

/// Whether tapes are turned into machine code while the program runs. Values are the same bit by bit.
enum class NativeCodeUse : std::uint8_t {
  when_worthwhile,  ///< a tape that has been evaluated so often that its code saves more time than making it takes
  never,            ///< none: all are interpreted
  always,           ///< every tape as soon as it is made
};

/// "when_worthwhile", "never" or "always".
[[nodiscard]] std::string_view name_of_use(NativeCodeUse use) noexcept;

/// The default for tapes: `when_worthwhile`, or the value that the environment variable
/// DMOCBENCH_NATIVE_CODE names. Throws `Error` if it names none of the three.
[[nodiscard]] NativeCodeUse preferred_native_code_use();

}  // namespace dmocbench
