#pragma once

#include "tests/binaries/own_problems/double_integrator.hpp"

/// A problem without a fault, between those that have one.
struct SoundMass final : dmocbench::DoubleIntegrator {
  [[nodiscard]] std::string name() const override { return "sound_mass"; }
};
