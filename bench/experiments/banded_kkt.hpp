#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/kkt/kkt_system.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::kkt {

/// A symmetric order of the KKT matrix of a program with an interval structure in which all but a few dense lines lie
/// in a narrow band: rows and unknowns of node 0, unknowns and rows of interval 0, rows and unknowns of node 1, ...
/// Lines of the KKT matrix are numbered unknowns first, then rows.
///
/// An unknown of the whole horizon (T) would be a dense line, and the band without it singular where time is minimal.
/// So every interval has a copy of it, and further rows, the ties, say that neighbouring copies are equal.
struct NodeOrder {
  /// Where a line goes: to position `at` of the band, or of the border.
  struct Line {
    bool in_border = false;
    std::size_t at = 0;
  };
  /// Positions in the band.
  struct Copies {
    std::size_t unknown = 0;
    std::vector<std::size_t> of_intervals;
    std::vector<std::size_t> ties;  ///< tie k: copy k + 1 - copy k = 0
  };

  /// Where `line` stands in an entry of the matrix that it has with the line `other`.
  [[nodiscard]] Line place(std::size_t line, std::size_t other) const;

  std::vector<Line> lines;             ///< variable_count() + constraint_count(); copied ones by their first copies
  std::vector<Copies> copies;          ///< one per unknown of the whole horizon
  std::vector<std::size_t> intervals;  ///< the interval that a line belongs to, or begins
  std::size_t band_size = 0;           ///< lines of the band, copies and ties included
  std::size_t border_size = 0;         ///< lines of the border: rows that couple both ends
  std::size_t half_bandwidth = 0;      ///< largest distance of an entry of the band from the diagonal
};

/// Bandwidth and border are found from the program's patterns. Throws `Error` if the program has no interval structure.
[[nodiscard]] NodeOrder node_order(const NonlinearProgram& program);

/// The KKT system of a program with an interval structure as a general band matrix, by LAPACK's LU factorisation with
/// partial pivoting (dgbtrf). It exchanges rows across intervals, which the elimination by intervals cannot do, and
/// gives up the symmetry for that. Rows that couple both ends are a border, eliminated by its Schur complement; where
/// the band without them is singular, the status is `untrusted`.
///
/// LU factors do not tell the inertia. Instead the status is that of an inertia-free test of the curvature (Chiang and
/// Zavala, Computational Optimization and Applications 64, 2016, the test for tangential steps): the step t for the
/// gradient alone, along which the equalities do not change, must have
///
///   tᵀ (H + diag(d)) t + Σ (∇a_i · t)² / e_i >= 1e-12 |t|²,  the sum over the inequalities.
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
  /// An entry of the program's matrices: where its value stands, between which lines, and where it goes.
  struct Entry {
    bool in_jacobian;
    Eigen::Index number;
    Eigen::Index line;
    Eigen::Index other;
    double* at;
    double* mirror;  ///< by symmetry; null on the diagonal, and in the border

    [[nodiscard]] double value(const KktMatrix& matrix) const {
      return (in_jacobian ? matrix.jacobian : matrix.hessian)[number];
    }
  };
  /// An entry of a row that says that two copies of an unknown are equal.
  struct Tie {
    double* at;
    double value;
  };

  void find_entries(const NonlinearProgram& program);
  [[nodiscard]] double* band_entry(std::size_t row, std::size_t column);
  [[nodiscard]] double* place_of(std::size_t first, std::size_t second);
  void assemble(const KktMatrix& matrix);
  [[nodiscard]] bool substitute();
  [[nodiscard]] double& side_of(std::size_t line, Eigen::Index side);
  [[nodiscard]] Eigen::VectorXd solution_of(Eigen::Index side);
  [[nodiscard]] Eigen::VectorXd product(const KktMatrix& matrix, const Eigen::VectorXd& vector) const;
  [[nodiscard]] bool curves_upwards(const KktMatrix& matrix, const Eigen::VectorXd& tangential_step) const;

  NodeOrder order_;
  Eigen::Index unknowns_;
  std::vector<bool> is_free_;  // one per line
  std::size_t leading_;        // of the band in LAPACK's storage: 2 kl + ku + 1
  std::vector<double> band_;
  std::vector<int> exchanged_;    // rows, as LAPACK tells them
  Eigen::MatrixXd border_;        // band_size x border_size
  Eigen::MatrixXd corner_;        // border_size x border_size
  Eigen::MatrixXd sides_;         // band_size x (step, tangential step, border)
  Eigen::MatrixXd corner_sides_;  // border_size x (step, tangential step)
  std::vector<Entry> entries_;    // without those of fixed unknowns
  std::vector<Tie> ties_;
  std::vector<double*> diagonal_;  // of all lines
};

}  // namespace dmocbench::kkt
