#pragma once

#include <string>
#include <string_view>

namespace dmocbench {

/// "two link manipulator" of "two_link_manipulator".
[[nodiscard]] std::string in_words(std::string_view name);

/// "Multiple shooting, rk4, 1 step" of the method "multiple_shooting_rk4_1", "DMOC" of "dmoc"; other names in words.
[[nodiscard]] std::string method_in_words(std::string_view method);

/// A path that is not absolute as a link: it leads to a file whatever letters it holds.
[[nodiscard]] std::string link_to_file(std::string_view path);

/// Bytes in the letters of base64.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace dmocbench
