#include "bench/report/words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "methods/transcription/elements/families.hpp"

namespace dmocbench {

namespace {

/// "galerkin_2_1_shared": the label, degree 2, 1 shared control node.
std::string galerkin_in_words(const Family& family, std::string_view method) {
  std::string spaces(method.substr(family.name.size() + 1));
  const std::size_t bar = spaces.find('_');
  if (bar == std::string::npos) return in_words(method);
  return fmt::format("{}, degree {}, control nodes {}", family.label, spaces.substr(0, bar),
                     in_words(spaces.substr(bar + 1)));
}

/// "10⁻¹²" of -12.
std::string power_of_ten(int exponent) {
  constexpr std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = "10";
  for (const char letter : fmt::format("{}", exponent))
    text += letter == '-' ? "⁻" : digits[static_cast<std::size_t>(letter - '0')];
  return text;
}

}  // namespace

std::string scientific(double value) {
  const std::string text = fmt::format("{:.0e}", value);  // "3e-12"
  const std::size_t e = text.find('e');
  return e == std::string::npos ? text : text.substr(0, e) + "·" + power_of_ten(std::stoi(text.substr(e + 1)));
}

std::string tick(double value) {
  const bool is_short = value >= 0.01 && value <= 9999.0;
  return is_short ? fmt::format("{:g}", value) : power_of_ten(static_cast<int>(std::lround(std::log10(value))));
}

std::string verdict_in_words(std::string_view verdict, std::string_view whose, std::size_t count) {
  const bool is_own = whose == "ours" || whose == "extension";
  if (verdict == "reproduced" && is_own) return count == 1 ? "holds" : "hold";
  if (verdict == "differs" && is_own) return count == 1 ? "does not hold" : "do not hold";
  return verdict == "differs" && count != 1 ? "differ" : std::string(verdict);
}

std::string in_words(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string method_in_words(std::string_view method) {
  for (const Family& family : registered_families()) {
    if (method == family.name) return std::string(family.label);
    if (family.suffix == MethodSuffix::none || !method.starts_with(std::string(family.name) + "_")) continue;
    if (family.suffix == MethodSuffix::spaces) return galerkin_in_words(family, method);
    const std::string_view integration = method.substr(family.name.size() + 1);
    const std::size_t steps = integration.rfind('_');
    if (steps == std::string_view::npos) break;
    const std::string_view count = integration.substr(steps + 1);
    return fmt::format("{}, {}, {} {}", family.label, in_words(integration.substr(0, steps)), count,
                       count == "1" ? "step" : "steps");
  }
  return in_words(method);
}

std::string link_to_file(std::string_view path) {
  std::string link = "./";
  for (const char letter : path) {
    const auto byte = static_cast<unsigned char>(letter);
    if (std::isalnum(byte) != 0 || std::string_view("/._-~").find(letter) != std::string_view::npos) {
      link += letter;
    } else {
      link += fmt::format("%{:02X}", byte);
    }
  }
  return link;
}

std::string without_folders(const std::string& word) {
  const std::size_t equals = word.find("=/");
  const std::size_t begin = word.starts_with('/') ? 0 : equals == std::string::npos ? equals : equals + 1;
  const std::size_t end = word.find_last_not_of('/');  // of the name, without "/" at the end
  if (begin >= word.size() || end == std::string::npos || end < begin) return word;
  const std::size_t name = word.rfind('/', end) + 1;
  return word.substr(0, begin) + word.substr(name, end + 1 - name);
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      group = group << 8U | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
    for (const unsigned shift : {18U, 12U, 6U, 0U}) text += letters[group >> shift & 63U];
  }
  std::fill_n(text.rbegin(), (3 - bytes.size() % 3) % 3, '=');
  return text;
}

}  // namespace dmocbench
