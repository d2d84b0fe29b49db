#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dmocbench {

/// "two link manipulator" of "two_link_manipulator".
[[nodiscard]] std::string in_words(std::string_view name);

/// "Multiple shooting, rk4, 1 step" of the method "multiple_shooting_rk4_1", "DMOC" of "dmoc"; other names in words.
[[nodiscard]] std::string method_in_words(std::string_view method);

/// "3·10⁻¹²": a positive number with one digit.
[[nodiscard]] std::string scientific(double value);

/// "10⁻¹²" of 1e-12, "64" of 64: a number at an axis.
[[nodiscard]] std::string tick(double value);

/// "differ" of "differs" for several statements; for statements that the paper does not make "holds" of "reproduced"
/// and "does not hold" of "differs". Other verdicts stay.
[[nodiscard]] std::string verdict_in_words(std::string_view verdict, std::string_view whose, std::size_t count = 1);

/// A path that is not absolute as a link: it leads to a file whatever letters it holds.
[[nodiscard]] std::string link_to_file(std::string_view path);

/// A word of a command line without the folders of an absolute path: "results" of "/home/a/results", "--to=b.html" of
/// "--to=/home/a/b.html". Others stay.
[[nodiscard]] std::string without_folders(const std::string& word);

/// Bytes in the letters of base64.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace dmocbench
