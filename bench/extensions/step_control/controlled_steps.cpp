#include "bench/extensions/step_control/controlled_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "bench/extensions/step_control/kepler_ellipse.hpp"
#include "bench/run/interrupt.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/one_step_map.hpp"
#include "methods/extensions/step_control/extended_action.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

namespace {

StepRule rule_of(StepPolicy policy) {
  if (policy == StepPolicy::variational) return StepRule::variational;
  return policy == StepPolicy::from_left ? StepRule::from_left : StepRule::imposed;
}

/// One period without thrust.
Motion free_period(const KeplerEllipse& ellipse) {
  return {[&ellipse](double t) { return ellipse.free_motion(t); }, KeplerEllipse::period};
}

}  // namespace

std::string_view name_of(StepPolicy policy) {
  constexpr std::array names{"uniform", "variational", "imposed", "from_left"};
  return names.at(static_cast<std::size_t>(policy));
}

std::string_view name_of(SigmaReads sigma) {
  constexpr std::array names{"nothing", "distance", "acceleration", "thrust"};
  return names.at(static_cast<std::size_t>(sigma));
}

StepFunction step_function(SigmaReads sigma, double exponent) {
  switch (sigma) {
    case SigmaReads::distance:
      return [exponent](const ControlledState& x) { return pow(x.q.dot(x.q), 0.5 * exponent); };
    case SigmaReads::acceleration:
      return [traced = std::make_shared<TracedProblem>(KeplerEllipse(0.0))](const ControlledState& x) {
        const ExpressionVector acceleration = traced->at(x.state()).configuration_force;  // unit mass
        return pow(acceleration.dot(acceleration), -0.25);
      };
    case SigmaReads::thrust:
      return [](const ControlledState& x) {
        constexpr double reference = 0.05;
        return 1.0 / sqrt(1.0 + x.u[0] * x.u[0] / (reference * reference));
      };
    case SigmaReads::nothing:
      break;
  }
  return [](const ControlledState& /*x*/) { return Expression(1.0); };
}

ControlledSteps::ControlledSteps(double eccentricity, const StepChoice& choice, int steps_per_period, double exponent)
    : eccentricity_(eccentricity),
      stages_(choice.stages),
      steps_per_period_(steps_per_period),
      map_(KeplerEllipse(eccentricity), gauss_tableau(choice.stages), step_function(choice.sigma, exponent),
           rule_of(choice.rule)),
      pace_(
          step_times(step_function(choice.sigma, exponent), free_period(KeplerEllipse(eccentricity)), steps_per_period)
              .pace) {}

StepControlMap::From ControlledSteps::pericentre() const {
  const KeplerEllipse ellipse(eccentricity_);
  const BoundaryState start = ellipse.initial_state();
  return {.q = start.q,
          .p = start.v,  // unit mass
          .t = 0.0,
          .energy = Energy(ellipse).energy(start.q, start.v, 0.0),
          .velocity = start.v};
}

ControlledSteps::Symplecticity ControlledSteps::symplecticity() const {
  Symplecticity result;
  StepControlMap::From at = pericentre();
  for (int k = 0; k < steps_per_period_; ++k) {
    const StepControlMap::Step step = map_.advance(at, no_thrust(), pace_);
    const Eigen::MatrixXd d = map_.jacobian(step);
    result.defect = std::max(result.defect, symplecticity_defect(d));
    result.rounding = std::max(result.rounding, std::numeric_limits<double>::epsilon() * d.cwiseAbs2().maxCoeff());
    at = step.end;
  }
  return result;
}

ControlledSteps::Momentum ControlledSteps::momentum(int steps) const {
  constexpr double amplitude = 0.1;
  const auto angular = [](const StepControlMap::From& at) { return at.q[0] * at.p[1] - at.q[1] * at.p[0]; };
  Momentum result;
  StepControlMap::From at = pericentre();
  const double first = angular(at);
  for (int k = 0; k < steps; ++k) {
    throw_if_interrupted();
    const Eigen::MatrixXd thrust = Eigen::MatrixXd::NullaryExpr(stages_, 1, [&](Eigen::Index i, Eigen::Index /*j*/) {
      return amplitude * std::sin(1.0 + 7.3 * k + 2.1 * static_cast<double>(i));
    });
    const StepControlMap::Step step = map_.advance(at, thrust, pace_);
    result.work += step.torque;
    at = step.end;
    result.change = angular(at) - first;
    result.defect = std::max(result.defect, std::abs(result.change - result.work));
  }
  return result;
}

std::vector<PeriodEnergy> ControlledSteps::energy(long long periods) const {
  Energy energy{KeplerEllipse(eccentricity_)};
  StepControlMap::From at = pericentre();
  const double initial = at.energy;
  std::vector<PeriodEnergy> result;
  for (long long k = 0; k < periods; ++k) {
    throw_if_interrupted();
    PeriodEnergy period{.period = k,
                        .smallest = std::numeric_limits<double>::infinity(),
                        .mean = 0.0,
                        .largest = -std::numeric_limits<double>::infinity()};
    for (int i = 0; i < steps_per_period_; ++i) {
      at = map_.advance(at, no_thrust(), pace_).end;
      const double error = energy.energy(at.q, at.p, at.t) - initial;
      period.smallest = std::min(period.smallest, error);
      period.largest = std::max(period.largest, error);
      period.mean += error / steps_per_period_;
    }
    result.push_back(period);
  }
  return result;
}

ControlledSteps::PeriodError ControlledSteps::error_of_a_period() const {
  const KeplerEllipse ellipse(eccentricity_);
  Energy energy(ellipse);
  StepControlMap::From at = pericentre();
  const double initial = at.energy;
  PeriodError result{.state = 0.0, .energy = 0.0, .largest_step = 0.0, .smallest_step = KeplerEllipse::period};
  for (int k = 0; k < steps_per_period_; ++k) {
    const StepControlMap::Step step = map_.advance(at, no_thrust(), pace_);
    at = step.end;
    const MotionPoint exact = ellipse.free_motion(at.t);
    result.state = std::max(result.state, std::hypot((at.q - exact.q).norm(), (at.p - exact.v).norm()));
    result.energy = std::max(result.energy, std::abs(energy.energy(at.q, at.p, at.t) - initial));
    result.largest_step = std::max(result.largest_step, step.h);
    result.smallest_step = std::min(result.smallest_step, step.h);
  }
  return result;
}

}  // namespace dmocbench
