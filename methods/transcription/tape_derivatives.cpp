#include "methods/transcription/tape_derivatives.hpp"

namespace dmocbench {

TapeDerivatives::TapeDerivatives(const IntervalFunctions& functions, const DerivativePlaces& places)
    : gradient_(functions.gradient.schedule, places.gradient_firsts, places.gradient_size, places.intervals),
      jacobian_(functions.jacobian.schedule, places.jacobian_firsts, places.jacobian_size, places.intervals),
      hessian_(functions.hessian.schedule, places.hessian_firsts, places.hessian_size, places.intervals) {}

}  // namespace dmocbench
