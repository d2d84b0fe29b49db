#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "bench/structure_advantage/node_order.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/kkt_system.hpp"

namespace dmocbench::interior_point {

/// The KKT system of a program with an interval structure as a general band matrix, by LAPACK's LU factorisation with
/// partial pivoting (dgbtrf). It exchanges rows across intervals, which the elimination by intervals cannot do, and
/// gives up the symmetry for that. Rows that couple both ends are a border, eliminated by its Schur complement; where
/// the band without them is singular, the status is `untrusted`.
///
/// LU factors do not tell the inertia. Instead the status is that of an inertia-free test of the curvature (Chiang and
/// Zavala, Computational Optimization and Applications 64, 2016, the test for tangential steps): the step t for the
/// gradient alone, along which the equalities do not change, must have
///
///   tᵀ (H + diag(d)) t + Σ (∇a_i · t)² / e_i >= 1e-12 |t|²,  the sum over rows that are no equalities.
///
/// It takes one more right-hand side. A Hessian that is indefinite in other directions only passes: the step is then no
/// minimum of the quadratic program, but the line search can still make progress along it.
class BandedKkt final : public KktSystem {
 public:
  /// Throws `Error` for a program without interval structure.
  explicit BandedKkt(const NonlinearProgram& program);

  [[nodiscard]] FactorisationStatus solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                          const KktStep& step) override;

  [[nodiscard]] const NodeOrder& order() const noexcept { return order_; }
  /// Multiplications that the last factorisation of the band took, each with a subtraction, and its divisions: known
  /// from the rows that were exchanged, since the method skips no zeros inside the band.
  [[nodiscard]] double factorisation_operations() const;

 private:
  /// Where an entry of the program's matrices goes.
  struct Target {
    std::size_t entry;
    double* at;
    double* mirror;  ///< by symmetry; null on the diagonal
  };

  /// An entry of a row that says that two copies of an unknown are equal.
  struct Tie {
    double* at;
    double value;
  };

  void find_targets();
  [[nodiscard]] double* band_entry(std::size_t row, std::size_t column);
  [[nodiscard]] double* place_of(std::size_t first, std::size_t second);
  [[nodiscard]] Target target_of(std::size_t entry, std::size_t row, std::size_t column);
  void assemble(const KktMatrix& matrix);
  [[nodiscard]] bool factorise();
  [[nodiscard]] bool substitute();
  void write_right_hand_sides(const Eigen::VectorXd& slope, const Eigen::VectorXd& rows);
  void read_step(Eigen::Index side, Eigen::VectorXd& primal_step, Eigen::VectorXd& multiplier_step) const;
  void multiply(const KktMatrix& matrix, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers);
  [[nodiscard]] bool curves_upwards(const KktMatrix& matrix);
  [[nodiscard]] bool is_solution(const KktMatrix& matrix, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                                 const Eigen::VectorXd& primal_step, const Eigen::VectorXd& multiplier_step);

  const NonlinearProgram& program_;
  NodeOrder order_;
  SparsityPattern hessian_pattern_;
  SparsityPattern jacobian_pattern_;
  std::vector<bool> is_free_;
  std::size_t leading_;  // of the band in LAPACK's storage: 2 kl + ku + 1
  std::vector<double> band_;
  std::vector<int> exchanged_;    // rows, as LAPACK tells them
  Eigen::MatrixXd border_;        // band_size x border_size
  Eigen::MatrixXd corner_;        // border_size x border_size
  Eigen::MatrixXd sides_;         // band_size x (step, tangential step, border)
  Eigen::MatrixXd corner_sides_;  // border_size x (step, tangential step)
  std::vector<Target> hessian_;
  std::vector<Target> jacobian_;
  std::vector<Tie> ties_;
  std::vector<double*> diagonal_;  // of all lines
  Eigen::VectorXd tangential_;
  Eigen::VectorXd tangential_multipliers_;
  // What `multiply` gives.
  Eigen::VectorXd unknown_products_;
  Eigen::VectorXd row_products_;
};

}  // namespace dmocbench::interior_point
