#include "methods/solvers/sqp/sqp_solver.hpp"

#include <utility>

#include "methods/solvers/counted_program.hpp"
#include "methods/solvers/named_options.hpp"
#include "methods/solvers/sqp/sequential_run.hpp"

namespace dmocbench {

namespace {

using sqp::Crash;
using sqp::PricingRule;

constexpr std::array<NamedChoice<Crash>, 2> crashes{{{"none", Crash::none}, {"basis", Crash::basis}}};
constexpr std::array<NamedChoice<bool>, 2> hessians{{{"exact", false}, {"limited_memory", true}}};
constexpr std::array<NamedChoice<PricingRule>, 4> pricing_rules{{{"largest", PricingRule::largest},
                                                                 {"lowest", PricingRule::lowest},
                                                                 {"last", PricingRule::last},
                                                                 {"random", PricingRule::random}}};

}  // namespace

SqpSolver::SqpSolver(SolverOptions options, SequentialOptions choices) : Solver(std::move(options)), choices_(choices) {
  NamedOptions named("sqp", this->options().passed_on);
  named.read("crash", choices_.crash, crashes);
  named.read("hessian", choices_.limited_memory, hessians);
  named.read("pricing", choices_.pricing, pricing_rules);
  named.read("seed", choices_.seed);
  named.refuse_others();
}

std::string SqpSolver::description() const {
  return "sequential quadratic programming by an active-set method that counts every minor iteration; exact Hessian";
}

Solution SqpSolver::run(CountedProgram& program, const Eigen::VectorXd& start) const {
  return sqp::SequentialRun(program, start, options(), choices_).run();
}

}  // namespace dmocbench
