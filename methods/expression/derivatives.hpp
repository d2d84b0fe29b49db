#pragma once

#include "methods/expression/schedule.hpp"
#include "methods/expression/vectors.hpp"

namespace dmocbench {

/// ∂f/∂x_i for every entry of `x`, which must be inputs. Reverse mode on the graph: the result is again a graph.
/// Throws `Error` if an entry of `x` is not an input.
[[nodiscard]] ExpressionVector gradient(const Expression& f, const ExpressionVector& x);

/// ∂f_i/∂x_j, rows × x.size(). Entries that are the constant 0 are structural zeros.
[[nodiscard]] ExpressionMatrix jacobian(const ExpressionVector& f, const ExpressionVector& x);

/// ∂f_i/∂x_j, x.size() square, where f is itself a gradient in x; entries (i, j) and (j, i) are the same node.
[[nodiscard]] ExpressionMatrix symmetric_jacobian(const ExpressionVector& f, const ExpressionVector& x);

/// The first and second derivatives of one formula. They read inputs that stand for its affine arguments
/// (`AffineArguments`), through which fewer operations lead than through x itself.
struct DefinedDerivatives {
  ExpressionVector gradient;  ///< ∂f/∂x_i
  ExpressionMatrix hessian;   ///< ∂²f/∂x_i∂x_j; entries (i, j) and (j, i) are the same node
  Definitions definitions;    ///< of the affine arguments, as `Schedule` takes them
};

/// Both derivatives. Throws `Error` if an entry of `x` is not an input.
[[nodiscard]] DefinedDerivatives gradient_and_hessian(const Expression& f, const ExpressionVector& x);

/// ∂²f/∂x_i∂x_j of the inputs of f alone; entries (i, j) and (j, i) are the same node. Throws as the one above.
[[nodiscard]] ExpressionMatrix hessian(const Expression& f, const ExpressionVector& x);

}  // namespace dmocbench
