#include "methods/runtime/stop_scope.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace dmocbench {
namespace {

TEST(StopScope, EndsWhatAsksInsideOfIt) {
  EXPECT_NO_THROW(stop_if_requested());
  {
    const StopScope outer([] { return true; }, 0.0);
    EXPECT_THROW(stop_if_requested(), Stopped);
    const StopScope inner(nullptr, 0.0);
    EXPECT_THROW(stop_if_requested(), Stopped) << "a scope inside of it takes nothing back";
  }
  EXPECT_NO_THROW(stop_if_requested());
}

TEST(StopScope, EndsWhenItsTimeHasPassed) {
  const StopScope scope(nullptr, 1e-9);
  EXPECT_THROW(while (true) stop_if_requested(), Stopped);
}

TEST(StopScope, TellsWhatIsLeftOfItsTime) {
  EXPECT_EQ(seconds_left(), std::numeric_limits<double>::infinity());
  const StopScope limited(nullptr, 1000.0);
  EXPECT_LE(seconds_left(), 1000.0);
  EXPECT_FALSE(must_stop());
  {
    const StopScope over(nullptr, 1e-9);
    while (!must_stop()) {
    }
    EXPECT_LT(seconds_left(), 0.0);
  }
  const StopScope unlimited(nullptr, 0.0);
  EXPECT_LE(seconds_left(), 1000.0) << "the limit around it stays";
}

}  // namespace
}  // namespace dmocbench
