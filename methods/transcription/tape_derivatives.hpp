#pragma once

#include "methods/transcription/assembled_tape.hpp"
#include "methods/transcription/derivative_back_end.hpp"

namespace dmocbench {

/// Exact derivatives: the symbolic ones of `IntervalFunctions`, each a tape over all intervals. Allocates nothing.
class TapeDerivatives final : public DerivativeBackEnd {
 public:
  TapeDerivatives(const LocalFunctions& functions, const DerivativePlaces& places);

  void gradient(Inputs inputs, VectorOut result) override { gradient_.evaluate(inputs, result); }
  void jacobian(Inputs inputs, VectorOut values) override { jacobian_.evaluate(inputs, values); }
  void hessian(Inputs inputs, VectorOut values) override { hessian_.evaluate(inputs, values); }

 private:
  AssembledTape gradient_;
  AssembledTape jacobian_;
  AssembledTape hessian_;
};

}  // namespace dmocbench
