#pragma once

#include <algorithm>
#include <memory>

#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// A particle of unknown mass m, moved from 0 to 2 in the time 1 with the velocity 1 at both ends: L = ½mv², f = u,
/// C = ½u², Φ = (m - 3)². For a given m, q = t + 3t² - 2t³ and J = 6m² + (m - 3)²; hence m = 3/7 and J = 54/7.
class UnknownMass final : public SmallProblem {
 public:
  explicit UnknownMass(double least = 0.1, double most = 10.0)
      : SmallProblem("unknown_mass", at(0.0, 1.0), at(2.0, 1.0), 1.0, 1,
                     {{"mass", std::clamp(1.0, least, most), "kg", "of the particle", least, most, false, true}}) {}
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * varying("mass") * x.v[0] * x.v[0]; }
  [[nodiscard]] Expression final_cost(const State&) const override {
    const Expression miss = varying("mass") - 3.0;
    return miss * miss;
  }
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector&) const override { return one(1.0); }
};

/// L = ½v², f = u_1 - u_2, C = ½|u|², from 0 to 1 at rest in T = 1. With u_1 + 3 u_2 = 0, f = -4 u_2 and C = 5/16 f²:
/// J = 5/8 · 6.
class TwoForces final : public SmallProblem {
 public:
  TwoForces() : SmallProblem("two_forces", at(0.0, 0.0), at(1.0, 0.0), 1.0, 2) {}
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return one(x.u[0] - x.u[1]); }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return one(x.u[0] + 3.0 * x.u[1]);
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.path = Bounds::all(1, 0.0, 0.0);
    return bounds;
  }
};

}  // namespace dmocbench::tests
