#pragma once

#include <vector>

#include "methods/diagnostics/discrete_objects.hpp"
#include "methods/diagnostics/traced_newton.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/tableau.hpp"

namespace dmocbench {

/// The discrete Lagrangian L_d (eq:DMOC_RK_L) and the discrete forces f_d^± (eq:DMOC_RK_f) of DMOC, one by one, for any
/// tableau.
///
/// The element states A(q_0, q_1, Q̇) and virtual work at fixed interior slopes; the slopes are functions of (q_0, q_1)
/// by the private rows, so that f_d^± = h Σ b_i f·∂Q_i/∂q needs dQ̇/dq from the implicit function theorem. (Only the sum
/// D_1 L_d + f_d^- is free of it: there the rows cancel what depends on dQ̇/dq.) Computed in long double.
class DiscreteLagrangian {
 public:
  DiscreteLagrangian(const Problem& problem, const Tableau& tableau);

  /// The objects between `q_0` and `q_1` on an interval of length `h` that begins at time `t`. Row i of `controls` is
  /// U_i (s × m). Throws `Error` if the interior slopes cannot be found.
  [[nodiscard]] DiscreteObjects at(const LongVector& q_0, const LongVector& q_1, const LongMatrix& controls,
                                   long double h, long double t) const;

 private:
  struct Formulas;
  explicit DiscreteLagrangian(const Formulas& formulas);

  Eigen::Index n_;
  Eigen::Index stages_;
  TracedNewton<long double> interior_slopes_;
  // A; ∂A/∂q_0 + W, ∂A/∂q_1 + W; W[∂Q/∂q_0], W[∂Q/∂q_1], W[∂Q/∂Q̇]; private rows by Q̇, q_0, q_1, column by column
  Schedule objects_;
};

}  // namespace dmocbench
