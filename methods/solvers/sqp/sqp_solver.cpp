#include "methods/solvers/sqp/sqp_solver.hpp"

#include <charconv>
#include <utility>

#include "methods/error.hpp"
#include "methods/solvers/confirm.hpp"
#include "methods/solvers/sqp/sequential_run.hpp"

namespace dmocbench {

namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& choices) {
  throw Error("the solver sqp: " + option + " must be " + choices + ", not " + value);
}

std::string pricing_choices() {
  std::string text;
  for (const std::string& name : sqp::pricing_names()) text += (text.empty() ? "" : ", ") + name;
  return "one of " + text;
}

/// Which of two words; throws `Error` on another one.
bool is_second(const std::string& option, const std::string& value, const char* first, const char* second) {
  if (value != first && value != second) refuse(option, value, std::string(first) + " or " + second);
  return value == second;
}

sqp::SequentialOptions read(const std::map<std::string, std::string>& passed_on) {
  sqp::SequentialOptions choices;
  for (const auto& [option, value] : passed_on) {
    if (option == "crash") {
      choices.crash = is_second(option, value, "none", "basis") ? sqp::Crash::basis : sqp::Crash::none;
    } else if (option == "hessian") {
      choices.limited_memory = is_second(option, value, "exact", "limited_memory");
    } else if (option == "pricing") {
      const auto rule = sqp::pricing_named(value);
      if (!rule) refuse(option, value, pricing_choices());
      choices.pricing = *rule;
    } else if (option == "seed") {
      const auto read = std::from_chars(value.data(), value.data() + value.size(), choices.seed);
      if (read.ec != std::errc() || read.ptr != value.data() + value.size()) refuse(option, value, "a whole number");
    } else {
      throw Error("the solver sqp has no option " + option + "; it has crash, hessian, pricing and seed");
    }
  }
  return choices;
}

}  // namespace

SqpSolver::SqpSolver(SolverOptions options) : options_(std::move(options)) {
  options_.validate();
  static_cast<void>(read(options_.passed_on));
}

std::string SqpSolver::description() const {
  return "sequential quadratic programming by an active-set method that counts every minor iteration; exact Hessian";
}

Solution SqpSolver::solve(NonlinearProgram& program, const Eigen::VectorXd& start) const {
  require_start(program, start);
  Solution solution = sqp::SequentialRun(program, start, options_, read(options_.passed_on)).run();
  const std::string message = solution.message;
  confirm(program, options_.tolerance, solution);
  if (solution.status == Status::step_failed) solution.message = message;
  return solution;
}

}  // namespace dmocbench
