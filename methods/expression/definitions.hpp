#pragma once

#include <span>
#include <vector>

#include "methods/expression/vectors.hpp"

namespace dmocbench {

/// Inputs that stand for formulas: `inputs[i]` for `formulas[i]`, which reads none of the inputs.
struct Definitions {
  ExpressionVector inputs;    ///< read by other formulas
  ExpressionVector formulas;  ///< their definitions, as many
};

/// The formulas with `replacements` in place of `nodes`, as many.
[[nodiscard]] std::vector<Expression> replaced(std::span<const Expression> formulas, const ExpressionVector& nodes,
                                               const ExpressionVector& replacements);

}  // namespace dmocbench
