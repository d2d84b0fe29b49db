#pragma once

#include <source_location>
#include <stdexcept>
#include <string>

namespace dmocbench {

/// Misuse of the library: a wrong dimension, an unknown name, a value outside its range.
///
/// `what()` is one sentence for a person: the mistake and its remedy. `where()` is the place that noticed.
/// A solve that does not converge is not an error; it is a `Status`.
class Error : public std::runtime_error {
 public:
  /// `sentence` states the mistake and its remedy; the place in the source is kept with it.
  explicit Error(const std::string& sentence, std::source_location where = std::source_location::current())
      : std::runtime_error(sentence), where_(where) {}

  /// The source line that threw.
  [[nodiscard]] const std::source_location& where() const noexcept { return where_; }

 private:
  std::source_location where_;
};

}  // namespace dmocbench
