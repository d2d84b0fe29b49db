#pragma once

#include <Eigen/Core>

#include "methods/kkt/linearisation.hpp"
#include "methods/kkt/symmetric_factorisation.hpp"

namespace dmocbench::sqp {

/// The result of a line search.
struct LineSearchResult {
  Linearisation accepted;    ///< values only
  double step_length = 0.0;  ///< 1 for the whole step; 0 if none was accepted
};

/// The l1 merit function φ(ξ) + μ Σ violations, with the weight μ from the predicted reduction of the quadratic model:
/// weights taken from the multipliers grow too large, and the method stalls.
class Globalisation {
 public:
  explicit Globalisation(NonlinearProgram& program) : program_(program) {}

  /// Backtracks along `step` (with curvature dᵀHd) from the largest length up to 1 with |d_j| <= 2 (1 + |ξ_j|) until
  /// the merit falls enough. If the first length fails, it is tried again with a second-order correction, the
  /// shortest vector that removes the violation of the constraints to first order.
  [[nodiscard]] LineSearchResult search(const Linearisation& from, const Eigen::VectorXd& step, double curvature);

  [[nodiscard]] double weight() const noexcept { return weight_; }

 private:
  [[nodiscard]] double merit(const Linearisation& at) const;
  [[nodiscard]] Linearisation corrected(const Linearisation& from, const Linearisation& tried);

  NonlinearProgram& program_;
  SymmetricFactorisation factorisation_;
  double weight_ = 0.0;
};

}  // namespace dmocbench::sqp
