#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace dmocbench::interior_point {

/// The symmetric matrix of a Newton step, in the orders of a `NonlinearProgram`,
///
///   ( H + diag(d)     Jᵀ    )
///   (     J        -diag(e) ),
///
/// with H the Hessian of the Lagrangian and J the Jacobian of the rows. d is what bounds and regularisation add, e what
/// the slack of an inequality leaves of it: 0 for an equality, which is a row that must be met.
struct KktMatrix {
  const Eigen::VectorXd& hessian;   ///< one value per entry of hessian_structure()
  const Eigen::VectorXd& jacobian;  ///< one value per entry of jacobian_structure()
  const Eigen::VectorXd& diagonal;  ///< d, one per variable
  /// e >= 0, one per row, zero for exactly the equalities; empty if there is nothing else.
  const Eigen::VectorXd& compliance;

  [[nodiscard]] double compliance_of(Eigen::Index row) const { return compliance.size() > 0 ? compliance[row] : 0.0; }
};

/// What a factorisation found.
enum class FactorisationStatus : std::uint8_t {
  solved,         ///< H + diag(d) is positive definite where the equalities hold, and the step is there
  wrong_inertia,  ///< it is not
  singular,       ///< the rows depend on each other, or a number is not finite
  untrusted,      ///< the elimination met so small a pivot that its result says nothing
};

/// A way to solve
///
///   (H + diag(d)) δx + Jᵀ δλ = -slope,   J δx - diag(e) δλ = -rows,
///
/// and to tell whether the solution is a minimum along the equalities. Fixed variables do not move: δx = 0.
class KktSystem {
 public:
  virtual ~KktSystem() = default;
  KktSystem(const KktSystem&) = delete;
  KktSystem& operator=(const KktSystem&) = delete;
  KktSystem(KktSystem&&) = delete;
  KktSystem& operator=(KktSystem&&) = delete;

  /// `slope` and `primal_step`: variable_count() entries; `rows` and `multiplier_step`: constraint_count() entries. The
  /// steps are written if the verdict is `solved`.
  [[nodiscard]] virtual FactorisationStatus solve(const KktMatrix& matrix, const Eigen::VectorXd& slope,
                                                  const Eigen::VectorXd& rows, Eigen::VectorXd& primal_step,
                                                  Eigen::VectorXd& multiplier_step) = 0;

 protected:
  KktSystem() = default;
};

}  // namespace dmocbench::interior_point
