#include "methods/transcription/tape_derivatives.hpp"

namespace dmocbench {

TapeDerivatives::TapeDerivatives(const LocalFunctions& functions, const DerivativePlaces& places)
    : gradient_(functions.gradient.schedule, places.gradient_places, places.gradient_size, places.intervals,
                places.mode),
      jacobian_(functions.jacobian.schedule, places.jacobian_places, places.jacobian_size, places.intervals,
                places.mode),
      hessian_(functions.hessian.schedule, places.hessian_places, places.hessian_size, places.intervals, places.mode) {}

}  // namespace dmocbench
