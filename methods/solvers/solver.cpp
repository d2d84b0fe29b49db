#include "methods/solvers/solver.hpp"

#include <array>
#include <cmath>
#include <sstream>

#include "methods/error.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "methods/solvers/ipopt_solver.hpp"
#include "methods/solvers/nlopt_solver.hpp"
#include "methods/solvers/sqp/sqp_solver.hpp"

namespace dmocbench {

namespace {

struct Entry {
  std::string_view name;
  std::unique_ptr<Solver> (*make)(const SolverOptions&);
};

template <class Type>
std::unique_ptr<Solver> make(const SolverOptions& options) {
  return std::make_unique<Type>(options);
}

// One line per solver, the default first.
constexpr std::array registry{
    Entry{"ipopt", make<IpoptSolver>},
    Entry{"interior_point", make<InteriorPointSolver>},
    Entry{"sqp", make<SqpSolver>},
    Entry{"nlopt", make<NloptSolver>},
};

}  // namespace

void SolverOptions::validate() const {
  std::ostringstream text;
  if (!(tolerance > 0.0) || !(tolerance < 1.0)) {
    text << "the tolerance must lie between 0 and 1, got " << tolerance;
  } else if (most_iterations < 1) {
    text << "the largest number of iterations must be at least 1, got " << most_iterations;
  } else if (!(most_seconds >= 0.0) || std::isinf(most_seconds)) {
    text << "the time limit must be a number of seconds, or 0 for none, got " << most_seconds;
  }
  if (!text.str().empty()) throw Error(text.str());
}

void require_start(const NonlinearProgram& program, const Eigen::VectorXd& start) {
  if (static_cast<std::size_t>(start.size()) == program.variable_count()) return;
  throw Error("the start has " + std::to_string(start.size()) + " entries, the program " +
              std::to_string(program.variable_count()) + " variables");
}

std::vector<std::string> solver_names() {
  std::vector<std::string> names;
  names.reserve(registry.size());
  for (const Entry& entry : registry) names.emplace_back(entry.name);
  return names;
}

std::unique_ptr<Solver> make_solver(std::string_view name, const SolverOptions& options) {
  options.validate();
  std::string known;
  for (const Entry& entry : registry) {
    if (entry.name == name) return entry.make(options);
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw Error("there is no solver \"" + std::string(name) + "\"; choose one of " + known);
}

}  // namespace dmocbench
