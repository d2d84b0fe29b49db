#pragma once

#include <concepts>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace dmocbench {

/// A number that a claim is judged by or that explains it. In a format string it is formatted as its value is:
/// `worded("slope {:.2f}", Measurement{"slope", 1.99, "dmoc"})`.
struct Measurement {
  std::string name;         ///< the quantity: "slope of the state"
  double value = 0.0;       ///< finite, or the claim is not judged
  std::string method = {};  ///< whose it is, as the tables name methods; "" of several, or of none
  std::string at = {};      ///< the case within the claim, such as "N = 64" or a problem; "" without cases
  std::string unit = {};    ///< "" of ratios, relative errors and counts, and where the problem has no units
};

/// Words with the numbers that they state. Sentences of findings are made of them, so that each number of a sentence is
/// also there as a value.
struct Words {
  std::string text;
  std::vector<Measurement> numbers = {};

  /// Whether all numbers are finite. Numbers in tables are, but results computed from them need not be: a ratio to
  /// 1e-310 is infinite.
  [[nodiscard]] bool are_finite() const;
  [[nodiscard]] bool is_empty() const { return text.empty(); }
};

/// The formatted text with the numbers of all arguments that are `Words` or `Measurement`s. Other numbers of floating
/// point do not compile: they need a name.
template <class... Values>
[[nodiscard]] Words worded(fmt::format_string<Values...> format, Values&&... values);

/// Words in a row, with a separator between them; empty ones are left out.
[[nodiscard]] Words joined(const std::vector<Words>& all, std::string_view separator);

/// The words of each element of a range, with a separator between them.
template <class Range, class InWords>
[[nodiscard]] Words joined(const Range& range, std::string_view separator, const InWords& in_words) {
  std::vector<Words> all;
  for (const auto& element : range) all.push_back(std::invoke(in_words, element));
  return joined(all, separator);
}

/// Numbers of one quantity in a row, as "1.20, 1.31" with a format for each, such as "{:.2f}".
[[nodiscard]] Words listed(std::string_view format, const std::vector<Measurement>& numbers);

}  // namespace dmocbench

/// Formats a measurement as its value.
template <>
struct fmt::formatter<dmocbench::Measurement> : fmt::formatter<double> {
  template <class Context>
  auto format(const dmocbench::Measurement& measured, Context& context) const {
    return fmt::formatter<double>::format(measured.value, context);
  }
};

/// Formats words as their text.
template <>
struct fmt::formatter<dmocbench::Words> : fmt::formatter<std::string_view> {
  template <class Context>
  auto format(const dmocbench::Words& words, Context& context) const {
    return fmt::formatter<std::string_view>::format(words.text, context);
  }
};

namespace dmocbench {

template <class... Values>
Words worded(fmt::format_string<Values...> format, Values&&... values) {
  static_assert((!std::is_floating_point_v<std::remove_cvref_t<Values>> && ...),
                "a number of a sentence is a Measurement");
  Words words{.text = fmt::format(format, std::forward<Values>(values)...)};
  [[maybe_unused]] const auto collect = [&]<class Value>(const Value& value) {
    if constexpr (std::same_as<Value, Measurement>) words.numbers.push_back(value);
    if constexpr (std::same_as<Value, Words>)
      words.numbers.insert(words.numbers.end(), value.numbers.begin(), value.numbers.end());
  };
  (collect(values), ...);
  return words;
}

}  // namespace dmocbench
