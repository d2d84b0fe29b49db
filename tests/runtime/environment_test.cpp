#include "methods/runtime/environment.hpp"

#include <gtest/gtest.h>

#include "tests/support/restored_settings.hpp"

namespace dmocbench {
namespace {

TEST(OrderByOneThread, HoldsUnlessTheEnvironmentGivesANumber) {
  const tests::EnvironmentVariable threads("SCOTCH_PTHREAD_NUMBER");
  threads.unset();
  order_by_one_thread();
  EXPECT_EQ(threads.value(), "1");
  threads.set("3");
  order_by_one_thread();
  EXPECT_EQ(threads.value(), "3");
}

}  // namespace
}  // namespace dmocbench
