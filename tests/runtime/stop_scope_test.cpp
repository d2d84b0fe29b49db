#include "methods/runtime/stop_scope.hpp"

#include <gtest/gtest.h>

namespace dmocbench {
namespace {

TEST(StopScope, EndsWhatAsksInsideOfIt) {
  EXPECT_NO_THROW(stop_if_requested());
  {
    const StopScope outer([] { return true; }, 0.0);
    EXPECT_THROW(stop_if_requested(), Stopped);
    {
      const StopScope inner(nullptr, 0.0);
      EXPECT_NO_THROW(stop_if_requested()) << "the innermost counts, and it has no limit";
    }
    EXPECT_THROW(stop_if_requested(), Stopped);
  }
  EXPECT_NO_THROW(stop_if_requested());
}

TEST(StopScope, EndsWhenItsTimeHasPassed) {
  const StopScope scope(nullptr, 1e-9);
  EXPECT_THROW(while (true) stop_if_requested(), Stopped);
}

}  // namespace
}  // namespace dmocbench
