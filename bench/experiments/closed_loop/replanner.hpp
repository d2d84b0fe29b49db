#pragma once

#include <optional>

#include <Eigen/Core>

#include "bench/run/solve_case.hpp"
#include "methods/solvers/prepared_solve.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// A controller that solves its problem again and again, each time from the measured state over the time that remains,
/// on a grid with as many intervals as ever. Every solve starts at the rest of the plan before it.
class Replanner {
 public:
  /// Makes the plan for the problem's own initial state from a motion. Throws `Error` if that is not solved. The
  /// problem of the case must outlive it.
  Replanner(const Case& the_case, const Motion& start, const SolverOptions& options);

  /// Takes the first plan again.
  void begin();
  /// Plans at time t from a state, or from the nearest one within the bounds of the motion if disturbances have moved
  /// it out of them. Without a solution the plan before stays.
  void plan(const BoundaryState& measured, double t);

  /// The plan, whose time begins when it was made.
  [[nodiscard]] const Trajectory& current() const noexcept { return plan_.trajectory; }
  /// When it was made.
  [[nodiscard]] double made_at() const noexcept { return plan_.made_at; }
  /// Plans since `begin`, the first one included, and the iterations of their solves.
  [[nodiscard]] int plans() const noexcept { return plans_; }
  [[nodiscard]] int iterations() const noexcept { return iterations_; }
  /// Solves since `begin` without a solution.
  [[nodiscard]] int failed() const noexcept { return failed_; }
  /// How many unknowns a plan has that are not fixed.
  [[nodiscard]] std::size_t free_variables() const;

 private:
  struct Plan {
    Trajectory trajectory;
    double made_at = 0.0;
    Eigen::VectorXd multipliers;
    std::optional<double> barrier_parameter;
    int iterations = 0;
  };
  /// Solves the program with the values that it has; empty without a solution.
  [[nodiscard]] std::optional<Plan> solved(const Motion& start, const Plan& before);

  const Problem& problem_;
  ProblemBounds bounds_;
  Transcription program_;
  PreparedSolve prepared_;
  Plan first_;
  Plan plan_;
  int plans_ = 1;
  int iterations_ = 0;
  int failed_ = 0;
};

}  // namespace dmocbench
