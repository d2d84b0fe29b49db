#include "bench/experiments/invariants/orthogonal_forces.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "bench/experiments/invariants/example_systems.hpp"
#include "bench/run/column.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/start_provider.hpp"
#include "methods/transcription/elements/families.hpp"

namespace dmocbench {

namespace {

struct KeptMomentum {
  Scheme scheme;
  long long intervals = 0;
  double h = 0.0;
  double objective = 0.0;
  double momentum = 0.0;
  double deviation = 0.0;
  double control = 0.0;
  double rounding = 0.0;
};

const Columns<KeptMomentum> kept_momentum_columns =
    scheme_columns<KeptMomentum>() +
    Columns<KeptMomentum>{
        {"intervals", "", "number of intervals N", &KeptMomentum::intervals, in_key},
        {"h", "", "step", &KeptMomentum::h},
        {"objective", "", "cost of the optimal motion", &KeptMomentum::objective},
        {"momentum", "", "J_0 = p_0·xi", &KeptMomentum::momentum},
        {"momentum_deviation", "", "max over k of |J_k - J_0| along the optimal motion", &KeptMomentum::deviation},
        {"largest_control", "", "largest control of a stage", &KeptMomentum::control},
        {"rounding", "", "machine epsilon times max |q| / h, which momenta from differences of positions carry",
         &KeptMomentum::rounding}};

KeptMomentum measured(const Case& the_case, const Trajectory& motion) {
  const Problem& problem = *the_case.problem;
  const Eigen::VectorXd momentum = motion.p.lazyProduct(constant_generator(problem));
  const double h = motion.step(0);
  return {.scheme = {problem.name(), the_case.method, the_case.tableau, the_case.stages},
          .intervals = static_cast<long long>(the_case.intervals()),
          .h = h,
          .objective = motion.cost,
          .momentum = momentum[0],
          .deviation = (momentum.array() - momentum[0]).abs().maxCoeff(),
          .control = motion.stage_u.cwiseAbs().maxCoeff(),
          .rounding = std::numeric_limits<double>::epsilon() * motion.q.cwiseAbs().maxCoeff() / h};
}

}  // namespace

Table orthogonal_forces_table(const SolverOptions& options) {
  StartProvider starts({.start = "guess"}, options);
  const std::unique_ptr<Solver> solver = make_solver("ipopt", options);
  std::vector<KeptMomentum> rows;
  const std::vector<std::shared_ptr<const Problem>> problems{std::make_shared<RadialThrust>(),
                                                             std::make_shared<MeridianPendulum>()};
  for (const auto& problem : problems) {
    for (const std::string& method : paper_families()) {
      for (const int stages : {1, 2}) {
        for (const long long intervals : {32, 64, 128, 256}) {
          throw_if_interrupted();
          const Case the_case{.problem = problem,
                              .method = method,
                              .tableau = "gauss",
                              .stages = stages,
                              .solver = "ipopt",
                              .grid = Grid::uniform(intervals)};
          const SolvedCase solved =
              solve_case(the_case, starts.start_for(the_case), *solver, options.tolerance, 1, true);
          if (!solved.trajectory || !is_solved(solved.solution.status)) {
            throw Error(the_case.label() + " could not be solved: " + solved.solution.message);
          }
          rows.push_back(measured(the_case, *solved.trajectory));
        }
      }
    }
  }
  return table_of(kept_momentum_columns, rows);
}

}  // namespace dmocbench
