#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace dmocbench {

/// The whole text as a number; none if it is not one.
template <class Number>
[[nodiscard]] std::optional<Number> parsed(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [read_to, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && read_to == end ? std::optional(number) : std::nullopt;
}

}  // namespace dmocbench
