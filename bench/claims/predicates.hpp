#pragma once

#include <vector>

#include "bench/claims/claim.hpp"

namespace dmocbench {

/// Every claim of the paper with its verdict, computed from the tables by the predicates of predicates.cpp. Rows that
/// are not solved or on another branch make a claim about all grids "differs", never better.
[[nodiscard]] std::vector<Claim> judge_claims(const ResultTables& tables);

}  // namespace dmocbench
