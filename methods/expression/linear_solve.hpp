#pragma once

#include "methods/expression/vectors.hpp"

namespace dmocbench {

/// The solution x of A x = b as formulas of the entries of A (n × n, symmetric) and b (n entries).
///
/// The factors L D Lᵀ are taken without an exchange of rows, since a formula cannot depend on the size of a number.
/// Every leading minor of A must therefore be nonzero where the formulas are evaluated; the minors of a mass matrix are
/// positive. Throws `Error` with the sentence `singular` if a pivot is a structural zero.
[[nodiscard]] ExpressionVector solve_symmetric(
    const ExpressionMatrix& a, const ExpressionVector& b,
    const char* singular = "a system of linear equations has a pivot that is zero for all values");

}  // namespace dmocbench
