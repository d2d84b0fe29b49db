#pragma once

#include <cstddef>
#include <vector>

#include "methods/expression/schedule.hpp"
#include "methods/expression/vectors.hpp"

namespace dmocbench {

/// Numbers of the inputs of a part's formulas: local unknowns first (in the order of `Layout`), then the step and the
/// time of the left node, the factor of the objective, and one multiplier per local row. Where the horizon is free its
/// length is a local unknown, and step and time are relative to it.
struct LocalInputs {
  std::size_t unknowns = 0;  ///< how many local unknowns there are
  std::size_t rows = 0;      ///< how many local rows there are
  [[nodiscard]] std::size_t step() const noexcept { return unknowns; }
  [[nodiscard]] std::size_t time() const noexcept { return unknowns + 1; }
  [[nodiscard]] std::size_t objective_factor() const noexcept { return unknowns + 2; }
  [[nodiscard]] std::size_t multiplier(std::size_t row) const noexcept { return unknowns + 3 + row; }
  [[nodiscard]] std::size_t count() const noexcept { return unknowns + 3 + rows; }
};

/// Formulas of a part's sparse matrix and where they stand: entry e is at (rows[e], columns[e]), local numbers.
struct LocalMatrix {
  Schedule schedule;
  std::vector<std::size_t> rows;
  std::vector<std::size_t> columns;
};

/// Formulas of a part's sparse vector: entry e belongs to local unknown or row `places[e]`.
struct LocalVector {
  Schedule schedule;
  std::vector<std::size_t> places;
};

/// A part of a program: its share of the objective and its rows, traced and differentiated once. The part of an
/// interval is the same for all intervals; the ends of the horizon are another one.
///
/// ℓ = factor · cost + multipliers · rows is the part's share of the Lagrangian; the cost is the scaled one
/// (`Problem::cost_scale`).
struct LocalFunctions {
  LocalInputs inputs;
  Schedule cost;         ///< one output
  LocalVector gradient;  ///< ∂cost/∂unknown
  LocalVector rows;      ///< all local rows
  LocalMatrix jacobian;  ///< ∂row/∂unknown
  Schedule lagrangian;   ///< ℓ, one output
  LocalMatrix hessian;   ///< ∂²ℓ/∂unknown², one entry per pair (the caller orders it)
};

/// ℓ of a cost and rows; `inputs` has both counts.
[[nodiscard]] Expression local_lagrangian(const Expression& cost, const ExpressionVector& rows,
                                          const LocalInputs& inputs);

/// Cost and rows of the first `unknowns` inputs with all their derivatives.
[[nodiscard]] LocalFunctions differentiate(const Expression& cost, const ExpressionVector& rows, std::size_t unknowns);

/// One vector below the other.
[[nodiscard]] ExpressionVector stacked(const std::vector<ExpressionVector>& parts);

}  // namespace dmocbench
