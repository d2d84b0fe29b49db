#include "methods/solvers/interior_point/interior_point_solver.hpp"

#include <array>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <tl/expected.hpp>

#include "methods/error.hpp"
#include "methods/solvers/counted_program.hpp"
#include "methods/solvers/interior_point/interior_point_run.hpp"
#include "methods/solvers/interior_point/intervals/interval_kkt.hpp"
#include "methods/solvers/interior_point/refined_kkt.hpp"
#include "methods/solvers/interior_point/sparse_kkt.hpp"
#include "methods/solvers/named_options.hpp"

namespace dmocbench {

namespace {

using Factorisation = InteriorPointOptions::Factorisation;

constexpr std::array<NamedChoice<Factorisation>, 2> factorisations{
    {{"intervals", Factorisation::intervals}, {"sparse", Factorisation::sparse}}};

using interior_point::KktSystem;

/// The reason in a sentence where the program has no structure that intervals need.
tl::expected<std::unique_ptr<KktSystem>, std::string> make_system(NonlinearProgram& program,
                                                                  const interior_point::ProgramRuns& runs,
                                                                  const InteriorPointOptions& choices) {
  if (choices.make_kkt_system) return choices.make_kkt_system(program);
  if (choices.factorisation == Factorisation::sparse) return std::make_unique<interior_point::SparseKkt>(program);
  return interior_point::IntervalKkt::make(program, runs).map([&](auto kkt) -> std::unique_ptr<KktSystem> {
    return std::make_unique<interior_point::RefinedKkt>(program, runs, std::move(kkt));
  });
}

}  // namespace

InteriorPointSolver::InteriorPointSolver(SolverOptions options, InteriorPointOptions choices)
    : Solver(std::move(options)), choices_(std::move(choices)) {
  NamedOptions named("interior_point", this->options().passed_on);
  named.read("factorisation", choices_.factorisation, factorisations);
  named.refuse_others();
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
  const interior_point::ProgramRuns runs(program);
  const auto kkt = make_system(program, runs, choices_);
  if (!kkt) {
    Solution refused;
    refused.status = Status::invalid_program;
    refused.message = fmt::format(
        "interior_point cannot eliminate this program interval by interval: {}; choose ipopt, or the option "
        "factorisation=sparse.",
        kkt.error());
    return refused;
  }
  return interior_point::InteriorPointRun(program, runs, **kkt, start, options()).run();
}

}  // namespace dmocbench
