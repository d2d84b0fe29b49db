#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "methods/kkt/intervals/interval_entries.hpp"
#include "methods/kkt/intervals/segment_chain.hpp"
#include "methods/kkt/kkt_system.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::kkt {

/// The dense system that is left once all intervals are eliminated. Its unknowns are the states at both ends of the
/// horizon, their further unknowns, unknowns of the whole horizon, and the multipliers of boundary conditions, of rows
/// of the end nodes and of the state at the end, ν.
class BoundarySystem {
 public:
  /// The reason in a sentence if the ends have an entry that belongs to neither of them.
  using Made = tl::expected<BoundarySystem, std::string>;
  [[nodiscard]] static Made make(const NonlinearProgram& program, const IntervalEntries& entries);

  /// The value of the whole horizon, and the terms that its elimination left out.
  struct Horizon {
    const SegmentValue& value;
    const Eigen::MatrixXd& last_carry;  ///< s_N lacks `last_carry` x_N (node_sums x node, see `moves_by_increment`)
    const Eigen::VectorXd& terminal_weights;
    Eigen::Index negative;  ///< negative eigenvalues of the eliminated blocks, beyond their number at a minimum
  };
  [[nodiscard]] FactorisationStatus solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                          const Horizon& horizon);

  /// True if rounding leaves no doubt about the last system's inertia. The matrix is the program's in other
  /// coordinates, whatever the terminal weights are: other weights would find the same inertia.
  [[nodiscard]] bool is_certain() const noexcept { return is_certain_; }

  /// X at the first node, and ν.
  [[nodiscard]] const Eigen::VectorXd& state() const noexcept { return state_; }
  [[nodiscard]] const Eigen::VectorXd& multiplier() const noexcept { return multiplier_; }
  /// Writes the entries of the step that no interval writes.
  void write(const KktStep& step) const;

 private:
  /// An unknown or a row of the program that belongs to this system: its number in the program, and its place here.
  struct Binding {
    Eigen::Index number;
    Eigen::Index at;
  };
  /// An entry of the program's matrix, and where it goes; `sign` is -1 where it defines s_0.
  struct Placed {
    Source source;
    Eigen::Index entry;
    Eigen::Index row;
    Eigen::Index column;
    double sign;
  };

  explicit BoundarySystem(const IntervalEntries& entries);
  void number_lines(const IntervalEntries& entries);
  [[nodiscard]] bool place(const IntervalEntries& entries);
  void drop_what_is_fixed(const NonlinearProgram& program);
  void assemble(const KktMatrix& matrix, const KktRightHandSide& right_hand_side, const Horizon& horizon);
  [[nodiscard]] bool defines_carry(Eigen::Index row) const { return row >= carry_at_ && row < last_rows_; }

  Eigen::Index state_size_ = 0;
  Eigen::Index node_ = 0;
  Eigen::Index node_sums_ = 0;
  Eigen::Index size_ = 0;  // before fixed unknowns are left out
  // First places of blocks.
  Eigen::Index last_state_ = 0;
  Eigen::Index multiplier_at_ = 0;  // unknowns come before, multipliers from here on
  Eigen::Index carry_at_ = 0;       // rows that define s_0
  Eigen::Index last_rows_ = 0;      // rows of the last node

  std::vector<Binding> unknowns_;       // whose gradients, diagonals and steps belong here
  std::vector<Binding> last_unknowns_;  // x_N, whose gradients and diagonals belong to the last interval
  std::vector<Binding> first_rows_;     // rows of node 0, which the first interval eliminates
  std::vector<Binding> rows_;
  std::vector<Placed> placed_;
  std::vector<Eigen::Index> kept_;

  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_hand_side_;
  Eigen::MatrixXd reduced_;  // without the fixed unknowns
  Eigen::VectorXd reduced_solution_;
  SymmetricWork work_;
  bool is_certain_ = false;
  Eigen::VectorXd solution_;
  Eigen::VectorXd state_;
  Eigen::VectorXd multiplier_;
};

}  // namespace dmocbench::kkt
