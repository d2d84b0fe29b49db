#include <array>

#include "methods/choose.hpp"
#include "methods/solvers/auto/auto_solver.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "methods/solvers/ipopt_solver.hpp"
#include "methods/solvers/nlopt_solver.hpp"
#include "methods/solvers/solver.hpp"
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
    Entry{"ipopt", make<IpoptSolver>}, Entry{"interior_point", make<InteriorPointSolver>},
    Entry{"sqp", make<SqpSolver>},     Entry{"nlopt", make<NloptSolver>},
    Entry{"auto", make<AutoSolver>},
};

}  // namespace

std::vector<std::string> solver_names() { return names_of(registry, &Entry::name); }

std::unique_ptr<Solver> make_solver(std::string_view name, const SolverOptions& options) {
  return one_of(registry, &Entry::name, name, "there is no solver").make(options);
}

}  // namespace dmocbench
