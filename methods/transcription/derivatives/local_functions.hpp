#pragma once

#include <cstddef>
#include <vector>

#include "methods/expression/schedule.hpp"
#include "methods/expression/vectors.hpp"

namespace dmocbench {

/// The inputs of a part's formulas: the problem's parameters that are kept open first, then local unknowns (in the
/// order of `IntervalFunctions`), the step and the time of the left node, the factor of the objective, and one
/// multiplier per local row. Where the horizon is free, its length is a local unknown, and step and time are relative
/// to it.
struct LocalInputs {
  std::size_t unknowns = 0;    ///< how many local unknowns there are
  std::size_t rows = 0;        ///< how many local rows there are
  std::size_t parameters = 0;  ///< how many parameters are kept open
  /// The input of an unknown of the interval.
  [[nodiscard]] std::size_t unknown(std::size_t local) const noexcept { return parameters + local; }
  /// The input of h.
  [[nodiscard]] std::size_t step() const noexcept { return unknown(unknowns); }
  /// The input of t_k.
  [[nodiscard]] std::size_t time() const noexcept { return step() + 1; }
  /// The input of σ, the factor of the cost in the Lagrangian.
  [[nodiscard]] std::size_t objective_factor() const noexcept { return step() + 2; }
  /// The input of the multiplier of a row.
  [[nodiscard]] std::size_t multiplier(std::size_t row) const noexcept { return step() + 3 + row; }
  /// How many inputs there are.
  [[nodiscard]] std::size_t count() const noexcept { return multiplier(rows); }
};

/// A sparse matrix of a part: formula e is the entry at (rows[e], columns[e]), local numbers.
struct LocalMatrix {
  Schedule schedule;                 ///< a formula per entry
  std::vector<std::size_t> rows;     ///< of every entry
  std::vector<std::size_t> columns;  ///< of every entry

  /// Calls `visit(e, row, column)` for every entry.
  template <class Visit>
  void for_each(const Visit& visit) const {
    const auto index = [](std::size_t number) { return static_cast<Eigen::Index>(number); };
    for (std::size_t e = 0; e < rows.size(); ++e) visit(index(e), index(rows[e]), index(columns[e]));
  }
};

/// A sparse vector of a part: formula e is the entry of local unknown or row `places[e]`.
struct LocalVector {
  Schedule schedule;                ///< a formula per entry
  std::vector<std::size_t> places;  ///< of every entry
};

/// A part of a program: its share of the objective and its constraints (rows), traced and differentiated once. One part
/// serves all intervals, the other the two ends of the horizon.
///
/// ℓ = factor · cost + multipliers · rows is the part's share of the Lagrangian; the cost is the scaled one
/// (`Problem::cost_scale`).
struct LocalFunctions {
  LocalInputs inputs;    ///< how they are numbered
  Schedule cost;         ///< one output
  LocalVector gradient;  ///< ∂cost/∂unknown
  LocalVector rows;      ///< all local rows
  LocalMatrix jacobian;  ///< ∂row/∂unknown
  Schedule lagrangian;   ///< ℓ, one output
  LocalMatrix hessian;   ///< ∂²ℓ/∂unknown², lower triangle
  Schedule adjoint;      ///< ∂ℓ/∂unknown, of the first unknowns alone
};

/// Cost and rows, functions of `parameters` and `unknowns` inputs, with all their derivatives by the unknowns;
/// `adjoint` has `adjoint_size` outputs.
[[nodiscard]] LocalFunctions differentiate(const Expression& cost, const ExpressionVector& rows, std::size_t unknowns,
                                           std::size_t parameters, Eigen::Index adjoint_size = 0);

}  // namespace dmocbench
