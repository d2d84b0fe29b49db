#include "bench/tables/agreement_of_routes.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace dmocbench {
namespace {

ReferenceOptimum stated(double objective, int digits) {
  return {.objective = objective, .digits = digits, .certificate = {}, .published = {}, .remark = {}};
}

TEST(AgreeingDigits, AreCountedByTheRelativeDifference) {
  EXPECT_EQ(agreeing_digits(1.0, 1.0 + 3e-7), 6);
  EXPECT_EQ(agreeing_digits(-2000.0, -2000.0 * (1.0 + 3e-7)), 6);
  EXPECT_EQ(agreeing_digits(5.0, 5.0), 16);
  EXPECT_EQ(agreeing_digits(0.0, 0.0), 16);
  EXPECT_EQ(agreeing_digits(1.0, -1.0), 0);
  EXPECT_EQ(agreeing_digits(1.0, std::numeric_limits<double>::infinity()), 0);
}

TEST(AgreementOfRoutes, IsThatOfTheTwoThatDifferMost) {
  const RouteAgreement agreement = agreement_of_routes({6.0, 6.0 + 6e-10, 6.0 - 6e-6}, std::nullopt);
  EXPECT_EQ(agreement.routes, 3U);
  EXPECT_EQ(agreement.digits, 5);
  EXPECT_EQ(agreement.confirmed, "");
}

TEST(AgreementOfRoutes, ConfirmsAReferenceAsFarAsItGoes) {
  const std::vector<double> routes{6.0 + 1e-10, 6.0 - 1e-10};
  EXPECT_EQ(agreement_of_routes(routes, stated(6.0, 8)).confirmed, "yes");
  EXPECT_EQ(agreement_of_routes(routes, stated(6.0, 16)).confirmed, "to 10 digits");
  EXPECT_EQ(agreement_of_routes(routes, stated(6.1, 8), 12).confirmed, "no");
  EXPECT_EQ(agreement_of_routes({6.0}, stated(6.0, 8)).confirmed, "");  // one route certifies nothing
  EXPECT_EQ(agreement_of_routes({}, stated(6.0, 8)).confirmed, "");
}

TEST(AgreementOfRoutes, ConfirmsNoMoreThanIsKeptFromGridToGrid) {
  const std::vector<double> routes{6.0 + 1e-5, 6.0 + 1e-5};  // both impose a bound at the same points
  EXPECT_EQ(agreement_of_routes(routes, stated(6.0, 16)).confirmed, "undecided: one grid is not enough");
  EXPECT_EQ(agreement_of_routes(routes, stated(6.0, 16), 5).confirmed, "to 5 digits");
  EXPECT_EQ(agreement_of_routes(routes, stated(6.1, 16), 5).confirmed, "no");
  EXPECT_EQ(agreement_of_routes(routes, stated(6.0, 16), 9).confirmed, "no");
}

}  // namespace
}  // namespace dmocbench
