#pragma once

#include <source_location>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <fmt/core.h>

namespace dmocbench {

/// A format string of libfmt for values of these types, checked by the compiler, and the place of the call.
template <class... Values>
struct Sentence {
  /// The place is where the sentence is written, which the caller leaves out.
  template <class Text>
  consteval Sentence(const Text& words, std::source_location place = std::source_location::current())
      : text(words), where(place) {}

  fmt::format_string<Values...> text;  ///< with a field for each value
  std::source_location where;          ///< the place of the call
};

/// Misuse of the library: a wrong dimension, an unknown name, a value outside its range.
///
/// `what()` is one sentence for a person: the mistake and its remedy. `where()` is the place that noticed.
/// A solve that does not converge is not an error; it is a `Status`.
class Error : public std::runtime_error {
 public:
  /// `sentence` states the mistake and its remedy; the place in the source is kept with it.
  explicit Error(const std::string& sentence, std::source_location where = std::source_location::current())
      : std::runtime_error(sentence), where_(where) {}
  /// The same of a format string and its values: `Error("{} has no entry {}", name, entry)`.
  template <class First, class... Rest>
  explicit Error(Sentence<std::type_identity_t<First>, std::type_identity_t<Rest>...> sentence, First&& first,
                 Rest&&... rest)
      : Error(fmt::vformat(sentence.text, fmt::make_format_args(first, rest...)), sentence.where) {}

  /// The source line that threw.
  [[nodiscard]] const std::source_location& where() const noexcept { return where_; }

 private:
  std::source_location where_;
};

}  // namespace dmocbench
