#include "methods/solvers/interior_point/interior_point_solver.hpp"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/solvers/counted_program.hpp"
#include "methods/solvers/interior_point/banded_kkt.hpp"
#include "methods/solvers/interior_point/interior_point_run.hpp"
#include "methods/solvers/interior_point/intervals/interval_kkt.hpp"
#include "methods/solvers/interior_point/intervals/recombined_kkt.hpp"
#include "methods/solvers/interior_point/refined_kkt.hpp"
#include "methods/solvers/interior_point/sparse_kkt.hpp"
#include "methods/solvers/named_options.hpp"

namespace dmocbench {

namespace {

using Factorisation = InteriorPointOptions::Factorisation;

/// Null, with the reason in `why`, where the program has no structure that intervals need.
std::unique_ptr<interior_point::KktSystem> make_system(NonlinearProgram& program,
                                                       const interior_point::ProgramRuns& runs,
                                                       const InteriorPointOptions& choices, std::string& why) {
  if (choices.make_kkt_system) return choices.make_kkt_system(program);
  const Factorisation choice = choices.factorisation;
  if (choice == Factorisation::sparse) return std::make_unique<interior_point::SparseKkt>(program);
  if (choice == Factorisation::recombined) return interior_point::RecombinedKkt::make(program, why);
  if (choice == Factorisation::banded) return interior_point::BandedKkt::make(program, why);
  auto by_intervals = interior_point::IntervalKkt::make(program, runs, why);
  if (!by_intervals) return nullptr;
  return std::make_unique<interior_point::RefinedKkt>(program, runs, std::move(by_intervals));
}

}  // namespace

InteriorPointSolver::InteriorPointSolver(SolverOptions options, InteriorPointOptions choices)
    : Solver(std::move(options)), choices_(std::move(choices)) {
  read_named_options("interior_point", this->options().passed_on,
                     {named_option("factorisation", choices_.factorisation,
                                   {{"intervals", Factorisation::intervals},
                                    {"recombined", Factorisation::recombined},
                                    {"banded", Factorisation::banded},
                                    {"sparse", Factorisation::sparse}})});
}

std::string InteriorPointSolver::description() const {
  return "interior-point method whose linear systems are eliminated interval by interval; exact Hessian";
}

Solution InteriorPointSolver::run(CountedProgram& program, const Eigen::VectorXd& start) const {
  const auto given = static_cast<std::size_t>(options().start_multipliers.size());
  if (given > 0 && given != program.constraint_count()) {
    throw Error(fmt::format("the solver interior_point got {} start multipliers; the program has {} constraints", given,
                            program.constraint_count()));
  }
  std::string why;
  const interior_point::ProgramRuns runs(program);
  const auto kkt = make_system(program, runs, choices_, why);
  if (!kkt) {
    Solution refused;
    refused.status = Status::invalid_program;
    refused.message = fmt::format(
        "interior_point cannot eliminate this program interval by interval: {}; choose ipopt, or the option "
        "factorisation=sparse.",
        why);
    return refused;
  }
  return interior_point::InteriorPointRun(program, runs, *kkt, start, options()).run();
}

}  // namespace dmocbench
