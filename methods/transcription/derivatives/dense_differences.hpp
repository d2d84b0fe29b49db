#pragma once

#include <memory>

#include "methods/transcription/derivatives/derivative_back_end.hpp"

namespace dmocbench {

/// Forward differences as a solver takes them that has only the values of a program: one unknown of the whole
/// program is moved at a time, and cost, rows or ℓ of all intervals are evaluated again.
///
/// With n unknowns a gradient or a Jacobian takes n + 1 evaluations of the whole program. Of the Hessian only entries
/// of its pattern are computed, an evaluation each in addition to n + 1. Steps as `difference_step` of forward
/// differences. Allocates nothing in an evaluation.
[[nodiscard]] std::unique_ptr<DerivativeBackEnd> make_dense_differences(const LocalFunctions& functions,
                                                                        const DerivativePlaces& places);

}  // namespace dmocbench
