#include "methods/extensions/interchange/ampl_answer.hpp"

#include <utility>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/judgement/kkt_residual.hpp"
#include "methods/program/counted_program.hpp"

namespace dmocbench {

AmplAnswer::AmplAnswer(AmplSolution answer, SolverOptions options)
    : SolverWithoutMemory(std::move(options)), answer_(std::move(answer)) {}

void AmplAnswer::require_fit(const NonlinearProgram& program) const {
  if (std::cmp_equal(answer_.variable_count, program.variable_count()) &&
      std::cmp_equal(answer_.constraint_count, program.constraint_count())) {
    return;
  }
  throw Error(fmt::format("it answers a program of {} variables and {} constraints, this one has {} and {}",
                          answer_.variable_count, answer_.constraint_count, program.variable_count(),
                          program.constraint_count()));
}

Solution AmplAnswer::run(CountedProgram& program, const Eigen::VectorXd& /*start*/) const {
  require_fit(program);
  Solution solution;
  solution.status = answer_.status();
  solution.primal = answer_.primal;
  solution.multipliers = answer_.multipliers;
  if (solution.primal.size() == 0) {  // there is no answer without a point
    if (is_solved(solution.status)) solution.status = Status::solver_error;
    solution.multipliers.resize(0);
  }
  if (solution.multipliers.size() > 0) {
    const Eigen::VectorXd other = -solution.multipliers;
    const auto stationarity = [&](const Eigen::VectorXd& multipliers) {
      return kkt_residual(program.uncounted(), solution.primal, multipliers).stationarity;
    };
    if (stationarity(other) < stationarity(solution.multipliers)) solution.multipliers = other;
  }
  return solution;
}

}  // namespace dmocbench
