#pragma once

#include <vector>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::interior_point {

/// The runs of a program's matrices.
struct ProgramRuns {
  explicit ProgramRuns(const NonlinearProgram& program)
      : jacobian(program.jacobian_structure().runs()), hessian(program.hessian_structure().runs()) {}

  const std::vector<PatternRun>& jacobian;
  const std::vector<PatternRun>& hessian;  ///< of the lower triangle
};

}  // namespace dmocbench::interior_point
