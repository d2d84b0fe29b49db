#pragma once

#include <functional>
#include <type_traits>
#include <vector>

namespace dmocbench {

/// The right-hand side of dx/dt = f(x, t): writes f to `rate`, which has as many entries as x.
template <class Scalar>
using Rate = std::function<void(const std::vector<Scalar>& x, std::vector<Scalar>& rate, Scalar t)>;

/// Carries `x` along dx/dt = f(x, t) from time `from` to `to`, by Runge and Kutta's method of Fehlberg of order 7(8)
/// with steps that hold the absolute and the relative error of each to `tolerance`; the first is tried with
/// `first_step`. False if steps that are small enough vanish. What `rate` throws passes. `Scalar` is double or long
/// double.
template <class Scalar>
[[nodiscard]] bool integrate(const Rate<std::type_identity_t<Scalar>>& rate, std::vector<Scalar>& x,
                             std::type_identity_t<Scalar> from, std::type_identity_t<Scalar> to,
                             std::type_identity_t<Scalar> first_step, std::type_identity_t<Scalar> tolerance);

}  // namespace dmocbench
