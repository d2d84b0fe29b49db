#include "bench/experiments/invariants/simulated_tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bench/experiments/invariants/example_systems.hpp"
#include "bench/run/column.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/table_run.hpp"
#include "methods/diagnostics/discrete_lagrangian.hpp"
#include "methods/diagnostics/one_step_map.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

namespace {

/// Neither smooth nor random: the theorem makes no assumption on the controls.
Eigen::MatrixXd arbitrary_controls(Eigen::Index stages, Eigen::Index m, int step, double amplitude) {
  return Eigen::MatrixXd::NullaryExpr(stages, m, [=](Eigen::Index i, Eigen::Index j) {
    return amplitude * std::sin(1.0 + 7.3 * step + 2.1 * static_cast<double>(i) + 3.7 * static_cast<double>(j));
  });
}

/// Every method with every tableau.
template <class Visit>
void for_all_maps(const Visit& visit) {
  for (const std::string& method : paper_families()) {
    for (const Tableau& tableau : one_step_tableaus()) visit(*make_element(method), tableau);
  }
}

bool is_discrete_mechanics(const Element& element) { return element.node_state() == NodeState::configuration; }

/// The momentum along one simulated motion and the forces that change it.
struct Forced {
  Scheme scheme;
  const char* force = "";
  int steps = 0;
  double h = 0.0;
  double change = 0.0;
  double work = 0.0;
  std::optional<double> work_of_discrete_forces = {};  ///< of DMOC
  double defect = 0.0;
  double defect_in_long_double = 0.0;
};

/// Simulates a motion in numbers of type Scalar. `defect_in_long_double` is left to the caller.
template <class Scalar>
Forced simulate(const InvariantSystem& system, const Element& element, const Tableau& tableau, int steps) {
  using Vector = typename OneStepMap<Scalar>::Vector;
  const Problem& problem = *system.problem;
  const TracedProblem traced(problem);
  const OneStepMap<Scalar> map(traced, element, tableau);
  const DiscreteLagrangian discrete(problem, tableau);
  const Vector xi = constant_generator(problem).cast<Scalar>();

  Vector q = system.start.q.cast<Scalar>();
  Vector p = LegendreTransform(traced).momentum(system.start.q, system.start.v, 0.0).template cast<Scalar>();
  Vector velocity = system.start.v.cast<Scalar>();
  const Scalar first = p.dot(xi);
  const Scalar h = system.step;
  Scalar work = 0.0;
  long double work_of_discrete_forces = 0.0L;
  Scalar defect = 0.0;
  for (int k = 0; k < steps; ++k) {
    throw_if_interrupted();
    const Eigen::MatrixXd controls = arbitrary_controls(tableau.stages(), problem.control_size(), k, system.amplitude);
    const Scalar t = Scalar(k) * h;
    const auto step = map.advance(q, p, velocity, controls.cast<Scalar>(), h, t);
    if (is_discrete_mechanics(element)) {
      const DiscreteObjects objects = discrete.at(q.template cast<long double>(), step.q.template cast<long double>(),
                                                  controls.cast<long double>(), h, t);
      work_of_discrete_forces += (objects.left_force + objects.right_force).dot(xi.template cast<long double>());
    }
    q = step.q;
    p = step.p;
    velocity = step.mean_velocity;
    work += step.impulse.dot(xi);
    defect = std::max(defect, std::abs(p.dot(xi) - first - work));
  }
  Forced result{.scheme = {problem.name(), element.name(), tableau.family, tableau.stages()},
                .force = system.orthogonal ? "orthogonal" : "along",
                .steps = steps,
                .h = system.step,
                .change = static_cast<double>(p.dot(xi) - first),
                .work = static_cast<double>(work),
                .defect = static_cast<double>(defect)};
  if (is_discrete_mechanics(element)) result.work_of_discrete_forces = static_cast<double>(work_of_discrete_forces);
  return result;
}

struct SymplecticityDefect {
  double largest = 0.0;
  double rounding = 0.0;
};

struct Unforced {
  Scheme scheme;
  double h = 0.0;
  std::optional<SymplecticityDefect> defect = {};
  std::string message = {};
};

SymplecticityDefect unforced_defect(const MappedStates& system, const Element& element, const Tableau& tableau) {
  const Problem& problem = *system.problem;
  const TracedProblem traced(problem);
  const OneStepMap<double> map(traced, element, tableau);
  LegendreTransform legendre(traced);
  const Eigen::MatrixXd no_control = Eigen::MatrixXd::Zero(tableau.stages(), problem.control_size());
  SymplecticityDefect result;
  for (const BoundaryState& state : system.states) {
    throw_if_interrupted();
    const Eigen::VectorXd p = legendre.momentum(state.q, state.v, 0.0);
    const Eigen::MatrixXd d = map.jacobian(map.advance(state.q, p, state.v, no_control, system.step, 0.0));
    result.largest = std::max(result.largest, symplecticity_defect(d));
    result.rounding = std::max(result.rounding, std::numeric_limits<double>::epsilon() * d.cwiseAbs2().maxCoeff());
  }
  return result;
}

Unforced unforced(const MappedStates& system, const Element& element, const Tableau& tableau) {
  Unforced result{.scheme = {system.problem->name(), element.name(), tableau.family, tableau.stages()},
                  .h = system.step};
  const auto defect = measured_or_reason([&] { return unforced_defect(system, element, tableau); });
  if (defect) {
    result.defect = *defect;
  } else {
    result.message = defect.error();
  }
  return result;
}

constexpr int mapped_states = 8;

/// States around one, neither on a line nor random.
std::vector<BoundaryState> states_around(const BoundaryState& centre) {
  std::vector<BoundaryState> states(mapped_states, centre);
  for (int k = 0; k < mapped_states; ++k) {
    BoundaryState& state = states[static_cast<std::size_t>(k)];
    for (Eigen::Index i = 0; i < state.q.size(); ++i) {
      state.q[i] += 0.1 * std::cos(k * (1.0 + static_cast<double>(i)));
      state.v[i] += 0.1 * std::sin(k * (2.0 + static_cast<double>(i)));
    }
  }
  return states;
}

}  // namespace

std::vector<InvariantSystem> invariant_systems() {
  const auto radial = std::make_shared<RadialThrust>();
  const auto pendulum = std::make_shared<MeridianPendulum>();
  std::shared_ptr<Problem> links = make_problem("two_link_manipulator");
  links->set_parameter("gravity", 0.0);
  return {{radial, true, 0.3, radial->initial_state(), 0.05},
          {pendulum, true, 0.5, pendulum->initial_state(), 0.05},
          {make_problem("orbital_transfer"), false, 0.1, radial->initial_state(), 0.05},
          {links, false, 1.0, bent_links(), 0.02}};
}

std::vector<MappedStates> example_states() {
  const auto kepler = std::make_shared<Kepler>();
  return {{kepler, states_around(kepler->initial_state()), 0.1},
          {make_problem("orbital_transfer"), states_around(RadialThrust().initial_state()), 0.2},
          {make_problem("two_link_manipulator"), states_around(bent_links()), 0.1}};
}

MappedStates states_along(const std::shared_ptr<const Problem>& problem, const Trajectory& motion) {
  MappedStates system{.problem = problem, .states = {}, .step = motion.step(0)};
  for (Eigen::Index k = 0; k < mapped_states; ++k) {
    const MotionPoint node = motion.node(k * motion.intervals() / mapped_states);
    system.states.push_back({node.q, node.v});
  }
  return system;
}

Table noether_table(int steps) {
  std::vector<Forced> rows;
  for (const InvariantSystem& system : invariant_systems()) {
    for_all_maps([&](const Element& element, const Tableau& tableau) {
      rows.push_back(simulate<double>(system, element, tableau, steps));
      rows.back().defect_in_long_double = simulate<long double>(system, element, tableau, steps).defect;
    });
  }
  const Columns<Forced> columns{
      {"force", "", "direction of the force: orthogonal to the group action, or along it", &Forced::force, in_key},
      {"steps", "", "number of steps", &Forced::steps, in_key},
      {"h", "", "step", &Forced::h, in_key},
      {"momentum_change", "", "J_N - J_0", &Forced::change},
      {"work", "", "sum of h b_i f·xi", &Forced::work},
      {"work_of_discrete_forces", "", "sum of f_d^-·xi(q_k) + f_d^+·xi(q_k+1); only for DMOC",
       &Forced::work_of_discrete_forces},
      {"defect", "", "max over k of |J_k - J_0 - work|", &Forced::defect},
      {"defect_in_long_double", "",
       "the same defect with 64 bits of mantissa, which reduces round-off but not the discretisation error",
       &Forced::defect_in_long_double},
  };
  return table_of(scheme_columns<Forced>() + columns, rows);
}

SymplecticityTable symplecticity_table(const std::vector<MappedStates>& systems) {
  std::vector<Unforced> rows;
  for (const MappedStates& system : systems) {
    for_all_maps(
        [&](const Element& element, const Tableau& tableau) { rows.push_back(unforced(system, element, tableau)); });
  }
  const Columns<Unforced> columns{{"h", "", "step", &Unforced::h, in_key},
                                  {"defect", "", "largest entry of D^T Omega D - Omega over some states",
                                   from(&Unforced::defect, &SymplecticityDefect::largest)},
                                  {"rounding", "", "machine epsilon times the largest squared entry of D",
                                   from(&Unforced::defect, &SymplecticityDefect::rounding)},
                                  {"message", "", "reason for a missing defect", &Unforced::message}};
  return {.table = table_of(scheme_columns<Unforced>() + columns, rows),
          .unsolved = std::ranges::count_if(rows, [](const Unforced& row) { return !row.defect; })};
}

}  // namespace dmocbench
