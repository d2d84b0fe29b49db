#include "methods/numerics/adaptive_integration.hpp"

#include <boost/numeric/odeint.hpp>

#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

template <class Scalar>
bool integrate(const Rate<std::type_identity_t<Scalar>>& rate, std::vector<Scalar>& x,
               std::type_identity_t<Scalar> from, std::type_identity_t<Scalar> to,
               std::type_identity_t<Scalar> first_step, std::type_identity_t<Scalar> tolerance) {
  namespace odeint = boost::numeric::odeint;
  using State = std::vector<Scalar>;
  using Stepper = odeint::runge_kutta_fehlberg78<State, Scalar, State, Scalar>;
  long evaluations = 0;
  const auto counted = [&](const State& at, State& rate_there, Scalar t) {
    stop_if_requested();
    if (++evaluations > most_evaluations) throw odeint::step_adjustment_error("too many evaluations");
    rate(at, rate_there, t);
  };
  try {
    odeint::integrate_adaptive(odeint::make_controlled<Stepper>(tolerance, tolerance), counted, x, from, to,
                               first_step);
  } catch (const odeint::odeint_error&) {
    return false;
  }
  return true;
}

template bool integrate(const Rate<double>&, std::vector<double>&, double, double, double, double);
template bool integrate(const Rate<long double>&, std::vector<long double>&, long double, long double, long double,
                        long double);

}  // namespace dmocbench
