#include "methods/runtime/long_vectors.hpp"

#include <gtest/gtest.h>

namespace dmocbench {
namespace {

TEST(LargePages, ChangeNothingThatAProgramCanSee) {
  // Around the sizes that are asked for, where the first and the last page are not whole.
  constexpr Eigen::Index numbers_per_large_page = 262144;
  for (const Eigen::Index pages : {0, 1, 2, 3, 7}) {
    for (const Eigen::Index more : {0, 1, 511, 1000}) {
      const Eigen::Index size = pages * numbers_per_large_page + more;
      Eigen::VectorXd vector;
      resize_unwritten(vector, size);
      ASSERT_EQ(vector.size(), size);
      vector.setLinSpaced(0.0, 1.0);
      const Eigen::VectorXd copy = vector;
      resize_unwritten(vector, size);
      EXPECT_EQ(vector, copy) << "a vector of the right size keeps its numbers";
    }
  }
}

}  // namespace
}  // namespace dmocbench
