#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/SparseCore>

#include "methods/kkt/kkt_system.hpp"
#include "methods/kkt/symmetric_factorisation.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::kkt {

/// An order of elimination for the KKT matrix of a program with an interval structure, by nested dissection: the node
/// in the middle of the horizon comes last, before it the nodes in the middle of either half, and so on down to some
/// intervals, which are eliminated one after the other. A line that has to wait for a better pivot then waits for a few
/// nodes only, not for the rest of the horizon.
///
/// The position of every line, unknowns first, then rows; empty if the program has no interval structure.
[[nodiscard]] std::vector<int> dissection_order(const NonlinearProgram& program);

/// The KKT system of any program, by the sparse factorisation of MUMPS: the yardstick of the elimination by
/// intervals, and its fallback where pivots have to be exchanged across intervals.
class SparseKkt final : public KktSystem {
 public:
  enum class Order : std::uint8_t {
    found,              ///< by MUMPS, without regard to intervals: fewer operations, found in five times their time
    along_the_horizon,  ///< by `dissection_order`, if the program has an interval structure
  };

  enum class Inertia : std::uint8_t {
    minimum,  ///< the step must lead to a minimum along the constraints; otherwise `wrong_inertia`
    any,      ///< the step may lead to any stationary point
  };

  explicit SparseKkt(const NonlinearProgram& program, Order order = Order::found, Inertia inertia = Inertia::minimum);

  [[nodiscard]] FactorisationStatus solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                          const KktStep& step) override;

  /// True if the matrix factorised last leads to a minimum along the constraints, whatever `Inertia` accepts.
  [[nodiscard]] bool has_minimum() const noexcept { return has_minimum_; }

 private:
  [[nodiscard]] Eigen::SparseMatrix<double> lower_triangle(const KktMatrix& matrix) const;

  const NonlinearProgram& program_;
  Inertia inertia_;
  std::vector<bool> is_free_;
  SymmetricFactorisation factorisation_;
  bool has_minimum_ = false;
};

}  // namespace dmocbench::kkt
