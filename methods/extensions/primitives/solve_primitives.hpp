#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "methods/extensions/primitives/primitive_library.hpp"
#include "methods/extensions/primitives/symmetry_group.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// A primitive that is wanted.
struct PrimitiveRequest {
  std::size_t first = 0;      ///< state of the library in which it begins
  std::size_t last = 0;       ///< state in which it ends, moved by `displacement`
  Displacement displacement;  ///< of its end
  int duration = 1;           ///< in time steps
  /// The motion from which it is solved; where it is none, the cubic polynomial between both states with
  /// `PrimitiveOptions::start_control`.
  Motion start = {};
};

/// Options for solving primitives.
struct PrimitiveOptions {
  /// The tolerance on the KKT residual of the scaled program.
  double tolerance = 1e-9;
  /// The most iterations of a solve.
  int most_iterations = 100;
  Eigen::VectorXd start_control;  ///< m entries; none for the problem's guess at t = 0
  /// Called between solves; true ends them.
  std::function<bool()> stop_requested = {};
};

/// Throws `Error` if the problem has no primitives: if it has other ends than fixed ones, a free horizon, a final cost
/// or boundary conditions. `program` is any transcription of it.
void require_primitives(const Transcription& program);

/// Solves primitives by DMOC with the midpoint rule and appends those that are solved to the library, in the order of
/// the requests. All of one duration are one batch (`solve_batch`): eight side by side, on all threads.
///
/// Bounds and path constraints are the problem's. Throws `Error` as `require_primitives`, if a state does not
/// exist, or a duration is less than a step.
void solve_primitives(const Problem& problem, const std::vector<PrimitiveRequest>& requests, PrimitiveLibrary& library,
                      const PrimitiveOptions& options = {});

}  // namespace dmocbench
