#include "bench/experiment/start_provider.hpp"

#include <gtest/gtest.h>

#include "tests/support/restated_problems.hpp"

namespace dmocbench {
namespace {

TEST(StartProvider, LooksOnceForACommonStartThatThereIsNot) {
  const tests::DoubleIntegrator base;
  const auto out_of_reach = std::make_shared<tests::Restated>(
      base, [](tests::Restated::Statement& s) { s.u = tests::all_between(1, -0.1, 0.1); });
  StartProvider source("common", SolverOptions{});
  int solves = 0;
  source.on_progress = [&](const std::string&) { ++solves; };
  for (const char* method : {"dmoc", "tangent"}) {
    const Case the_case{.problem = out_of_reach, .method = method, .tableau = "gauss", .stages = 1, .solver = "ipopt"};
    EXPECT_THROW(static_cast<void>(source.motion_for(the_case)), NoStart);
    EXPECT_EQ(solves, 9) << "three methods on three grids";
  }
}

}  // namespace
}  // namespace dmocbench
