#pragma once

#include <cstddef>
#include <string>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// How the solves of an experiment's table ended.
struct Outcome {
  std::ptrdiff_t failures = 0;  ///< neither solved nor too coarse
  std::ptrdiff_t too_coarse = 0;
  std::ptrdiff_t other_branch = 0;
  std::string coarse_by_method;  ///< ", 3 too coarse (dmoc 1, tangent 2)"; nothing where no answer is
};

[[nodiscard]] Outcome outcome_of(const Table& table);

}  // namespace dmocbench
