#pragma once

#include <string>
#include <vector>

#include "methods/expression/expression.hpp"
#include "methods/expression/vectors.hpp"

namespace dmocbench::python {

/// Names the inputs among `entries` for texts of formulas of this thread: "PREFIX.NAME", where `prefix` is not empty.
/// A later name of an input takes the place of an earlier one; entries that are not inputs are passed over.
void name_inputs(const ExpressionVector& entries, const std::string& prefix, const std::vector<std::string>& names);

/// A formula as Python would write it: "0.5*length**2*v.theta**2 + 9.81*cos(q.theta)". Inputs without a name are "x0",
/// "x1", ... A text of more than 500 letters is cut, and ends with "... (123 operations)".
[[nodiscard]] std::string text_of_formula(const Expression& formula);

}  // namespace dmocbench::python
