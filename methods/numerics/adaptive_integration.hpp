#pragma once

#include <functional>
#include <type_traits>
#include <vector>

namespace dmocbench {

/// The right-hand side of dx/dt = f(x, t): writes f to `rate`, which has as many entries as x.
template <class Scalar>
using Rate = std::function<void(const std::vector<Scalar>& x, std::vector<Scalar>& rate, Scalar t)>;

/// The most evaluations of f by `integrate`: about four thousand steps.
inline constexpr long most_evaluations = 50'000;

/// Integrates dx/dt = f(x, t) from time `from` to `to`, in place, by the Runge-Kutta-Fehlberg method of order 7(8).
/// Each step keeps its absolute and relative error below `tolerance`; the first step tried is `first_step`. Returns
/// false if the step size vanishes or f is evaluated more than `most_evaluations` times, as happens near a singularity.
/// Exceptions of `rate` pass through; throws `Stopped` where a `StopScope` of the thread requires it. `Scalar` is
/// double or long double.
template <class Scalar>
[[nodiscard]] bool integrate(const Rate<std::type_identity_t<Scalar>>& rate, std::vector<Scalar>& x,
                             std::type_identity_t<Scalar> from, std::type_identity_t<Scalar> to,
                             std::type_identity_t<Scalar> first_step, std::type_identity_t<Scalar> tolerance);

/// One step of that method from time 0 to 1, in place, whatever its error. Returns the error of every entry as a share
/// of the one that `integrate` accepts: it keeps a step whose entries are all at most 1.
[[nodiscard]] std::vector<double> step_once(const Rate<double>& rate, std::vector<double>& x, double tolerance);

}  // namespace dmocbench
