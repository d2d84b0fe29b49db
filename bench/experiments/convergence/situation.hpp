#pragma once

#include <memory>
#include <string>
#include <vector>

#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// A problem whose optimum is smooth or has kinks.
struct Situation {
  std::string name;
  std::string active;  ///< which bounds are active: "control", "state", "control and state", or "nothing"
  std::string end;     ///< "fixed" or "free"
  std::shared_ptr<const Problem> base;  ///< whose common start solves begin at
  std::shared_ptr<const Problem> problem;
  bool has_closed_form = false;
};

/// Examples with active bounds of every kind and without active bounds, with fixed and with free final states.
[[nodiscard]] std::vector<Situation> example_situations();

/// An unchanged problem; its active bounds are determined later from its optimum. Throws `Error` if its horizon is
/// free: errors are compared at equal times.
[[nodiscard]] Situation situation_of(const std::shared_ptr<const Problem>& problem);

/// Which bounds and path constraints are active along a motion: those that it meets to a millionth of the range of the
/// quantity. "control" if they read u alone, "state" if they read q and v alone, "control and state" if both or if a
/// path constraint reads both, otherwise "nothing". Bounds on the ends do not count.
[[nodiscard]] std::string active_bounds(const Problem& problem, const Trajectory& motion);

}  // namespace dmocbench
