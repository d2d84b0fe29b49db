#pragma once

#include <charconv>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace dmocbench {

/// "1 row", "3 rows"; or, with words of their own for several, "1 row has", "3 rows have".
template <std::integral Number>
[[nodiscard]] std::string counted(Number count, std::string_view one, std::string_view several = {}) {
  std::string text = std::to_string(count) + " ";
  text += count == 1 || several.empty() ? one : several;
  if (count != 1 && several.empty()) text += 's';
  return text;
}

/// The whole text as a number; none if it is not one.
template <class Number>
[[nodiscard]] std::optional<Number> parsed(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [read_to, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && read_to == end ? std::optional(number) : std::nullopt;
}

}  // namespace dmocbench
