#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "methods/expression/tape.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/derivatives/local_functions.hpp"
#include "methods/transcription/derivatives/series_assembly.hpp"

namespace dmocbench {

/// Where the derivatives of a part stand in the program's arrays, entries in the order of `LocalFunctions::gradient`,
/// `jacobian` and `hessian`. All three have the same intervals and the same mode.
struct DerivativePlaces {
  std::vector<SeriesPlace> unknowns;  ///< where unknowns lie in the program's vectors
  std::vector<SeriesPlace> rows;      ///< all local rows
  AssemblyPlan gradient;              ///< where its entries go
  AssemblyPlan jacobian;              ///< where its entries go
  AssemblyPlan hessian;               ///< where its entries go
};

/// A way to differentiate the formulas of a part of a program for all its intervals.
///
/// All back ends fill the same entries, those that do not vanish structurally, so that a solver sees the same program.
/// Not to be used from two threads at once.
class DerivativeBackEnd {
 public:
  /// The inputs of all intervals in the order of `LocalInputs`; multipliers are read by `hessian` only.
  using Inputs = std::span<const Tape::Input>;

  virtual ~DerivativeBackEnd() = default;
  DerivativeBackEnd(const DerivativeBackEnd&) = delete;
  DerivativeBackEnd& operator=(const DerivativeBackEnd&) = delete;

  /// ∂cost/∂unknown; `result` has `DerivativePlaces::gradient.size` entries.
  virtual void gradient(Inputs inputs, VectorOut result) = 0;
  /// ∂row/∂unknown; `values` has `DerivativePlaces::jacobian.size` entries.
  virtual void jacobian(Inputs inputs, VectorOut values) = 0;
  /// ∂²ℓ/∂unknown², one triangle; `values` has `DerivativePlaces::hessian.size` entries.
  virtual void hessian(Inputs inputs, VectorOut values) = 0;

 protected:
  DerivativeBackEnd() = default;
};

}  // namespace dmocbench
