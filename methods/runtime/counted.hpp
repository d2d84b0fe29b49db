#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace dmocbench {

/// "1 row", "3 rows"; or, with words of their own for several, "1 row has", "3 rows have".
template <std::integral Number>
[[nodiscard]] std::string counted(Number count, std::string_view one, std::string_view several = {}) {
  std::string text = std::to_string(count) + " ";
  text += count == 1 || several.empty() ? one : several;
  if (count != 1 && several.empty()) text += 's';
  return text;
}

}  // namespace dmocbench
