#pragma once

#include "tests/binaries/own_problems/double_integrator.hpp"

/// A problem whose name one of the suite has already.
struct Beam final : dmocbench::DoubleIntegrator {
  [[nodiscard]] std::string name() const override { return "beam"; }
};
