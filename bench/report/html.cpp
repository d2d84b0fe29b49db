#include "bench/report/html.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

#include <fmt/format.h>

#include "methods/runtime/parsed.hpp"
#include "methods/transcription/elements/families.hpp"

namespace dmocbench {

namespace {

/// The number of bytes of the character that begins at `i`; 0 if it is not valid.
std::size_t length_of_character(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const std::size_t length = byte(i) < 0x80                      ? 1
                             : byte(i) >= 0xC2 && byte(i) < 0xE0 ? 2
                             : byte(i) >= 0xE0 && byte(i) < 0xF0 ? 3
                             : byte(i) >= 0xF0 && byte(i) < 0xF5 ? 4
                                                                 : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = i + 1; k < i + length; ++k) {
    if ((byte(k) & 0xC0U) != 0x80U) return 0;
  }
  return length;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string html;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = length_of_character(text, i);
    switch (length == 1 ? text[i] : 'x') {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += length == 0 ? std::string_view("?") : text.substr(i, length);
    }
    i += std::max<std::size_t>(length, 1);
  }
  return html;
}

std::string escaped_prose(std::string_view text) {
  const std::string html = escaped(text);
  const auto is_digit = [&html](std::size_t k) { return std::isdigit(static_cast<unsigned char>(html[k])) != 0; };
  std::string prose;
  std::size_t told = 0;
  for (std::size_t i = 1; i + 2 < html.size(); ++i) {
    if (html[i] != 'e' || html[i + 1] != '-' || !is_digit(i - 1) || !is_digit(i + 2)) continue;
    std::size_t begin = i - 1;
    while (begin > told && (is_digit(begin - 1) || html[begin - 1] == '.' || html[begin - 1] == '-')) --begin;
    std::size_t end = i + 2;
    while (end < html.size() && is_digit(end)) ++end;
    prose += fmt::format("{}<span class=\"number\">{}</span>", std::string_view(html).substr(told, begin - told),
                         std::string_view(html).substr(begin, end - begin));
    told = end;
  }
  return prose + html.substr(told);
}

std::string anchor(std::string_view kind, std::string_view name) {
  std::string result = fmt::format("{}-{}", kind, name);
  std::ranges::replace_if(
      result, [](unsigned char letter) { return std::isalnum(letter) == 0; }, '-');
  return result;
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

std::string in_words(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

/// "galerkin_2_1_shared": the label, degree 2, 1 shared control node.
std::string galerkin_in_words(const Family& family, std::string_view method) {
  std::string spaces(method.substr(family.name.size() + 1));
  const std::size_t bar = spaces.find('_');
  if (bar == std::string::npos) return in_words(method);
  return fmt::format("{}, degree {}, control nodes {}", family.label, spaces.substr(0, bar),
                     in_words(spaces.substr(bar + 1)));
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

std::string shortened(const std::string& field) {
  if (field.size() <= 8) return field;
  const auto number = parsed<double>(field);
  return number ? fmt::format("{:.6g}", *number) : field;
}

}  // namespace dmocbench
