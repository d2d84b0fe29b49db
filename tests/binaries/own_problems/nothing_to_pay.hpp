#pragma once

#include "tests/binaries/own_problems/double_integrator.hpp"

/// Every feasible motion is optimal, so that the matrix of a Newton step is singular.
struct NothingToPay final : dmocbench::DoubleIntegrator {
  [[nodiscard]] std::string name() const override { return "nothing_to_pay"; }
  [[nodiscard]] dmocbench::Expression running_cost(const dmocbench::ControlledState& /*x*/) const override {
    return 0.0;
  }
};
