#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/intervals/interval_entries.hpp"
#include "methods/solvers/interior_point/intervals/segment_chain.hpp"
#include "methods/solvers/interior_point/kkt_system.hpp"

namespace dmocbench::interior_point {

/// The dense system that is left once all intervals are eliminated: the states of both ends, their further unknowns,
/// unknowns of the whole horizon, boundary conditions, and the multiplier ν of what the horizon does between.
class EndSystem {
 public:
  /// Throws `Error` if the ends have an entry that belongs to neither of them.
  EndSystem(const NonlinearProgram& program, const IntervalEntries& entries);

  /// Solves it for a horizon with the value `horizon`, in whose last state s_N is short of `last_carry` x_N (carried x
  /// node, see `moves_by_increment`).
  [[nodiscard]] FactorisationStatus solve(const KktMatrix& matrix, const Eigen::VectorXd& slope,
                                          const Eigen::VectorXd& rows, const SegmentValue& horizon,
                                          const Eigen::MatrixXd& last_carry, const Eigen::VectorXd& terminal_weights);

  /// True if no rounding hides what the last system's inertia is. As the matrix is that of the program in other
  /// coordinates, whatever the terminal weights are, no others would find another one.
  [[nodiscard]] bool is_certain() const noexcept { return is_certain_; }

  /// X at the first node, and ν.
  [[nodiscard]] const Eigen::VectorXd& state() const noexcept { return state_; }
  [[nodiscard]] const Eigen::VectorXd& multiplier() const noexcept { return multiplier_; }
  /// Writes the entries of the steps that no interval writes.
  void write(Eigen::VectorXd& primal_step, Eigen::VectorXd& multiplier_step) const;

 private:
  /// An unknown or a row of the program that is one of this system: the program's number, and ours.
  struct Bound {
    std::size_t number;
    Eigen::Index at;
  };
  /// An entry of the program's matrix, and where it goes; `sign` is -1 where it defines s_0.
  struct Placed {
    Source source;
    std::size_t entry;
    Eigen::Index row;
    Eigen::Index column;
    double sign;
  };

  void number_unknowns(const IntervalEntries& entries);
  void number_rows(const IntervalEntries& entries);
  void place(const IntervalEntries& entries);
  void keep_what_moves(const NonlinearProgram& program);
  void assemble(const KktMatrix& matrix, const Eigen::VectorXd& slope, const Eigen::VectorXd& rows,
                const SegmentValue& horizon, const Eigen::MatrixXd& last_carry,
                const Eigen::VectorXd& terminal_weights);
  [[nodiscard]] FactorisationStatus factorise_and_solve();

  Eigen::Index state_size_ = 0;
  Eigen::Index size_ = 0;       // of all, before some are left out
  Eigen::Index first_row_ = 0;  // unknowns come before, multipliers from here on
  // Heads of blocks.
  Eigen::Index last_state_ = 0;
  Eigen::Index multiplier_at_ = 0;
  Eigen::Index carry_at_ = 0;   // rows that define s_0
  Eigen::Index last_rows_ = 0;  // rows of the last node
  int node_ = 0;
  int carried_ = 0;

  std::vector<Bound> unknowns_;       // whose slopes, diagonals and steps belong here
  std::vector<Bound> last_unknowns_;  // x_N: those belong to the last interval
  std::vector<Bound> first_rows_;     // rows of node 0, which the first interval eliminates
  std::vector<Bound> rows_;
  std::vector<Placed> placed_;
  std::vector<Eigen::Index> kept_;

  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_hand_side_;
  Eigen::MatrixXd reduced_;
  bool is_certain_ = false;
  Eigen::VectorXd solution_;
  Eigen::VectorXd state_;
  Eigen::VectorXd multiplier_;
};

}  // namespace dmocbench::interior_point
