#pragma once

#include <string>
#include <vector>

#include "bench/claims/claim.hpp"

namespace dmocbench {

// What predicates share: the paper's problems, a tolerance, and rows picked from tables.

inline constexpr const char* orbit = "orbital_transfer";
inline constexpr const char* two_link = "two_link_manipulator";
/// Ours, with a constant mass matrix.
inline constexpr const char* oscillator = "forced_oscillator";

/// A fitted slope may miss its order by this much.
inline constexpr double near_order = 0.3;

using Rows = std::vector<const Row*>;

[[nodiscard]] inline ClaimVerdict verdict_of(bool holds) {
  return holds ? ClaimVerdict::reproduced : ClaimVerdict::differs;
}

/// Midpoint rows of one method.
[[nodiscard]] Rows midpoint_rows(const Rows& rows, const std::string& method);

/// The rows with that text in a column.
[[nodiscard]] Rows rows_with(const Rows& rows, const std::string& column, const std::string& text);

/// The row on a grid, if it was solved on the wanted branch.
[[nodiscard]] const Row* on_grid(const Rows& rows, double intervals);

/// How many were not solved, or not on the wanted branch.
[[nodiscard]] std::size_t count_unusable(const Rows& rows);

/// The largest entry of a column; infinity if one is missing.
[[nodiscard]] double largest(const Rows& rows, const std::string& column);

}  // namespace dmocbench
