#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "methods/expression/schedule.hpp"
#include "methods/expression/vectors.hpp"

namespace dmocbench {

/// The arguments of the nonlinear operations of some formulas: y = A x + b with coefficients A that do not depend on x.
///
/// The formulas are functions of y alone, f(x) = g(A x + b), so that f_x = g_y A and f_xx = Aᵀ g_yy A. An interval
/// reads its ends through a midpoint and a velocity: g is differentiated there, where it is short, and A, which holds
/// constants and steps, carries the result to the ends. An argument is an affine node that a nonlinear operation reads,
/// or a formula that is affine itself, without its sign and numeric factor: those may meet others while formulas are
/// differentiated. Where there are more than `most_per_entry` for each entry of x, y is x itself: g_yy grows with the
/// square of their number.
class AffineArguments {
 public:
  /// Arguments for each entry of x at most.
  static constexpr std::size_t most_per_entry = 16;

  /// Throws `Error` if an entry of `x` is not an input.
  AffineArguments(std::span<const Expression> formulas, const ExpressionVector& x);

  /// g, one per formula, in inputs of their own: `inputs()`.
  [[nodiscard]] const std::vector<Expression>& formulas() const noexcept { return formulas_; }
  /// y as inputs that no formula reads, and their definitions.
  [[nodiscard]] const Definitions& definitions() const noexcept { return definitions_; }
  /// A, a row per argument.
  [[nodiscard]] const ExpressionMatrix& coefficients() const noexcept { return coefficients_; }

 private:
  Definitions definitions_;
  ExpressionMatrix coefficients_;
  std::vector<Expression> formulas_;
};

/// The formulas with `replacements` in place of `nodes`, as many.
[[nodiscard]] std::vector<Expression> replaced(std::span<const Expression> formulas, const ExpressionVector& nodes,
                                               const ExpressionVector& replacements);

}  // namespace dmocbench
