#pragma once

#include "methods/mechanics/forwarding_problem.hpp"

namespace dmocbench {

/// A problem without its bounds on q, q̇ and u along the motion; everything else is unchanged.
class WithoutBounds final : public ForwardingProblem {
 public:
  /// The problem must outlive it.
  explicit WithoutBounds(const Problem& base) : ForwardingProblem(base) {}

  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = original().bounds();
    bounds.q = {};
    bounds.v = {};
    bounds.u = {};
    return bounds;
  }
};

}  // namespace dmocbench
