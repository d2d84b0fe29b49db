#pragma once

#include <stdexcept>

#include "tests/binaries/own_problems/double_integrator.hpp"

/// A number that cannot be told.
struct ThrowingHorizon final : dmocbench::DoubleIntegrator {
  [[nodiscard]] std::string name() const override { return "throwing_horizon"; }
  [[nodiscard]] double horizon() const override { throw std::out_of_range("no such time"); }
};
