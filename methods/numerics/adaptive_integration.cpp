#include "methods/numerics/adaptive_integration.hpp"

#include <cmath>

#include <boost/numeric/odeint.hpp>

#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

namespace {

template <class Scalar>
using Stepper =
    boost::numeric::odeint::runge_kutta_fehlberg78<std::vector<Scalar>, Scalar, std::vector<Scalar>, Scalar>;

}  // namespace

template <class Scalar>
bool integrate(const Rate<std::type_identity_t<Scalar>>& rate, std::vector<Scalar>& x,
               std::type_identity_t<Scalar> from, std::type_identity_t<Scalar> to,
               std::type_identity_t<Scalar> first_step, std::type_identity_t<Scalar> tolerance) {
  namespace odeint = boost::numeric::odeint;
  using State = std::vector<Scalar>;
  long evaluations = 0;
  const auto counted = [&](const State& at, State& rate_there, Scalar t) {
    stop_if_requested();
    if (++evaluations > most_evaluations) throw odeint::step_adjustment_error("too many evaluations");
    rate(at, rate_there, t);
  };
  try {
    odeint::integrate_adaptive(odeint::make_controlled<Stepper<Scalar>>(tolerance, tolerance), counted, x, from, to,
                               first_step);
  } catch (const odeint::odeint_error&) {
    return false;
  }
  return true;
}

template bool integrate(const Rate<double>&, std::vector<double>&, double, double, double, double);
template bool integrate(const Rate<long double>&, std::vector<long double>&, long double, long double, long double,
                        long double);

std::vector<double> step_once(const Rate<double>& rate, std::vector<double>& x, double tolerance) {
  const std::vector<double> begin = x;
  std::vector<double> rate_at_begin(x.size());
  std::vector<double> error(x.size());
  rate(begin, rate_at_begin, 0.0);
  Stepper<double>().do_step(std::cref(rate), begin, rate_at_begin, 0.0, x, 1.0, error);
  for (std::size_t i = 0; i < error.size(); ++i) {
    error[i] = std::abs(error[i]) / (tolerance * (1.0 + std::abs(begin[i]) + std::abs(rate_at_begin[i])));
  }
  return error;
}

}  // namespace dmocbench
