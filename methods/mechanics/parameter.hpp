#pragma once

#include <limits>
#include <string>

namespace dmocbench {

/// A number of a problem that its user may set.
struct Parameter {
  std::string name;                                         ///< as on the command line: `--set name=value`
  double value = 0.0;                                       ///< the default, until set
  std::string unit;                                         ///< "kg", "km^3/s^2", "" for a pure number
  std::string meaning;                                      ///< one phrase
  double lower = -std::numeric_limits<double>::infinity();  ///< smallest allowed value
  double upper = std::numeric_limits<double>::infinity();   ///< largest allowed value
  bool whole = false;                                       ///< whole numbers only

  /// The allowed values in words: "a whole number in [1, 100]".
  [[nodiscard]] std::string range() const;
  /// Throws `Error` that names the parameter, its range and the value if `candidate` is not allowed.
  void check(double candidate) const;
};

}  // namespace dmocbench
