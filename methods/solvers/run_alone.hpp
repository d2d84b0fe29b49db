#pragma once

#include <Eigen/Core>

#include "methods/kkt/symmetric_factorisation.hpp"
#include "methods/program/counted_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/solvers/solver.hpp"

namespace dmocbench {

/// The result of `method`, called while no other thread uses MUMPS (`lock_mumps`). Where a stop request or the limit of
/// time comes before its turn, the answer is `start`. The wait does not count as the solver's time.
template <class Method>
Solution run_alone(CountedProgram& program, const Eigen::VectorXd& start, const SolverOptions& options,
                   const Method& method) {
  const Clock::time_point begin = Clock::now();
  const auto lock =
      lock_mumps([&] { return program.is_out_of_time() || (options.stop_requested && options.stop_requested()); });
  program.leave_out(seconds_since(begin));
  if (lock) return method();
  Solution solution;
  solution.status = program.is_out_of_time() ? Status::time_limit : Status::interrupted;
  solution.primal = start;
  return solution;
}

}  // namespace dmocbench
