#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dmocbench::tests {

namespace mathml_reading {

struct Element {
  std::string tag;
  std::string text;    // of an element without elements
  std::string markup;  // the whole of it
  std::vector<Element> inner;
};

[[noreturn]] inline void refuse(const std::string& what) { throw std::runtime_error("cannot read " + what); }

/// The elements of a text, one after the other, up to its end or to an end tag.
inline std::vector<Element> elements_of(std::string_view text, std::size_t& at) {
  std::vector<Element> elements;
  while (at < text.size()) {
    if (text[at] != '<') refuse(std::string(text.substr(at)));
    if (text.substr(at, 2) == "</") return elements;
    const std::size_t begin = at;
    const std::size_t close = text.find('>', at);
    if (close == std::string_view::npos) refuse(std::string(text.substr(at)));
    Element element;
    element.tag = text.substr(at + 1, std::min(close, text.find(' ', at)) - at - 1);
    at = close + 1;
    if (text[at] == '<' && text.substr(at, 2) != "</") {
      element.inner = elements_of(text, at);
    } else {
      const std::size_t end = text.find('<', at);
      element.text = text.substr(at, end - at);
      at = end;
    }
    const std::string ending = "</" + element.tag + ">";
    if (text.substr(at, ending.size()) != ending) refuse(std::string(text.substr(begin)));
    at += ending.size();
    element.markup = text.substr(begin, at - begin);
    elements.push_back(element);
  }
  return elements;
}

inline double (*function_named(const std::string& name))(double) {
  static const std::map<std::string, double (*)(double)> functions{
      {"exp", std::exp},     {"ln", std::log},
      {"sin", std::sin},     {"cos", std::cos},
      {"tan", std::tan},     {"arcsin", std::asin},
      {"arccos", std::acos}, {"arctan", std::atan},
      {"sinh", std::sinh},   {"cosh", std::cosh},
      {"tanh", std::tanh},   {"arsinh", std::asinh},
      {"erf", std::erf},     {"θ", [](double x) { return x > 0.0 ? 1.0 : 0.0; }}};
  const auto found = functions.find(name);
  return found == functions.end() ? nullptr : found->second;
}

class Reader {
 public:
  explicit Reader(const std::map<std::string, double>& names) : names_(names) {}

  /// A row: signs and terms.
  [[nodiscard]] double row(const std::vector<Element>& elements) const {
    std::size_t at = 0;
    const double value = sum(elements, at);
    if (at != elements.size()) refuse(elements[at].markup);
    return value;
  }

 private:
  static bool is_sign(const std::vector<Element>& row, std::size_t at, const char* sign) {
    return at < row.size() && row[at].tag == "mo" && row[at].text == sign;
  }

  double sum(const std::vector<Element>& row, std::size_t& at) const {
    double value = 0.0;
    bool is_first = true;
    while (at < row.size() && !is_sign(row, at, ")") && !is_sign(row, at, ",")) {
      const bool is_minus = is_sign(row, at, "−");
      if (is_minus || is_sign(row, at, "+")) {
        ++at;
      } else if (!is_first) {
        refuse(row[at].markup);
      }
      const double next = product(row, at);
      value += is_minus ? -next : next;
      is_first = false;
    }
    if (is_first) refuse("a sum of nothing");
    return value;
  }

  double product(const std::vector<Element>& row, std::size_t& at) const {
    double value = factor(row, at);
    while (is_sign(row, at, "\u2062") || is_sign(row, at, "×") || is_sign(row, at, "·") || is_pi(row, at)) {
      if (!is_pi(row, at)) ++at;
      value *= factor(row, at);
    }
    return value;
  }

  static bool is_pi(const std::vector<Element>& row, std::size_t at) {
    return at < row.size() && row[at].markup == "<mi>π</mi>";
  }

  double factor(const std::vector<Element>& row, std::size_t& at) const {
    if (at == row.size()) refuse("a product that ends too early");
    if (is_sign(row, at, "(")) {
      const double value = sum(row, ++at);
      if (!is_sign(row, at, ")")) refuse("a bracket without end");
      ++at;
      return value;
    }
    if (is_sign(row, at + 1, "\u2061")) {
      at += 3;
      if (at > row.size()) refuse("a function of nothing");
      return applied(row[at - 3], row[at - 1]);
    }
    return value_of(row[at++]);
  }

  /// A function, or a power of it, of an argument.
  [[nodiscard]] double applied(const Element& function, const Element& argument) const {
    if (function.tag == "msup")
      return std::pow(applied(function.inner.at(0), argument), value_of(function.inner.at(1)));
    if (function.text == "atan2") {
      std::size_t at = 1;
      const double y = sum(argument.inner, at);
      if (!is_sign(argument.inner, 0, "(") || !is_sign(argument.inner, at, ",")) refuse(argument.markup);
      const double x = sum(argument.inner, ++at);
      return std::atan2(y, x);
    }
    auto* const known = function_named(function.text);
    if (known == nullptr) refuse(function.markup);
    return known(value_of(argument));
  }

  [[nodiscard]] double value_of(const Element& element) const {
    if (const auto name = names_.find(element.markup); name != names_.end()) return name->second;
    if (element.tag == "mrow") return row(element.inner);
    if (element.tag == "mn") return std::stod(element.text);
    if (element.markup == "<mi>π</mi>") return std::numbers::pi;
    if (element.markup == "<mi>∞</mi>") return std::numeric_limits<double>::infinity();
    if (element.tag == "msqrt") return std::sqrt(row(element.inner));
    const bool has_two = element.inner.size() == 2;
    if (element.tag == "mfrac" && has_two) return value_of(element.inner[0]) / value_of(element.inner[1]);
    if (element.tag == "msup" && has_two) return std::pow(value_of(element.inner[0]), value_of(element.inner[1]));
    refuse(element.markup);
  }

  const std::map<std::string, double>& names_;
};

}  // namespace mathml_reading

/// The value of a formula in presentation MathML, read as a mathematician reads it: from fractions, powers, roots,
/// functions, brackets and signs. `names` are the values of what is a name, by its whole markup. Throws
/// `std::runtime_error` that quotes what cannot be read.
[[nodiscard]] inline double value_of_mathml(std::string_view markup, const std::map<std::string, double>& names) {
  std::size_t at = 0;
  const std::vector<mathml_reading::Element> elements = mathml_reading::elements_of(markup, at);
  if (at != markup.size()) mathml_reading::refuse(std::string(markup));
  return mathml_reading::Reader(names).row(elements);
}

}  // namespace dmocbench::tests
