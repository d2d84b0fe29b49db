#include "bench/experiments/invariants/momentum_tables.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "bench/experiments/invariants/example_systems.hpp"
#include "bench/run/column.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/start_provider.hpp"
#include "methods/diagnostics/discrete_lagrangian.hpp"
#include "methods/diagnostics/one_step_map.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/transcription/elements/families.hpp"

namespace dmocbench {

namespace {

/// The generators about three axes at q, a column each.
using Generators = std::function<LongMatrix(const LongVector& q)>;

struct RotatedSystem {
  std::shared_ptr<const Problem> problem;
  const char* action;  ///< on the coordinates: "linear" or "polar"
  Generators generators;
};

/// ξ_a(q) = a × q.
LongMatrix cross_products(const LongVector& q) {
  LongMatrix xi(3, 3);
  xi << 0.0L, q[2], -q[1],  //
      -q[2], 0.0L, q[0],    //
      q[1], -q[0], 0.0L;
  return xi;
}

/// The same on the sphere, q = (θ, φ) with θ from the third axis.
LongMatrix on_sphere(const LongVector& q) {
  using std::cos, std::sin;
  const long double cotangent = cos(q[0]) / sin(q[0]);
  LongMatrix xi(2, 3);
  xi << -sin(q[1]), cos(q[1]), 0.0L,  //
      -cotangent * cos(q[1]), -cotangent * sin(q[1]), 1.0L;
  return xi;
}

std::vector<RotatedSystem> rotated_systems() {
  return {{std::make_shared<ElasticPendulum>(), "linear", cross_products},
          {std::make_shared<ThreeSphere>(), "linear", cross_products},
          {std::make_shared<WeightlessPendulum>(), "polar", on_sphere}};
}

struct Rotated {
  Scheme scheme;
  const char* action = "";
  int axis = 0;
  int steps = 0;
  double h = 0.0;
  double change = 0.0;
  double work = 0.0;
  double defect = 0.0;
};

const Columns<Rotated> rotated_columns =
    scheme_columns<Rotated>() +
    Columns<Rotated>{
        {"action", "", "action of the rotations on the coordinates", &Rotated::action},
        {"axis", "", "1, 2 or 3", &Rotated::axis, in_key},
        {"steps", "", "number of steps", &Rotated::steps},
        {"h", "", "step", &Rotated::h},
        {"momentum_change", "", "J_N - J_0, momentum about this axis", &Rotated::change},
        {"work", "", "work of the discrete forces, sum of f_d^-·xi(q_k) + f_d^+·xi(q_k+1)", &Rotated::work},
        {"defect", "", "max over k of |J_k - J_0 - work|, in long double", &Rotated::defect}};

/// Forces of every direction that are neither smooth nor random.
LongMatrix arbitrary_forces(Eigen::Index m, int step) {
  return LongMatrix::NullaryExpr(1, m, [=](Eigen::Index, Eigen::Index j) {
    return 0.3L * std::sin(1.0L + 7.3L * static_cast<long double>(step) + 2.9L * static_cast<long double>(j));
  });
}

void follow(const RotatedSystem& system, const std::string& method, int steps, std::vector<Rotated>& rows) {
  constexpr double h = 0.05;
  const Problem& problem = *system.problem;
  const TracedProblem traced(problem);
  const OneStepMap<long double> map(traced, *make_element(method), gauss_tableau(1));
  const BoundaryState start = problem.initial_state();
  LongVector q = start.q.cast<long double>();
  LongVector p = LegendreTransform(traced).momentum(start.q, start.v, 0.0).cast<long double>();
  LongVector velocity = start.v.cast<long double>();
  const LongVector first = system.generators(q).transpose().lazyProduct(p);
  LongVector work = LongVector::Zero(3);
  LongVector change = LongVector::Zero(3);
  LongVector defect = LongVector::Zero(3);
  for (int k = 0; k < steps; ++k) {
    throw_if_interrupted();
    const auto step = map.advance(q, p, velocity, arbitrary_forces(problem.control_size(), k), h, 0.0L);
    // f_d^- = f_d^+ = half the impulse for the midpoint rule.
    const LongMatrix both = system.generators(q) + system.generators(step.q);
    work += 0.5L * both.transpose().lazyProduct(step.impulse);
    q = step.q;
    p = step.p;
    velocity = step.mean_velocity;
    change = system.generators(q).transpose().lazyProduct(p) - first;
    defect = defect.cwiseMax((change - work).cwiseAbs());
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    rows.push_back({.scheme = {problem.name(), method, "gauss", 1},
                    .action = system.action,
                    .axis = static_cast<int>(axis) + 1,
                    .steps = steps,
                    .h = h,
                    .change = static_cast<double>(change[axis]),
                    .work = static_cast<double>(work[axis]),
                    .defect = static_cast<double>(defect[axis])});
  }
}

}  // namespace

Table rotations_table(int steps) {
  std::vector<Rotated> rows;
  for (const RotatedSystem& system : rotated_systems()) {
    for (const std::string& method : paper_families()) follow(system, method, steps, rows);
  }
  return table_of(rotated_columns, rows);
}

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
        {"objective", "", "cost of the optimal trajectory", &KeptMomentum::objective},
        {"momentum", "", "J_0 = p_0·xi", &KeptMomentum::momentum},
        {"momentum_deviation", "", "max over k of |J_k - J_0| along the optimal trajectory", &KeptMomentum::deviation},
        {"largest_control", "", "largest control of any stage", &KeptMomentum::control},
        {"rounding", "", "machine epsilon times max |q| / h, the round-off of momenta from differences of positions",
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
                              .stages = stages,
                              .solver = "ipopt",
                              .grid = Grid::uniform(intervals)};
          const SolvedCase solved =
              solve_case(the_case, starts.start_for(the_case), *solver, options.tolerance, 1, true);
          // The symmetry is one of the discrete program, however coarse its grid.
          const Status status = solved.solution.status;
          if (!solved.trajectory || !(is_solved(status) || is_no_motion(status))) {
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
