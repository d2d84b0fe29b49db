#pragma once

#include <vector>

#include "bench/run/solve_case.hpp"
#include "methods/error.hpp"
#include "methods/transcription/elements/families.hpp"

namespace dmocbench {

/// The case whose program `write-nl` writes and whose answer `read-sol` reads. Throws `Error` unless it is the only
/// one, and one whose program can be written as formulas of its unknowns.
[[nodiscard]] inline const Case& exchanged_case(const std::vector<Case>& cases) {
  if (cases.size() != 1) {
    throw Error("needs exactly one case (one problem, method, number of stages and grid), got {}", cases.size());
  }
  if (family_of(cases.front().method).is_condensed) {
    throw Error(
        "single_shooting simulates the system and cannot be written as formulas; use multiple_shooting, which has the "
        "nodes as unknowns");
  }
  return cases.front();
}

}  // namespace dmocbench
