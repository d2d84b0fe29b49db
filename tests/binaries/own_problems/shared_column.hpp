#pragma once

#include "tests/binaries/own_problems/double_integrator.hpp"

/// A control with the name that the velocity of x has in tables.
struct SharedColumn final : dmocbench::DoubleIntegrator {
  [[nodiscard]] std::string name() const override { return "shared_column"; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"v_x"}; }
};
