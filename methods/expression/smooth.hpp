#pragma once

#include "methods/expression/expression.hpp"

namespace dmocbench {

// Smooth stand-ins for functions with a kink or a jump, which solvers that use second derivatives cannot follow. `eps`
// is the width of the rounding, in the unit of the argument: start with a hundredth of its range, and make it smaller
// while solves succeed. All throw `Error` unless eps > 0.

/// √(x² + eps²): above |x| by at most eps, at x = 0.
[[nodiscard]] Expression smooth_abs(const Expression& x, double eps);
/// ½(x + y + √((x - y)² + eps²)): above the larger of both by at most eps/2, where they are equal.
[[nodiscard]] Expression smooth_max(const Expression& x, const Expression& y, double eps);
/// ½(x + y - √((x - y)² + eps²)): below the smaller of both by at most eps/2, where they are equal.
[[nodiscard]] Expression smooth_min(const Expression& x, const Expression& y, double eps);
/// x/√(x² + eps²): from -1 to 1, half of the way at |x| = 0.58 eps.
[[nodiscard]] Expression smooth_sign(const Expression& x, double eps);
/// ½(a + b) + ½(a - b) tanh(x/eps): a where x is some eps above 0, b where it is as much below. Both formulas have to
/// be defined on both sides.
[[nodiscard]] Expression smooth_if_else(const Expression& x, const Expression& a, const Expression& b, double eps);

}  // namespace dmocbench
