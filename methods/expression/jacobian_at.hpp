#pragma once

#include <functional>

#include "methods/expression/vectors.hpp"

namespace dmocbench {

/// f(x), any number of entries.
using VectorFormula = std::function<ExpressionVector(const ExpressionVector& x)>;

/// ∂f_i/∂x_j at formulas x, where `jacobian` needs inputs. f may read further inputs, which are held fixed.
[[nodiscard]] ExpressionMatrix jacobian_at(const VectorFormula& f, const ExpressionVector& x);

}  // namespace dmocbench
