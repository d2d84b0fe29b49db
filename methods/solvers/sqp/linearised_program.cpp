#include "methods/solvers/sqp/linearised_program.hpp"

namespace dmocbench::sqp {

QuadraticProgram quadratic_program_at(const NonlinearProgram& program, const Linearisation& at,
                                      const Hessian& hessian) {
  QuadraticProgram result{.hessian = &hessian, .gradient = at.gradient, .rows = at.jacobian, .lower = {}, .upper = {}};
  result.lower.resize(result.column_count());
  result.upper.resize(result.column_count());
  result.lower << program.variable_lower() - at.point, program.constraint_lower() - at.constraints;
  result.upper << program.variable_upper() - at.point, program.constraint_upper() - at.constraints;
  return result;
}

}  // namespace dmocbench::sqp
