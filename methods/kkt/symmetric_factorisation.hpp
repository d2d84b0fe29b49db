#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace dmocbench {

/// Makes MUMPS this thread's alone until the lock that is returned ends. MUMPS has global state, and so has Ipopt,
/// which calls it: each of our calls holds this one lock of the process, and solves by `ipopt` and `sqp` hold it
/// throughout. A thread that holds it may take it again.
///
/// While another thread has it, `gives_up` is called every millisecond; once that is true, the lock is returned
/// unowned.
[[nodiscard]] std::unique_lock<std::recursive_mutex> lock_mumps(const std::function<bool()>& gives_up = {});

/// Factors L D Lᵀ of a sparse symmetric, possibly indefinite matrix, with its inertia (by MUMPS). Threads may have one
/// each: calls of MUMPS wait for each other, and for solves by `ipopt` and `sqp` (`lock_mumps`). They end with the
/// `StopScope` of their thread, while they wait and while they work. MUMPS cannot be stopped while it chooses an order
/// of elimination; it does not begin where the time left is too short for that.
class SymmetricFactorisation {
 public:
  /// Eliminates in a given order: `positions` gives for every row of the matrix when it is eliminated, from 0 on; empty
  /// to let MUMPS choose. A row whose pivot is too small is postponed; where so many are that the factors need more
  /// than five times the workspace of the pattern, MUMPS chooses.
  explicit SymmetricFactorisation(const std::vector<int>& positions = {});

  /// The largest entry of a matrix: products of larger ones would overflow.
  static constexpr double largest_entry = 1e100;

  /// Factorises the matrix whose lower triangle is given. False if it is singular, or so nearly that postponed pivots
  /// need more than about ten times the workspace of the pattern, or an entry is not finite or above
  /// `largest_entry`: MUMPS aborts where a number is infinite. The order of elimination, if none was given, is chosen
  /// at the first call and kept while the pattern stays the same. Throws `std::bad_alloc` if there is not enough
  /// memory, `Stopped`, and `Error` if MUMPS fails otherwise; the object may be used again.
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& lower);
  /// Number of negative eigenvalues of the matrix factorised last.
  [[nodiscard]] Eigen::Index negative_eigenvalues() const;
  /// The solution for a right-hand side.
  [[nodiscard]] Eigen::VectorXd solve(Eigen::VectorXd right_hand_side);

 private:
  struct Mumps;
  std::shared_ptr<Mumps> mumps_;  // a copy refers to the same factors
};

}  // namespace dmocbench
