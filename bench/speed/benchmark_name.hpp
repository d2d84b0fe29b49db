#pragma once

#include <string>

namespace dmocbench::speed {

/// The name of a benchmark, WAY/QUANTITY/PROBLEM[/METHOD/gauss_STAGES][/INSTRUCTION_SET]. What is in brackets is left
/// out where a way is measured for DMOC with the midpoint rule alone, or has no instruction set of its own.
struct BenchmarkName {
  std::string way;                   ///< "tape", "program", "hand", ...
  std::string quantity;              ///< "residual", "jacobian", "hessian", "separate", ...
  std::string problem;               ///< with the number of links: "link_chain_3"
  std::string method = {};           ///< empty: DMOC with the midpoint rule
  int stages = 1;                    ///< of the Gauss tableau
  std::string instruction_set = {};  ///< empty: none

  [[nodiscard]] std::string text() const;
  /// The name that `text` wrote, "dmoc" in place of an empty method. Throws `Error` if it is no such name.
  [[nodiscard]] static BenchmarkName parse(const std::string& text);
};

}  // namespace dmocbench::speed
