#pragma once

#include <optional>

#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// A point of an optimal motion with its costate.
struct OptimalPoint {
  MotionPoint motion;     ///< q*, q̇*, u*
  Eigen::VectorXd psi_q;  ///< ψ = ∂V/∂(q, p), the gradient of the optimal cost-to-go, n entries each
  Eigen::VectorXd psi_p;  ///< costate of p, n entries
};

/// A problem whose optimal motion has a closed form.
class ClosedForm {
 public:
  virtual ~ClosedForm() = default;
  /// The optimal motion at time 0 <= t <= T; empty if the parameters permit no motion, or one without closed form. At a
  /// jump of the costate, its value after the jump.
  [[nodiscard]] virtual std::optional<OptimalPoint> optimum(double t) const = 0;

 protected:
  ClosedForm() = default;
  ClosedForm(const ClosedForm&) = default;
  ClosedForm& operator=(const ClosedForm&) = default;
  ClosedForm(ClosedForm&&) = default;
  ClosedForm& operator=(ClosedForm&&) = default;

  /// A point of a problem with one coordinate and one control.
  [[nodiscard]] static OptimalPoint scalar_point(double q, double v, double u, double psi_q, double psi_p) {
    const auto one = [](double entry) { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, entry)); };
    return {.motion = {.q = one(q), .v = one(v), .u = one(u)}, .psi_q = one(psi_q), .psi_p = one(psi_p)};
  }
};

}  // namespace dmocbench
