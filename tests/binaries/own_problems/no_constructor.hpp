#pragma once

#include "methods/error.hpp"
#include "tests/binaries/own_problems/double_integrator.hpp"

/// A problem that cannot be made, so that not even its name is known.
struct NoConstructor final : dmocbench::DoubleIntegrator {
  NoConstructor() { throw dmocbench::Error("no such mass"); }
};
