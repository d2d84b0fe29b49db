#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "methods/program/status.hpp"

namespace dmocbench {

/// What a solver returns, whether or not it succeeded.
struct Solution {
  Status status = Status::not_run;
  std::string message;          ///< one sentence: what happened
  Eigen::VectorXd primal;       ///< ξ, variable_count() entries; empty if the solver never started
  Eigen::VectorXd multipliers;  ///< λ, constraint_count() entries; empty if there is no point to have them at
  /// The solver gave none, so they are the least-squares multipliers of its point (least_squares_multipliers.hpp).
  bool multipliers_are_estimated = false;
  double objective = 0.0;  ///< φ at `primal`, as the solver saw it (scaled)

  // Computed by us, from our derivatives, for every solver alike; see kkt_residual.hpp.
  std::optional<double> kkt_residual;          ///< none if the solver never started
  std::optional<double> constraint_violation;  ///< none if the solver never started

  // Counts; none where a solver does not tell them.
  std::optional<int> major_iterations;
  std::optional<int> minor_iterations;  ///< of the quadratic programs; the sum of the next two
  std::optional<int> phase_one_minor_iterations;
  std::optional<int> phase_two_minor_iterations;
  std::optional<int> evaluations;
  std::optional<int> linear_systems;  ///< factorisations, those that were repeated with a shifted Hessian included

  double seconds = 0.0;             ///< wall clock of the solver call alone
  double evaluation_seconds = 0.0;  ///< the part of it spent in the program's evaluations
  /// The part of it spent in linear systems, without finding their structure; none where a solver does not tell.
  std::optional<double> linear_seconds;
};

}  // namespace dmocbench
