#pragma once

#include <cstdint>
#include <memory>

#include "methods/transcription/derivatives/derivative_back_end.hpp"

namespace dmocbench {

/// The sides of a point at which values are taken.
enum class DifferenceKind : std::uint8_t {
  central,  ///< on both: error O(step²)
  forward,  ///< on one: error O(step), half the evaluations
};

/// The step relative to max(1, |x|) that balances truncation and a rounding of ε in the values, ε = 2.2e-16.
///
/// | | formula | step | error, where function and derivatives are of size 1 |
/// |---|---|---|---|
/// | central, first | (f₊ - f₋)/2s | ε^(1/3) = 6e-6 | ε^(2/3) = 4e-11 |
/// | forward, first | (f₊ - f)/s | ε^(1/2) = 1.5e-8 | ε^(1/2) = 1.5e-8 |
/// | central, second | (f₊₊ - f₊₋ - f₋₊ + f₋₋)/4st, (f₊ - 2f + f₋)/s² | ε^(1/4) = 1.2e-4 | ε^(1/2) = 1.5e-8 |
/// | forward, second | (f₊₊ - f₊ - f₊ + f)/st | ε^(1/3) = 6e-6 | ε^(1/3) = 6e-6 |
[[nodiscard]] double difference_step(DifferenceKind kind, int derivative);

/// First and second derivatives by differences of values. Of the formulas' derivatives, only the pattern is used: which
/// entries vanish for every motion.
///
/// The same local unknown is moved in all intervals at once: the tapes of the values then give a difference for every
/// interval in one pass. With n local unknowns a Jacobian takes 2n (central) or n + 1 (forward) passes over the
/// constraints, the Hessian of ℓ at most 2n² + 1 or n(n + 3)/2 + 1 passes over ℓ. Values divided by the step of the
/// grid lose digits as it gets smaller, and so do these derivatives. Allocates nothing in an evaluation.
[[nodiscard]] std::unique_ptr<DerivativeBackEnd> make_finite_differences(const LocalFunctions& functions,
                                                                         const DerivativePlaces& places,
                                                                         DifferenceKind kind);

/// Forward differences as a solver takes them that has only the values of a program: one unknown of the whole
/// program is moved at a time, and cost, rows or ℓ of all intervals are evaluated again.
///
/// With n unknowns a gradient or a Jacobian takes n + 1 evaluations of the whole program. Of the Hessian only entries
/// of its pattern are computed, an evaluation each in addition to n + 1. Steps as `difference_step` of forward
/// differences. Allocates nothing in an evaluation.
[[nodiscard]] std::unique_ptr<DerivativeBackEnd> make_dense_differences(const LocalFunctions& functions,
                                                                        const DerivativePlaces& places);

}  // namespace dmocbench
