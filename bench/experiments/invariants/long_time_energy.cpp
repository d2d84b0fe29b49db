#include "bench/experiments/invariants/long_time_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <boost/numeric/odeint.hpp>

#include "bench/experiments/invariants/example_systems.hpp"
#include "bench/run/interrupt.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/one_step_map.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"

namespace dmocbench {

namespace {

namespace odeint = boost::numeric::odeint;

/// These are watched whatever the number of periods is.
constexpr long long first_periods = 10;

/// Moves (q, v) by one step; p = v, because the mass of `Kepler` is the identity.
using Stepper = std::function<void(Eigen::VectorXd& q, Eigen::VectorXd& v)>;

Stepper implicit_method(const Problem& problem, const std::string& element, const Tableau& tableau, double h) {
  const auto map = std::make_shared<OneStepMap<double>>(TracedProblem(problem), *make_element(element), tableau);
  const Eigen::MatrixXd no_control = Eigen::MatrixXd::Zero(tableau.stages(), problem.control_size());
  return [=](Eigen::VectorXd& q, Eigen::VectorXd& v) {
    OneStepMap<double>::Step step = map->advance(q, v, v, no_control, h, 0.0);
    q = std::move(step.q);
    v = std::move(step.p);
  };
}

using PhaseVector = std::vector<double>;  // q, then v

template <class Method>
Stepper explicit_method(const Problem& problem, Method method, double h) {
  const auto motion = std::make_shared<EquationsOfMotion>(TracedProblem(problem));
  const Eigen::VectorXd no_control = Eigen::VectorXd::Zero(problem.control_size());
  return [=](Eigen::VectorXd& q, Eigen::VectorXd& v) mutable {
    PhaseVector state(q.begin(), q.end());
    state.insert(state.end(), v.begin(), v.end());
    const auto equations = [&](const PhaseVector& x, PhaseVector& rate, double t) {
      motion->write_rate(x, no_control, t, rate);
    };
    method.do_step(equations, state, 0.0, h);
    std::copy_n(state.begin(), q.size(), q.begin());
    std::copy_n(state.begin() + q.size(), v.size(), v.begin());
  };
}

/// y_{n+1} = y_n + h f(y_n + h/2 f(y_n)).
auto explicit_midpoint() {
  return odeint::explicit_generic_rk<2, 2, PhaseVector>(boost::fusion::make_vector(boost::array<double, 1>{{0.5}}),
                                                        boost::array<double, 2>{{0.0, 1.0}},
                                                        boost::array<double, 2>{{0.0, 0.5}});
}

Stepper stepper_of(const LongTimeMethod& method, const Problem& problem, double h) {
  if (method.kind == LongTimeMethod::Kind::dmoc) {
    return implicit_method(problem, "dmoc", make_tableau(method.tableau, method.stages), h);
  }
  if (method.kind == LongTimeMethod::Kind::radau) {
    // Radau IIA is collocation of the equations of motion: its stages, with the end of the step among them.
    const long double root = std::sqrt(6.0L);
    const std::vector<long double> nodes{(4.0L - root) / 10.0L, (4.0L + root) / 10.0L, 1.0L};
    return implicit_method(problem, "tangent", collocation_tableau("radau", nodes, method.order), h);
  }
  if (method.kind == LongTimeMethod::Kind::explicit_midpoint) return explicit_method(problem, explicit_midpoint(), h);
  return explicit_method(problem, odeint::runge_kutta4<PhaseVector>(), h);
}

}  // namespace

std::vector<LongTimeMethod> long_time_methods() {
  using Kind = LongTimeMethod::Kind;
  return {{.kind = Kind::dmoc, .name = "dmoc", .tableau = "gauss", .stages = 1, .order = 2},
          {.kind = Kind::dmoc, .name = "dmoc", .tableau = "gauss", .stages = 2, .order = 4},
          {.kind = Kind::radau, .name = "radau", .tableau = "radau", .stages = 3, .order = 5},
          {.kind = Kind::explicit_midpoint, .name = "explicit_midpoint", .tableau = "", .stages = 2, .order = 2},
          {.kind = Kind::runge_kutta_4, .name = "runge_kutta_4", .tableau = "", .stages = 4, .order = 4}};
}

std::vector<PeriodEnergy> long_time_energy(const LongTimeMethod& method, int steps_per_period, long long periods) {
  constexpr long long watched = 200;
  const Kepler problem;
  const Stepper advance = stepper_of(method, problem, Kepler::period / steps_per_period);
  Energy energy(problem);
  Eigen::VectorXd q = problem.initial_state().q;
  Eigen::VectorXd v = problem.initial_state().v;
  const double initial = energy.energy(q, v, 0.0);
  const long long every = std::max(1LL, periods / watched);
  std::vector<PeriodEnergy> result;
  for (long long k = 0; k < periods; ++k) {
    throw_if_interrupted();
    const bool is_watched = k < first_periods || (k + 1) % every == 0;
    PeriodEnergy period{.period = k,
                        .smallest = std::numeric_limits<double>::infinity(),
                        .mean = 0.0,
                        .largest = -std::numeric_limits<double>::infinity()};
    for (int i = 0; i < steps_per_period; ++i) {
      advance(q, v);
      if (!is_watched) continue;
      const double error = energy.energy(q, v, 0.0) - initial;
      period.smallest = std::min(period.smallest, error);
      period.largest = std::max(period.largest, error);
      period.mean += error / steps_per_period;
    }
    if (is_watched) result.push_back(period);
  }
  return result;
}

EnergyBehaviour energy_behaviour(const std::vector<PeriodEnergy>& periods) {
  if (periods.size() < 3) throw Error("a drift needs at least three periods");
  EnergyBehaviour behaviour;
  double smallest = periods.front().smallest;
  double largest = periods.front().largest;
  Eigen::ArrayXd times(periods.size());
  Eigen::ArrayXd means(periods.size());
  for (std::size_t i = 0; i < periods.size(); ++i) {
    smallest = std::min(smallest, periods[i].smallest);
    largest = std::max(largest, periods[i].largest);
    if (periods[i].period < first_periods) behaviour.oscillation = largest - smallest;
    times[static_cast<Eigen::Index>(i)] = static_cast<double>(periods[i].period);
    means[static_cast<Eigen::Index>(i)] = periods[i].mean;
  }
  times -= times.mean();
  means -= means.mean();
  const double spread = times.square().sum();
  behaviour.drift_per_period = (times * means).sum() / spread;
  const double residual = (means - behaviour.drift_per_period * times).square().sum();
  behaviour.standard_error = std::sqrt(residual / (static_cast<double>(periods.size()) - 2.0) / spread);
  behaviour.range = largest - smallest;
  behaviour.change = periods.back().mean - periods.front().mean;
  return behaviour;
}

}  // namespace dmocbench
