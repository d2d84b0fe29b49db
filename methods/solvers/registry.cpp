#include <array>
#include <functional>

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
  std::unique_ptr<Solver> (*make)(const SolverOptions&, const NamedOptions&);
};

/// `typed` makes the solver's own options of the named ones.
template <class Type, auto typed>
std::unique_ptr<Solver> make(const SolverOptions& options, const NamedOptions& named) {
  return std::make_unique<Type>(options, typed(named));
}

constexpr std::identity as_they_stand;

// One line per solver, the default first.
constexpr std::array registry{
    Entry{"ipopt", make<IpoptSolver, as_they_stand>},
    Entry{"interior_point", make<InteriorPointSolver, interior_point_options>},
    Entry{"sqp", make<SqpSolver, sequential_options>},
    Entry{"nlopt", make<NloptSolver, as_they_stand>},
    Entry{"auto", make<AutoSolver, auto_options>},
};

}  // namespace

std::vector<std::string> solver_names() { return names_of(registry, &Entry::name); }

std::unique_ptr<Solver> make_solver(std::string_view name, const SolverOptions& options, const NamedOptions& named) {
  return one_of(registry, &Entry::name, name, "there is no solver").make(options, named);
}

}  // namespace dmocbench
