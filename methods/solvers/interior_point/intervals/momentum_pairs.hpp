#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/intervals/interval_entries.hpp"

namespace dmocbench::interior_point {

/// Two equalities of every interval and the momentum that they determine at either end, p_k and p_{k+1}, where it
/// enters linearly and nothing else in the program reads it between the ends. In the midpoint rule on (q, p) these are
///
///   row 1: (p_k + p_{k+1})/2 - L_v,   row 2: (p_{k+1} - p_k)/h - L_q - f.
struct MomentumPair {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// Another unknown that the pair reads; that of interval k is number `unknown` + k, its derivatives are the entries
  /// `entries` + k of the Jacobian's values, `none` where a row does not read it.
  struct Column {
    std::size_t unknown = 0;
    std::array<std::size_t, 2> entries{none, none};
  };

  std::size_t momentum = 0;               ///< number of p_0; p_k is number `momentum` + k
  std::array<std::size_t, 2> rows{};      ///< numbers of both rows of interval 0
  std::array<std::size_t, 2> at_left{};   ///< entries of their derivatives with respect to p_k
  std::array<std::size_t, 2> at_right{};  ///< and p_{k+1}
  std::vector<Column> columns;
};

/// The pairs of a program whose nodes have as many momenta, the second half of their unknowns, as configurations. None,
/// with the reason in `why`, where a momentum is in more or fewer than two rows of an interval (other methods, more
/// stages), or has a bound, or is in the Hessian or in an inequality, or where an unknown belongs to the whole horizon
/// (a free T multiplies momenta).
[[nodiscard]] std::optional<std::vector<MomentumPair>> momentum_pairs(const NonlinearProgram& program,
                                                                      const IntervalEntries& entries, std::string& why);

}  // namespace dmocbench::interior_point
