#pragma once

#include <string>
#include <string_view>

namespace dmocbench {

/// A text as HTML shows it, in elements and in attributes with double quotes; invalid UTF-8 becomes a question mark.
[[nodiscard]] std::string escaped(std::string_view text);

/// The same between elements: numbers with an exponent stay on one line.
[[nodiscard]] std::string escaped_prose(std::string_view text);

/// "two_link_manipulator/state_slope" as a name for links within the page: letters, digits and dashes.
[[nodiscard]] std::string anchor(std::string_view kind, std::string_view name);

/// A path that is not absolute as a link: it leads to a file whatever letters it holds.
[[nodiscard]] std::string link_to_file(std::string_view path);

/// Bytes in the letters of base64.
[[nodiscard]] std::string base64(std::string_view bytes);

/// "two link manipulator" of "two_link_manipulator".
[[nodiscard]] std::string in_words(std::string_view name);

/// "Multiple shooting, rk4, 1 step" of the method "multiple_shooting_rk4_1", "DMOC" of "dmoc"; other names in words.
[[nodiscard]] std::string method_in_words(std::string_view method);

/// A field of a table for readers: numbers with six digits.
[[nodiscard]] std::string shortened(const std::string& field);

}  // namespace dmocbench
