#include "bench/experiments/invariants/impact_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bench/experiments/invariants/example_systems.hpp"
#include "bench/run/column.hpp"
#include "bench/run/interrupt.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/exact_discrete_lagrangian.hpp"
#include "methods/diagnostics/one_step_map.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/transcription/elements/dmoc_element.hpp"

namespace dmocbench {

namespace {

/// A particle above an uneven planet, q = (r, φ), L = ½(ṙ² + r²φ̇²) + 1/r, f = (u - c ṙ, -c r²φ̇), u = 0. The ground
/// is r = 1 + 0.15 cos 3φ.
class BouncingParticle final : public ExampleSystem {
 public:
  explicit BouncingParticle(double drag)
      : ExampleSystem("bouncing_particle", {"r", "phi"}, {Eigen::Vector2d(1.5, 0.0), Eigen::Vector2d(0.0, 0.35)}, 3.0),
        drag_(drag) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * (x.v[0] * x.v[0] + x.q[0] * x.q[0] * x.v[1] * x.v[1]) + 1.0 / x.q[0];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0] - drag_ * x.v[0], -drag_ * x.q[0] * x.q[0] * x.v[1]}};
  }
  /// Above the ground.
  [[nodiscard]] static Expression height(const ExpressionVector& q) { return q[0] - 1.0 - 0.15 * cos(3.0 * q[1]); }

 private:
  double drag_;
};

/// The zero of a function of one number near `x`.
template <class Function>
double root_near(double x, const Function& f) {
  double before = x * (1.0 + 1e-4);
  double value_before = f(before);
  for (int i = 0; i < 50; ++i) {  // secants
    const double value = f(x);
    const double step = value * (x - before) / (value - value_before);
    if (!std::isfinite(step) || std::abs(step) <= 4e-16 * std::abs(x)) break;
    before = std::exchange(x, x - step);
    value_before = value;
  }
  return x;
}

/// A point of phase space on the way.
struct Phase {
  Eigen::VectorXd q;
  Eigen::VectorXd p;
};

/// The energies of one step next to an impact.
struct StepEnergy {
  double energy = 0.0;     // E_d
  double half_work = 0.0;  // ½ h Σ b_i f·Q̇_i
};

enum class ImpactCondition { momenta, steps, steps_and_work };
constexpr std::array impact_conditions{ImpactCondition::momenta, ImpactCondition::steps,
                                       ImpactCondition::steps_and_work};
constexpr const char* name_of(ImpactCondition condition) {
  return std::array{"momenta", "steps", "steps_and_work"}[static_cast<std::size_t>(condition)];
}

/// Motions of the particle with one bounce: exact ones, and ones of DMOC.
class Bounce {
 public:
  Bounce(const BouncingParticle& particle, const Tableau& tableau)
      : particle_(particle),
        traced_(particle),
        map_(traced_, DmocElement(), tableau),
        exact_(particle, [](const Expression& /*t*/) { return ExpressionVector::Constant(1, Expression(0.0)); }),
        legendre_(traced_),
        energy_(particle),
        no_control_(Eigen::MatrixXd::Zero(tableau.stages(), 1)) {
    const ExpressionVector q = input_vector(0, 2);
    const Expression height = BouncingParticle::height(q);
    ground_ = Schedule(stacked({ExpressionVector::Constant(1, height), gradient(height, q)}));
    InputCounter counter;  // as the map numbers its inputs
    IntervalUnknowns interval = take_unknowns(counter, traced_, DmocElement(), tableau);
    interval.h = counter.take();
    interval.t = counter.take();
    Expression energy;
    Expression work;
    const IntervalTrace trace = DmocElement().trace(traced_, tableau, interval);
    for (std::size_t i = 0; i < trace.stages.size(); ++i) {
      const ControlledState& stage = trace.stages[i];
      const TracedProblem::Values at = traced_.at(stage);
      const Expression weight(tableau.b[static_cast<Eigen::Index>(i)]);
      energy += weight * (at.momentum.dot(stage.v) - particle.lagrangian(stage.state()));
      work += interval.h * weight * at.control_force.dot(stage.v);
    }
    step_energy_ = Schedule(ExpressionVector{{energy, 0.5 * work}});
  }

  /// The motion's end and the change of E at the impact. `steps`: before and after the impact; 0: the exact motion.
  std::pair<Phase, double> operator()(ImpactCondition condition, int steps) {
    const double whole = particle_.horizon();
    const BoundaryState start = particle_.initial_state();
    const Phase first{start.q, legendre_.momentum(start.q, start.v, 0.0)};
    const double time = root_near(0.65 * whole, [&](double t) { return height(fly(first, t, steps)); });
    const Phase before = fly(first, time, steps);
    const StepEnergy last = last_;
    const Eigen::VectorXd normal = OutputBlocks<double>(ground_, numbers(before.q)).take(3).bottomRows(2);
    const auto after = [&](double impulse) { return Phase{before.q, before.p + impulse * normal}; };
    const auto imbalance_of_momenta = [&](double impulse) {
      return normal.dot(velocity(after(impulse)) + velocity(before));
    };
    double impulse = root_near(2.0 * before.p.norm(), imbalance_of_momenta);
    if (condition != ImpactCondition::momenta) {
      const double share = condition == ImpactCondition::steps ? 0.0 : 1.0;
      impulse = root_near(impulse, [&](double candidate) {
        static_cast<void>(fly(after(candidate), whole - time, steps, 1));
        return last_.energy - share * last_.half_work - last.energy - share * last.half_work;
      });
    }
    const Phase up = after(impulse);
    return {fly(up, whole - time, steps), energy(up) - energy(before)};
  }

  /// The largest entry of the difference in q and v.
  double distance(const Phase& a, const Phase& b) {
    return std::max((a.q - b.q).cwiseAbs().maxCoeff(), (velocity(a) - velocity(b)).cwiseAbs().maxCoeff());
  }

 private:
  static std::vector<double> numbers(const Eigen::VectorXd& q) { return {q.begin(), q.end()}; }
  double height(const Phase& x) const { return OutputBlocks<double>(ground_, numbers(x.q)).take(1)(0, 0); }
  Eigen::VectorXd velocity(const Phase& x) { return legendre_.velocity(x.q, x.p, 0.0, x.p); }
  double energy(const Phase& x) { return energy_.energy(x.q, velocity(x), 0.0); }

  /// The phase after a time, by `steps` equal steps of which the first `taken` are taken; 0 steps: the exact one.
  Phase fly(Phase x, double time, int steps, int taken = std::numeric_limits<int>::max()) {
    throw_if_interrupted();
    Eigen::VectorXd v = velocity(x);
    if (steps == 0) {
      const ExactInterval flight = exact_.along(x.q.cast<long double>(), v.cast<long double>(), time);
      return {flight.q_1.cast<double>(), flight.objects.right_momentum.cast<double>()};
    }
    const double h = time / steps;
    for (int k = 0; k < std::min(steps, taken); ++k) {
      const auto step = map_.advance(x.q, x.p, v, no_control_, h, 0.0);
      x = {step.q, step.p};
      v = step.mean_velocity;
      if (k + 1 < std::min(steps, taken)) continue;
      OutputBlocks<double> energies(step_energy_, step.inputs);
      last_ = {energies.take(1)(0, 0), energies.take(1)(0, 0)};
    }
    return x;
  }

  const BouncingParticle& particle_;
  TracedProblem traced_;
  OneStepMap<double> map_;
  ExactDiscreteLagrangian exact_;
  LegendreTransform legendre_;
  Energy energy_;
  Schedule ground_;       // its height, then the gradient G
  Schedule step_energy_;  // of the map's inputs
  Eigen::MatrixXd no_control_;
  StepEnergy last_;  // of the step that was taken last
};

/// What an impact is told apart by in both tables.
struct ImpactKey {
  Scheme scheme;
  const char* force = "";
  const char* condition = "";
};

struct Impact {
  ImpactKey key;
  int steps = 0;
  double state_error = 0.0;
  double energy_change = 0.0;
};

struct ImpactOrder {
  ImpactKey key;
  const char* quantity = "";
  FittedOrder fit;
};

const Columns<ImpactKey> impact_key_columns =
    scheme_columns<ImpactKey>() +
    Columns<ImpactKey>{{"force", "", "force: none, or a drag", &ImpactKey::force, in_key},
                       {"condition", "",
                        "condition on the impulse: momenta (G(v+ + v-) = 0), steps (equal E_d of both steps next to "
                        "the impact), or steps_and_work (the same with half of the work of their forces)",
                        &ImpactKey::condition, in_key}};

const Columns<Impact> impact_columns =
    columns_through<Impact>(&Impact::key, impact_key_columns) +
    Columns<Impact>{
        {"steps", "", "number of steps before the impact, and after it", &Impact::steps, in_key},
        {"state_error", "", "largest difference of q and v from the exact values at the end", &Impact::state_error},
        {"energy_change", "", "|E(q, p+) - E(q, p-)|", &Impact::energy_change}};

const Columns<ImpactOrder> impact_order_columns =
    columns_through<ImpactOrder>(&ImpactOrder::key, impact_key_columns) +
    Columns<ImpactOrder>{{"quantity", "", "quantity: state_error or energy_change", &ImpactOrder::quantity, in_key}} +
    fitted_order_columns(&ImpactOrder::fit);

}  // namespace

ImpactTables impact_tables(const std::vector<int>& steps) {
  constexpr double rounding = 1e-11;
  constexpr double drag = 0.2;
  std::vector<Impact> impacts;
  std::vector<ImpactOrder> orders;
  for (const double c : {0.0, drag}) {
    const BouncingParticle particle(c);
    for (const int stages : {1, 2}) {
      Bounce bounce(particle, gauss_tableau(stages));
      const Phase exact = bounce(ImpactCondition::momenta, 0).first;
      for (const ImpactCondition condition : impact_conditions) {
        const ImpactKey key{{particle.name(), "dmoc", "gauss", stages}, c > 0.0 ? "drag" : "none", name_of(condition)};
        std::vector<GridError> state;
        std::vector<GridError> energy;
        for (const int count : steps) {
          const auto [end, change] = bounce(condition, count);
          impacts.push_back({key, count, bounce.distance(end, exact), std::abs(change)});
          state.push_back({1.0 / count, impacts.back().state_error});
          energy.push_back({1.0 / count, impacts.back().energy_change});
        }
        if (const auto fit = asymptotic_order(state, rounding)) orders.push_back({key, "state_error", *fit});
        if (const auto fit = asymptotic_order(energy, rounding)) orders.push_back({key, "energy_change", *fit});
      }
    }
  }
  return {table_of(impact_columns, impacts), table_of(impact_order_columns, orders)};
}

}  // namespace dmocbench
