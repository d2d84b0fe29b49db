#include "methods/solvers/sqp/sqp_solver.hpp"

#include <utility>

#include "methods/solvers/counted_program.hpp"
#include "methods/solvers/named_options.hpp"
#include "methods/solvers/sqp/sequential_run.hpp"

namespace dmocbench {

SqpSolver::SqpSolver(SolverOptions options, SequentialOptions choices) : Solver(std::move(options)), choices_(choices) {
  using sqp::Crash;
  using sqp::PricingRule;
  read_named_options("sqp", this->options().passed_on,
                     {named_option("crash", choices_.crash, {{"none", Crash::none}, {"basis", Crash::basis}}),
                      named_option("hessian", choices_.limited_memory, {{"exact", false}, {"limited_memory", true}}),
                      named_option("pricing", choices_.pricing,
                                   {{"largest", PricingRule::largest},
                                    {"lowest", PricingRule::lowest},
                                    {"last", PricingRule::last},
                                    {"random", PricingRule::random}}),
                      named_option("seed", choices_.seed)});
}

std::string SqpSolver::description() const {
  return "sequential quadratic programming by an active-set method that counts every minor iteration; exact Hessian";
}

Solution SqpSolver::run(CountedProgram& program, const Eigen::VectorXd& start) const {
  return sqp::SequentialRun(program, start, options(), choices_).run();
}

}  // namespace dmocbench
