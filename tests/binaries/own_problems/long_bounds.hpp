#pragma once

#include "tests/binaries/own_problems/double_integrator.hpp"

/// Bounds for two controls where there is one.
struct LongBounds final : dmocbench::DoubleIntegrator {
  [[nodiscard]] std::string name() const override { return "long_bounds"; }
  [[nodiscard]] dmocbench::ProblemBounds bounds() const override {
    dmocbench::ProblemBounds bounds = DoubleIntegrator::bounds();
    bounds.u = dmocbench::Bounds::all(2000, -1.0, 1.0);
    return bounds;
  }
};
