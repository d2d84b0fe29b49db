// The reference in long double against the tape and against an error that was put in.

#include "bench/experiments/derivatives/measured_derivatives.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench {
namespace {

class DerivativeError : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] Eigen::VectorXd jacobian() {
    Eigen::VectorXd values(static_cast<Eigen::Index>(program_.jacobian_structure().size()));
    program_.jacobian(x_, values);
    return values;
  }
  [[nodiscard]] Eigen::VectorXd hessian() {
    Eigen::VectorXd values(static_cast<Eigen::Index>(program_.hessian_structure().size()));
    program_.hessian(x_, factor_, multipliers_, values);
    return values;
  }

  std::unique_ptr<Problem> problem_ = make_problem("two_link_manipulator");
  Transcription program_{*problem_, *make_element(GetParam()), gauss_tableau(2), Grid::uniform(9)};
  Eigen::VectorXd x_ = sample(program_, guessed_motion(*problem_)) +
                       tests::RandomPoints(3).vector(static_cast<Eigen::Index>(program_.variable_count()), -0.2, 0.2);
  Eigen::VectorXd multipliers_ = tests::RandomPoints(4).vector(static_cast<Eigen::Index>(program_.constraint_count()));
  double factor_ = 0.7;
  DerivativeReference reference_ = reference_derivatives(program_, x_, factor_, multipliers_);
};

TEST_P(DerivativeError, OfTheTapeIsRounding) {
  EXPECT_LT(relative_error(jacobian(), reference_.jacobian), 1e-14);
  EXPECT_LT(relative_error(hessian(), reference_.hessian), 1e-14);
}

TEST_P(DerivativeError, IsTheOneThatWasPutInRelativeToTheLargestEntry) {
  constexpr double error = 1e-6;
  Eigen::VectorXd values = hessian();
  values[values.size() / 2] += error * values.lpNorm<Eigen::Infinity>();
  EXPECT_NEAR(relative_error(values, reference_.hessian), error, 1e-13);
}

TEST_P(DerivativeError, IsNotANumberWhereAnEntryIsNot) {
  Eigen::VectorXd values = jacobian();
  values[0] = std::nan("");
  EXPECT_TRUE(std::isnan(relative_error(values, reference_.jacobian)));
}

INSTANTIATE_TEST_SUITE_P(All, DerivativeError, testing::ValuesIn(paper_families()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace dmocbench
