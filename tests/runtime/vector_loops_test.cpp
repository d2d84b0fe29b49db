#include "methods/runtime/vector_loops.hpp"

#include <limits>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "methods/runtime/long_vectors.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench {
namespace {

/// Sizes with and without a rest behind the last eight numbers.
constexpr Eigen::Index most_numbers = 40;
constexpr double rounding = 1e-14;

TEST(VectorLoops, AreThoseOfTheDefinitionsOnEveryInstructionSet) {
  tests::RandomPoints random;
  for (const InstructionSet set : available_instruction_sets()) {
    const VectorLoops* loops = &vector_loops_of(set);
    for (Eigen::Index size = 0; size <= most_numbers; ++size) {
      const Eigen::VectorXd x = random.vector(size);
      const Eigen::VectorXd y = random.vector(size);
      const double factor = random.number();
      EXPECT_EQ(loops->largest(x.data(), size), size > 0 ? x.cwiseAbs().maxCoeff() : 0.0);
      EXPECT_NEAR(loops->sum_of_magnitudes(x.data(), size), x.cwiseAbs().sum(), rounding);
      EXPECT_NEAR(loops->dot(x.data(), y.data(), size), x.cwiseProduct(y).sum(), rounding);
      EXPECT_EQ(loops->sum_of_zeros(x.data(), size), 0.0);
      Eigen::VectorXd sum = random.vector(size + 1);  // the last number is not to be touched
      Eigen::VectorXd wanted = sum;
      wanted.head(size) += x.cwiseProduct(y);
      loops->add_products(sum.data(), x.data(), y.data(), size);
      EXPECT_LE((sum - wanted).lpNorm<Eigen::Infinity>(), rounding);
      wanted.head(size) = x + factor * y;
      loops->set_to_sum(sum.data(), x.data(), factor, y.data(), size);
      EXPECT_LE((sum - wanted).lpNorm<Eigen::Infinity>(), rounding);
      wanted.head(size) += factor * y;
      loops->set_to_sum(sum.data(), sum.data(), factor, y.data(), size);
      EXPECT_LE((sum - wanted).lpNorm<Eigen::Infinity>(), rounding);
    }
  }
}

TEST(VectorLoops, FindWhatIsNotANumberWhereverItStands) {
  tests::RandomPoints random;
  for (const InstructionSet set : available_instruction_sets()) {
    const VectorLoops* loops = &vector_loops_of(set);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      for (Eigen::Index at = 0; at < most_numbers; ++at) {
        Eigen::VectorXd x = random.vector(most_numbers - 3);
        if (at < x.size()) x[at] = bad;
        EXPECT_EQ(loops->sum_of_zeros(x.data(), x.size()) == 0.0, at >= x.size());
      }
    }
  }
}

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
