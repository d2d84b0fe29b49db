#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/SparseCore>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/kkt_system.hpp"
#include "methods/solvers/symmetric_factorisation.hpp"

namespace dmocbench::interior_point {

/// The KKT system of any program, by the sparse factorisation of MUMPS: what elimination by intervals is measured by,
/// and what helps it where pivots have to be exchanged across intervals.
class SparseKkt final : public KktSystem {
 public:
  enum class Order : std::uint8_t {
    found,  ///< by MUMPS, which knows nothing of intervals: fewer operations, found in five times their time
    along_the_horizon,  ///< by dissection (dissection_order.hpp), if the program tells an interval structure
  };

  enum class Inertia : std::uint8_t {
    minimum,  ///< the step must lead to a minimum along the constraints; otherwise `wrong_inertia`
    any,      ///< the step is wanted whatever the point is that it leads to
  };

  explicit SparseKkt(const NonlinearProgram& program, Order order = Order::found, Inertia inertia = Inertia::minimum);

  [[nodiscard]] FactorisationStatus solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                          const KktStep& step) override;

  /// Of the last factorisation, each with an addition, as MUMPS counts them.
  [[nodiscard]] double factorisation_operations() const { return 0.5 * factorisation_.floating_point_operations(); }

 private:
  [[nodiscard]] Eigen::SparseMatrix<double> lower_triangle(const KktMatrix& matrix) const;

  const NonlinearProgram& program_;
  Inertia inertia_;
  std::vector<bool> is_free_;
  SymmetricFactorisation factorisation_;
};

}  // namespace dmocbench::interior_point
