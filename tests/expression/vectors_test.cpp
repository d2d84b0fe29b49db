#include "methods/expression/vectors.hpp"

#include <gtest/gtest.h>

#include "methods/expression/replay.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

/// Inputs 0 .. 8 as a matrix, 9 .. 11 as a vector, and numbers for all of them.
class TracedVectors : public testing::Test {
 protected:
  /// What formulas come to, column by column.
  [[nodiscard]] Eigen::VectorXd values_of(const ExpressionMatrix& formulas) const {
    const std::vector<double> found =
        replay<double>(Schedule(std::span(formulas.data(), static_cast<std::size_t>(formulas.size()))),
                       std::span<const double>(point_.data(), 12));
    return Eigen::Map<const Eigen::VectorXd>(found.data(), formulas.size());
  }
  void expect_equal(const ExpressionMatrix& formulas, const Eigen::MatrixXd& expected) const {
    ASSERT_EQ(formulas.rows(), expected.rows());
    ASSERT_EQ(formulas.cols(), expected.cols());
    EXPECT_LT((values_of(formulas) - expected.reshaped()).lpNorm<Eigen::Infinity>(), 1e-14);
  }

  ExpressionMatrix M = input_vector(0, 9).reshaped(3, 3);
  NamedVector<'v'> v = input_vector(9, 3);
  tests::RandomPoints random;
  Eigen::VectorXd point_ = random.vector(12);
  Eigen::MatrixXd A = point_.head(9).reshaped(3, 3);
  Eigen::VectorXd a = point_.tail(3);
  Eigen::MatrixXd B = random.vector(9).reshaped(3, 3);
};

TEST_F(TracedVectors, MeetNumbersInSumsAndScaling) {
  expect_equal(0.5 * v + v * 2 - v / 4.0, 2.25 * a);
  expect_equal(a + v, 2.0 * a);
  expect_equal(B - M, B - A);
}

TEST_F(TracedVectors, AreMultipliedWithEachOtherAndWithMatricesOfNumbers) {
  expect_equal(M * v, A * a);
  expect_equal(B * v, B * a);
  expect_equal(M * a, A * a);
  expect_equal(M * M, A * A);
  expect_equal(B * M * B.transpose(), B * A * B.transpose());
  expect_equal(M.transpose() * (2.0 * v - B * v), A.transpose() * (2.0 * a - B * a));
  expect_equal(v * v.transpose(), a * a.transpose());
}

TEST_F(TracedVectors, RowTimesColumnIsANumber) {
  const Expression kinetic = 0.5 * v.transpose() * M * v;
  expect_equal(ExpressionVector{{kinetic, v.dot(v), v.squaredNorm()}},
               Eigen::Vector3d(0.5 * a.dot(A * a), a.dot(a), a.dot(a)));
}

TEST_F(TracedVectors, AProductIntoItsOwnFactorReadsTheFactorAsItWas) {
  ExpressionVector result = v;
  result = M * result;
  expect_equal(result, A * a);
}

TEST_F(TracedVectors, FactorsThatDoNotFitAreAnErrorThatTellsTheirSizes) {
  const ExpressionVector two = input_vector(0, 2);
  tests::expect_error_naming({"a 3 x 3 matrix by a 2 x 1 matrix"}, [&] { static_cast<void>(M * two); });
}

TEST_F(TracedVectors, AMissingEntryIsAnErrorThatNamesTheVectorItsSizeAndTheLastEntry) {
  const NamedVector<'u'> none;
  NamedVector<'q'> one = input_vector(0, 1);
  EXPECT_TRUE(one[0].is_same(one(0)));
  tests::expect_error_naming({"reads v[3]", "v has 3 entries", "v[2]"}, [&] { static_cast<void>(v[3]); });
  tests::expect_error_naming({"reads q[1]", "q has 1 entry", "q[0]"}, [&] { static_cast<void>(one(1)); });
  tests::expect_error_naming({"reads q[-1]"}, [&] { one[-1] = 0.0; });
  tests::expect_error_naming({"reads u[0]", "no entries"}, [&] { static_cast<void>(none[0]); });
}

}  // namespace
}  // namespace dmocbench
