#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <kainjow/mustache.hpp>

#include "bench/report/mathml.hpp"

namespace dmocbench {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 20> greek_letters{
    {{"alpha", "α"}, {"beta", "β"},  {"gamma", "γ"},  {"delta", "δ"}, {"epsilon", "ε"}, {"zeta", "ζ"}, {"eta", "η"},
     {"theta", "θ"}, {"kappa", "κ"}, {"lambda", "λ"}, {"mu", "μ"},    {"nu", "ν"},      {"xi", "ξ"},   {"pi", "π"},
     {"rho", "ρ"},   {"sigma", "σ"}, {"tau", "τ"},    {"phi", "φ"},   {"psi", "ψ"},     {"omega", "ω"}}};

/// A word or letter. MathML sets single letters in italics, words upright.
std::string symbol(std::string_view word) {
  const auto* const greek =
      std::ranges::find(greek_letters, word, [](const auto& letter) { return std::string_view(letter.first); });
  return fmt::format("<mi>{}</mi>", greek != greek_letters.end() ? std::string(greek->second)
                                                                 : kainjow::mustache::html_escape(std::string(word)));
}

bool is_number(std::string_view word) {
  return !word.empty() &&
         std::ranges::all_of(word, [](unsigned char letter) { return letter >= '0' && letter <= '9'; });
}

/// The parts before and after the last underscore; the second part is empty without an underscore.
std::pair<std::string_view, std::string_view> base_and_index(std::string_view name) {
  const std::size_t bar = name.rfind('_');
  if (bar == std::string_view::npos || bar == 0 || bar + 1 == name.size()) return {name, {}};
  return {name.substr(0, bar), name.substr(bar + 1)};
}

std::string with_index(const std::string& base, std::string_view index) {
  if (index.empty()) return base;
  return fmt::format("<msub>{}{}</msub>", base, is_number(index) ? fmt::format("<mn>{}</mn>", index) : symbol(index));
}

struct Fraction {
  long long numerator = 0;
  long long denominator = 1;
};

constexpr double rounding = 4e-16;  // relative

/// The fraction of small numbers that the value is in a unit, up to rounding, if there is one.
std::optional<Fraction> fraction_of(double value, double unit, double largest,
                                    std::initializer_list<int> denominators) {
  for (const int denominator : denominators) {
    const double numerator = std::round(value / unit * denominator);
    if (std::abs(numerator) > largest || numerator == 0.0) continue;
    if (std::abs(numerator * unit / denominator - value) <= rounding * std::abs(value))
      return Fraction{static_cast<long long>(numerator), denominator};
  }
  return std::nullopt;
}

/// A positive number by its shortest digits that are exact.
std::string decimal(double value) {
  std::string digits = fmt::format("{}", value);
  constexpr std::size_t many = 6;
  const std::size_t zeros = digits.size() - 1 - digits.find_last_not_of('0');
  if (value > 1.0 && zeros >= many && digits.find('.') == std::string::npos)
    digits = fmt::format("{}e{}", digits.substr(0, digits.size() - zeros), zeros);
  const std::size_t exponent = digits.find('e');
  if (exponent == std::string::npos) return fmt::format("<mn>{}</mn>", digits);
  const int power = std::stoi(digits.substr(exponent + 1));
  std::string ten = fmt::format("<msup><mn>10</mn>{}</msup>", mathml_of_number(power));
  if (digits.substr(0, exponent) == "1") return ten;
  return fmt::format("<mrow><mn>{}</mn><mo>×</mo>{}</mrow>", digits.substr(0, exponent), ten);
}

/// A positive number, which is a fraction where that is short.
std::string magnitude(double value) {
  if (std::isinf(value)) return "<mi>∞</mi>";
  if (const auto pi = fraction_of(value, std::numbers::pi, 64.0, {1, 2, 3, 4, 6, 8, 12})) {
    const std::string numerator =
        pi->numerator == 1 ? "<mi>π</mi>" : fmt::format("<mrow><mn>{}</mn><mi>π</mi></mrow>", pi->numerator);
    return pi->denominator == 1 ? numerator : fmt::format("<mfrac>{}<mn>{}</mn></mfrac>", numerator, pi->denominator);
  }
  const auto fraction = fraction_of(value, 1.0, 9999.0, {1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 14, 15, 16, 24, 32});
  const bool is_short = fmt::format("{}", value).size() <= 3;  // 0.2 is easier to read as a decimal, 3/2 as a fraction
  if (fraction && fraction->denominator > 1 && (!is_short || fraction->denominator == 2))
    return fmt::format("<mfrac><mn>{}</mn><mn>{}</mn></mfrac>", fraction->numerator, fraction->denominator);
  return decimal(value);
}

}  // namespace

std::string mathml_of_name(std::string_view name) {
  const auto [base, index] = base_and_index(name);
  return with_index(symbol(base), index);
}

std::string mathml_of_rate(std::string_view name) {
  const auto [base, index] = base_and_index(name);
  return with_index(fmt::format("<mover accent=\"true\">{}<mo>˙</mo></mover>", symbol(base)), index);
}

std::string mathml_of_number(double value) {
  if (value < 0.0) return fmt::format("<mrow><mo>−</mo>{}</mrow>", magnitude(-value));
  return magnitude(value);
}

}  // namespace dmocbench
