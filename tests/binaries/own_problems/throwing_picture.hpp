#pragma once

#include <stdexcept>

#include "tests/binaries/own_problems/double_integrator.hpp"

/// A picture that cannot be made.
struct ThrowingPicture final : dmocbench::DoubleIntegrator {
  [[nodiscard]] std::string name() const override { return "throwing_picture"; }
  [[nodiscard]] dmocbench::ProblemCard card() const override {
    dmocbench::ProblemCard card;
    card.picture = [](const dmocbench::ControlledState& /*x*/) -> dmocbench::Picture {
      throw std::out_of_range("no such link");
    };
    return card;
  }
};
