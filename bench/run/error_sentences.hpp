#pragma once

#include <exception>
#include <string>

namespace dmocbench {

/// True if memory was exhausted; other work may still have enough.
[[nodiscard]] bool is_out_of_memory(const std::exception& error) noexcept;

/// An error message for people: our own errors verbatim; other errors by their meaning, where that is known.
[[nodiscard]] std::string sentence_of(const std::exception& error);

}  // namespace dmocbench
