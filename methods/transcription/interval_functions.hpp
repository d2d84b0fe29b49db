#pragma once

#include <cstddef>
#include <vector>

#include "methods/expression/schedule.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/element.hpp"
#include "methods/transcription/tableau.hpp"

namespace dmocbench {

/// Numbers of the inputs of an interval's formulas: local unknowns first (in the order of `Layout`), then the step, the
/// time of the left node, the factor of the objective, and one multiplier per local row.
struct IntervalInputs {
  std::size_t unknowns = 0;  ///< how many local unknowns there are
  std::size_t rows = 0;      ///< how many local rows there are
  [[nodiscard]] std::size_t step() const noexcept { return unknowns; }
  [[nodiscard]] std::size_t time() const noexcept { return unknowns + 1; }
  [[nodiscard]] std::size_t objective_factor() const noexcept { return unknowns + 2; }
  [[nodiscard]] std::size_t multiplier(std::size_t row) const noexcept { return unknowns + 3 + row; }
  [[nodiscard]] std::size_t count() const noexcept { return unknowns + 3 + rows; }
};

/// Formulas of an interval's sparse matrix and where they stand: entry e is at (rows[e], columns[e]), local numbers.
struct LocalMatrix {
  Schedule schedule;
  std::vector<std::size_t> rows;
  std::vector<std::size_t> columns;
};

/// Formulas of an interval's sparse vector: entry e belongs to local unknown or row `places[e]`.
struct LocalVector {
  Schedule schedule;
  std::vector<std::size_t> places;
};

/// Everything an interval computes, traced and differentiated once, whatever the number of intervals.
///
/// ℓ = factor · cost + multipliers · rows is the interval's share of the Lagrangian; the cost is the scaled one
/// (`Problem::cost_scale`).
struct IntervalFunctions {
  IntervalInputs inputs;
  Eigen::Index node_rows = 0;
  Eigen::Index private_rows = 0;

  Schedule cost;          ///< one output
  LocalVector gradient;   ///< ∂cost/∂unknown
  LocalVector rows;       ///< all local rows
  LocalMatrix jacobian;   ///< ∂row/∂unknown
  Schedule lagrangian;    ///< ℓ, one output
  LocalMatrix hessian;    ///< ∂²ℓ/∂unknown², one entry per pair (the caller orders it)
  Schedule node_adjoint;  ///< ∂ℓ/∂(left node), then ∂ℓ/∂(right node)
  Schedule momenta;       ///< left momentum, then right momentum
  Schedule stages;        ///< per stage: Q_i, Q̇_i, t_i
};

[[nodiscard]] IntervalFunctions trace_interval(const TracedProblem& problem, const Element& element,
                                               const Tableau& tableau, double cost_scale);

}  // namespace dmocbench
