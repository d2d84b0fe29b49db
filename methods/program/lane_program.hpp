#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "methods/program/nonlinear_program.hpp"
#include "methods/runtime/lane_loops.hpp"

namespace dmocbench {

/// Eight instances of one program, evaluated side by side: the same structure, other numbers.
///
/// Every array is interleaved (lane_loops.hpp): entry i of an array of `NonlinearProgram` stands, for
/// the instance in lane l, at i * instance_lanes + l. No lane changes a digit of another, also where a formula gives
/// NaN. Not to be used from two threads at once.
class LaneProgram {
 public:
  virtual ~LaneProgram() = default;
  LaneProgram(const LaneProgram&) = delete;
  LaneProgram& operator=(const LaneProgram&) = delete;

  /// The number of parameters of an instance: inputs of the formulas in addition to the unknowns.
  [[nodiscard]] virtual std::size_t parameter_count() const { return 0; }
  /// Gives the instance in a lane its parameters: `parameter_count()` of them, or none for the usual ones. Throws
  /// `Error` if they are not allowed.
  virtual void set_parameters(std::size_t lane, std::span<const double> values) {
    static_cast<void>(lane);
    static_cast<void>(values);
  }

  /// φ of every lane.
  virtual void objective(const double* x, double* result) = 0;
  /// ∇φ: eight numbers per variable.
  virtual void gradient(const double* x, double* result) = 0;
  virtual void constraints(const double* x, double* result) = 0;  ///< a: eight numbers per constraint.
  /// ∂a/∂ξ: eight numbers per entry of its structure.
  virtual void jacobian(const double* x, double* values) = 0;
  /// Hessian of φ + λᵀa.
  virtual void hessian(const double* x, const double* multipliers, double* values) = 0;

 protected:
  LaneProgram() = default;
};

/// Makes the lanes of a program, one `LaneProgram` per thread. Called by all these threads at once.
using MakeLanes = std::function<std::unique_ptr<LaneProgram>()>;

}  // namespace dmocbench
