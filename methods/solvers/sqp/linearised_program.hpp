#pragma once

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/linearisation.hpp"
#include "methods/solvers/sqp/quadratic/quadratic_program.hpp"

namespace dmocbench::sqp {

/// The quadratic program at a point with derivatives; `hessian` must outlive it.
[[nodiscard]] QuadraticProgram quadratic_program_at(const NonlinearProgram& program, const Linearisation& at,
                                                    const Hessian& hessian);

}  // namespace dmocbench::sqp
