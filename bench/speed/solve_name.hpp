#pragma once

#include <compare>
#include <string>

namespace dmocbench::speed {

/// What is solved, and by what: the name of a benchmark.
struct SolveName {
  bool is_of_library = false;  ///< one of the rounds through the library, in front of whose names stands "library/"
  std::string problem;
  std::string method;
  int intervals = 0;
  std::string solver;
  int threads = 1;
  // NOLINTNEXTLINE(readability-implicit-bool-conversion): false alarm, bool values are compared
  friend auto operator<=>(const SolveName&, const SolveName&) = default;

  /// [library/]PROBLEM/METHOD/INTERVALS/SOLVER[/threads_COUNT]; one thread is not named.
  [[nodiscard]] std::string text() const;
  /// Throws `Error` that names the text if it is none of `text`.
  [[nodiscard]] static SolveName parse(const std::string& text);
};

}  // namespace dmocbench::speed
