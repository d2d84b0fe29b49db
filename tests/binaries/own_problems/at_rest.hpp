#pragma once

#include <cmath>
#include <numbers>

#include "tests/binaries/own_problems/double_integrator.hpp"

/// The best motion from a place to the same one is none; the guess moves.
struct AtRest final : dmocbench::DoubleIntegrator {
  [[nodiscard]] std::string name() const override { return "at_rest"; }
  [[nodiscard]] dmocbench::Expression running_cost(const dmocbench::ControlledState& x) const override {
    return 0.5 * x.u[0] * x.u[0] + 0.1 * (1.0 - cos(x.q[0]));  // not solved in one step
  }
  [[nodiscard]] dmocbench::BoundaryState final_state() const override { return initial_state(); }
  [[nodiscard]] dmocbench::MotionPoint guess(double t) const override {
    dmocbench::MotionPoint point = DoubleIntegrator::guess(t);
    point.q[0] += std::sin(std::numbers::pi * t);
    point.v[0] += std::numbers::pi * std::cos(std::numbers::pi * t);
    return point;
  }
};
