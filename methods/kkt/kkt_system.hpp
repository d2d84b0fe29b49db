#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace dmocbench::kkt {

/// The symmetric matrix of a Newton step, in the orders of a `NonlinearProgram`,
///
///   ( H + diag(d)     Jᵀ    )
///   (     J        -diag(e) ),
///
/// with H the Hessian of the Lagrangian and J the Jacobian of the constraints. d holds the barrier's Σ and the shift of
/// the Hessian; e is the slack compliance of an inequality (the inverse of its slack's Σ) and 0 for an equality.
struct KktMatrix {
  const Eigen::VectorXd& hessian;   ///< one value per entry of hessian_structure()
  const Eigen::VectorXd& jacobian;  ///< one value per entry of jacobian_structure()
  const Eigen::VectorXd& diagonal;  ///< d, one per variable
  /// e >= 0, one per constraint, zero for exactly the equalities; empty if all are equalities.
  const Eigen::VectorXd& compliance;

  /// The compliance of a constraint: the inverse weight of an inequality, 0 for an equality.
  [[nodiscard]] double compliance_of(Eigen::Index row) const { return compliance.size() > 0 ? compliance[row] : 0.0; }
};

/// The negative of the right-hand side.
struct KktRightHandSide {
  const Eigen::VectorXd& gradient;     ///< one entry per variable
  const Eigen::VectorXd& constraints;  ///< residuals, one per constraint
};

/// The solution; its vectors are sized by the caller.
struct KktStep {
  Eigen::VectorXd& primal;       ///< δx, one entry per variable
  Eigen::VectorXd& multipliers;  ///< δλ, one per constraint
};

/// The outcome of a factorisation.
enum class FactorisationStatus : std::uint8_t {
  solved,         ///< H + diag(d) is positive definite on the null space of the equalities; the step is valid
  wrong_inertia,  ///< it is not
  singular,       ///< the constraints depend on each other, or a number is not finite
  untrusted,      ///< the elimination met so small a pivot that its result is meaningless
};

/// A way to solve
///
///   (H + diag(d)) δx + Jᵀ δλ = -gradient,   J δx - diag(e) δλ = -constraints,
///
/// and to report whether the solution is a minimum along the equalities. Fixed variables do not move: δx = 0.
class KktSystem {
 public:
  virtual ~KktSystem() = default;
  KktSystem(const KktSystem&) = delete;
  KktSystem& operator=(const KktSystem&) = delete;

  /// Call before the matrices of another solve: forgets the observations of the last one, so that solves do not depend
  /// on each other.
  virtual void begin_solve() {}

  /// The step is written if the status is `solved`; otherwise it may hold anything.
  [[nodiscard]] virtual FactorisationStatus solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                                  const KktStep& step) = 0;

  /// After `wrong_inertia`, true if rounding leaves no doubt about it. If not, the inertia may be right.
  [[nodiscard]] virtual bool is_certain() const noexcept { return false; }

 protected:
  KktSystem() = default;
};

}  // namespace dmocbench::kkt
