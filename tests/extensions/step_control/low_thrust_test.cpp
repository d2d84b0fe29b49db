#include <gtest/gtest.h>

#include "bench/extensions/step_control/reference_transfer.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

TEST(ReferenceTransfer, IsTheCertifiedOptimumOfThePaperAndOfTenRevolutions) {
  for (const int revolutions : {2, 10}) {
    const ReferenceTransfer reference("orbital_transfer", revolutions, SolverOptions{});
    EXPECT_EQ(reference.kind(), "indirect");
    EXPECT_GE(reference.digits(), ReferenceTransfer::wanted_digits);
    const double optimum = tests::value_of(reference.problem()->card().reference).objective;
    EXPECT_NEAR(reference.cost() / optimum, 1.0, 1e-10);
    EXPECT_NEAR(reference.motion().horizon / reference.problem()->horizon(), 1.0, 1e-14);
  }
}

}  // namespace
}  // namespace dmocbench
