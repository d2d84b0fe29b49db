#pragma once

#include "tests/binaries/own_problems/double_integrator.hpp"

/// A description that clears the terminal.
struct RawText final : dmocbench::DoubleIntegrator {
  [[nodiscard]] std::string name() const override { return "raw_text"; }
  [[nodiscard]] dmocbench::ProblemCard card() const override {
    dmocbench::ProblemCard card;
    card.description = "\x1b[2J";
    return card;
  }
};
