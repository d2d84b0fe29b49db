#pragma once

#include <functional>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "methods/program/status.hpp"

namespace dmocbench {

/// Options of every solver. Further options of our own solvers are typed: `SequentialOptions`,
/// `InteriorPointOptions`. Ipopt and NLopt take `NamedOptions`.
struct SolverOptions {
  /// Tolerance on the KKT residual of the program as solved (scaled cost).
  double tolerance = 1e-10;
  int most_iterations = 500;  ///< after which a solve has failed
  /// Wall clock; 0 for no limit. The time of the innermost `StopScope` is a limit too.
  double most_seconds = 0.0;
  /// The solver's own output goes to standard output.
  bool verbose = false;
  /// Called once per iteration; true ends the solve with status "interrupted".
  std::function<bool()> stop_requested;

  /// Throws `Error` that names the option if one is out of range.
  void validate() const;
};

/// The numbers of calls of each evaluation of the program by a solver (`NonlinearProgram`).
///
/// The meaning of `evaluations`, here and in tables with this column: the number of calls by which the solver's method
/// evaluated the program's objective, gradient, constraints, Jacobian or Hessian, each call counted as one.
/// `Solver::solve` counts them in one place for all solvers, so the numbers are comparable. A point of which a solver
/// needs the values of objective and constraints costs two, with first derivatives four. Not counted are the calls by
/// which we judge points: in `confirm`, and in the stopping test of `sqp` and `nlopt`, which is the same judgement.
struct EvaluationCounts {
  int objective = 0;    ///< of φ
  int gradient = 0;     ///< of ∇φ
  int constraints = 0;  ///< of a
  int jacobian = 0;     ///< of ∂a/∂ξ
  int hessian = 0;      ///< of the Hessian of the Lagrangian

  /// All of them together.
  [[nodiscard]] int total() const noexcept { return objective + gradient + constraints + jacobian + hessian; }
};

/// The result of a solver, whether or not it succeeded.
struct Solution {
  Status status = Status::not_run;  ///< how it ended, as `confirm` judges
  std::string message;              ///< the outcome in one sentence
  bool formula_undefined = false;  ///< a formula of the problem, or a derivative, is not a number where the solve ended
  std::string solver;              ///< the solver whose answer it is; of `auto` the one that gave it
  std::string failed_before;       ///< of `auto`: which attempts failed before this one, in a sentence; may be empty
  Eigen::VectorXd primal;          ///< ξ, variable_count() entries; empty if the solver never started
  Eigen::VectorXd multipliers;     ///< λ, constraint_count() entries; empty if there is no point to have them at
  /// The solver gave none, so they are the least-squares multipliers of its point (`least_squares_multipliers`).
  bool multipliers_are_estimated = false;
  double objective = 0.0;  ///< φ at `primal`, as the solver saw it (scaled)

  // Computed by us, from our derivatives, for every solver alike; see kkt_residual.hpp.
  std::optional<double> kkt_residual;  ///< none if the solver never started, or stopped late without multipliers
  std::optional<double> constraint_violation;  ///< none if the solver never started
  /// The distance by which a Newton step from here would move the answer (`NewtonCorrection::length`); none if not
  /// computed.
  std::optional<double> correction;
  /// The curvature of the Lagrangian along a direction that meets the linearised constraints, as a share of the largest
  /// entry of its Hessian, where there is a negative one (`NegativeCurvature::share`): the point may be a saddle.
  std::optional<double> curvature;
  /// μ that an interior-point method ended with, the start of a neighbour's; none where the program has neither bounds
  /// nor inequalities, or the solver does not report it.
  std::optional<double> barrier_parameter;

  // Counts; none where a solver does not report them.
  std::optional<int> major_iterations;  ///< iterations of the solver, where it has them
  std::optional<int> minor_iterations;  ///< of the quadratic programs; the sum of the next two
  /// Minor iterations until the quadratic programs were feasible, where the solver has them.
  std::optional<int> phase_one_minor_iterations;
  std::optional<int> phase_two_minor_iterations;  ///< minor iterations after that, where the solver has them
  std::optional<EvaluationCounts> evaluations;    ///< none if the solver made none
  std::optional<int> linear_systems;  ///< factorisations, those that were repeated with a shifted Hessian included

  double seconds = 0.0;             ///< wall clock of the solver alone, without `confirm`
  double evaluation_seconds = 0.0;  ///< the part of it spent in the evaluations that are counted
  /// The part of it spent in linear systems, without finding their structure; none where a solver does not report it.
  std::optional<double> linear_seconds;

  /// The column `evaluations` of tables.
  [[nodiscard]] std::optional<int> total_evaluations() const {
    return evaluations ? std::optional(evaluations->total()) : std::nullopt;
  }
};

}  // namespace dmocbench
