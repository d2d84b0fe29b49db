#pragma once

#include <memory>
#include <string>
#include <vector>

#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// The paper's two problems, and two that have what these lack: L that depends on t, L that is not quadratic in v.
inline std::vector<std::unique_ptr<Problem>> problems() {
  std::vector<std::unique_ptr<Problem>> all;
  for (const std::string& name : paper_problem_names()) all.push_back(make_problem(name));
  all.push_back(std::make_unique<MovingFrame>());
  all.push_back(std::make_unique<RelativisticSpring>());
  return all;
}

/// A registered problem or one of those two.
inline std::unique_ptr<Problem> problem_named(const std::string& name) {
  if (name == "moving_frame") return std::make_unique<MovingFrame>();
  if (name == "relativistic_spring") return std::make_unique<RelativisticSpring>();
  return make_problem(name);
}

}  // namespace dmocbench::tests
