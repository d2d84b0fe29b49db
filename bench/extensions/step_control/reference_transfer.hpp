#pragma once

#include <memory>
#include <optional>
#include <string>

#include "methods/indirect/indirect_solution.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The optimal orbital transfer with many revolutions, from which solves start and against which errors are measured.
///
/// DMOC with three Gauss stages on 16 intervals per revolution solves it from the problem's guess, a spiral. The
/// indirect method continues from there, with two to eight intervals of orders 16 and 20 per revolution. Where it does
/// not certify `wanted_digits`, the reference is DMOC with four Gauss stages on 32 intervals per revolution; its digits
/// are then those that it shares with tangent-space collocation with three Gauss stages on 48.
class ReferenceTransfer {
 public:
  static constexpr double wanted_digits = 9.0;

  /// `problem` is the name of one with the parameter `revolutions`. Throws `Error` if there is no such problem, if
  /// it does not allow this number of revolutions, or if no optimum is found.
  ReferenceTransfer(const std::string& problem, int revolutions, const SolverOptions& options);

  [[nodiscard]] const std::shared_ptr<const Problem>& problem() const noexcept { return problem_; }
  /// The motion that solves start from.
  [[nodiscard]] const Motion& motion() const noexcept { return motion_; }
  /// J.
  [[nodiscard]] double cost() const { return indirect_ ? indirect_->cost() : fine_.cost; }
  /// "indirect" or "two methods".
  [[nodiscard]] std::string kind() const { return indirect_ ? "indirect" : "two methods"; }
  /// Digits of state, costate, control and cost that two indirect runs share; of cost and state that two methods share.
  [[nodiscard]] double digits() const noexcept { return digits_; }
  /// The reference as `trajectory_error` compares a trajectory with it.
  [[nodiscard]] Trajectory like(const Trajectory& trajectory) const;

 private:
  void certify(const Trajectory& anchor, int revolutions);
  void let_two_methods_agree(int revolutions, const Solver& solver);

  std::shared_ptr<const Problem> problem_;
  Motion motion_;
  std::optional<IndirectSolution> indirect_;
  Trajectory fine_;  // empty, but where the indirect method does not certify
  double digits_ = 0.0;
};

}  // namespace dmocbench
