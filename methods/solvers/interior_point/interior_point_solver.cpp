#include "methods/solvers/interior_point/interior_point_solver.hpp"

#include <map>
#include <memory>
#include <utility>

#include "methods/error.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/solvers/confirm.hpp"
#include "methods/solvers/interior_point/banded_kkt.hpp"
#include "methods/solvers/interior_point/interior_point_run.hpp"
#include "methods/solvers/interior_point/intervals/interval_kkt.hpp"
#include "methods/solvers/interior_point/refined_kkt.hpp"
#include "methods/solvers/interior_point/sparse_kkt.hpp"

namespace dmocbench {

namespace {

enum class Factorisation : unsigned char { intervals, banded, sparse };

const std::map<std::string, Factorisation> factorisations{
    {"intervals", Factorisation::intervals}, {"banded", Factorisation::banded}, {"sparse", Factorisation::sparse}};

Factorisation factorisation_of(const std::map<std::string, std::string>& passed_on) {
  Factorisation choice = Factorisation::intervals;
  for (const auto& [option, value] : passed_on) {
    if (option != "factorisation") {
      throw Error("the solver interior_point has no option " + option + "; it has factorisation");
    }
    const auto found = factorisations.find(value);
    if (found == factorisations.end()) {
      throw Error("the solver interior_point: factorisation must be intervals, banded or sparse, not " + value);
    }
    choice = found->second;
  }
  return choice;
}

/// Null, with the reason in `why`, where the program has no structure that intervals need.
std::unique_ptr<interior_point::KktSystem> make_system(const NonlinearProgram& program,
                                                       const interior_point::ProgramRuns& runs, Factorisation choice,
                                                       std::string& why) {
  if (choice == Factorisation::sparse) return std::make_unique<interior_point::SparseKkt>(program);
  if (choice == Factorisation::banded) return interior_point::BandedKkt::make(program, why);
  auto by_intervals = interior_point::IntervalKkt::make(program, runs, why);
  if (!by_intervals) return nullptr;
  return std::make_unique<interior_point::RefinedKkt>(program, runs, std::move(by_intervals));
}

}  // namespace

InteriorPointSolver::InteriorPointSolver(SolverOptions options) : options_(std::move(options)) {
  options_.validate();
  static_cast<void>(factorisation_of(options_.passed_on));
}

std::string InteriorPointSolver::description() const {
  return "interior-point method whose linear systems are eliminated interval by interval; exact Hessian";
}

Solution InteriorPointSolver::solve(NonlinearProgram& program, const Eigen::VectorXd& start) const {
  require_start(program, start);
  const auto given = static_cast<std::size_t>(options_.start_multipliers.size());
  if (given > 0 && given != program.constraint_count()) {
    throw Error("the solver interior_point got " + std::to_string(given) + " start multipliers; the program has " +
                std::to_string(program.constraint_count()) + " rows");
  }
  const Clock::time_point begin = Clock::now();
  std::string why;
  const interior_point::ProgramRuns runs(program);
  const auto kkt = make_system(program, runs, factorisation_of(options_.passed_on), why);
  if (!kkt) {
    Solution refused;
    refused.status = Status::invalid_program;
    refused.message = "interior_point cannot eliminate this program interval by interval: " + why +
                      "; choose ipopt, or the option factorisation=sparse.";
    return refused;
  }
  Solution solution = interior_point::InteriorPointRun(program, runs, *kkt, start, options_).run();
  solution.seconds = seconds_since(begin);  // finding the structure is part of it
  const std::string message = solution.message;
  confirm(program, options_.tolerance, solution);
  if (solution.status == Status::step_failed) solution.message = message;
  return solution;
}

}  // namespace dmocbench
