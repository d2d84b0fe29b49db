#include "methods/transcription/elements/tableau.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

constexpr double rounding = 4e-16;

class GaussTableau : public testing::TestWithParam<int> {
 protected:
  Tableau tableau_ = gauss_tableau(GetParam());
};

TEST_P(GaussTableau, IntegratesPolynomialsOfDegreeTwiceItsStagesMinusOne) {
  const int order = 2 * GetParam();
  EXPECT_EQ(tableau_.order, order);
  for (int q = 1; q <= order; ++q) {  // B(2s): Σ b_i c_i^{q-1} = 1/q
    EXPECT_NEAR(tableau_.b.dot(tableau_.c.array().pow(q - 1).matrix()), 1.0 / q, rounding) << q;
  }
  // And no further: Gauss quadrature misses degree 2s.
  const double next = tableau_.b.dot(tableau_.c.array().pow(order).matrix());
  EXPECT_GT(std::abs(next - 1.0 / (order + 1)), 1e-5);
}

TEST_P(GaussTableau, HasStageOrderS) {
  for (int q = 1; q <= GetParam(); ++q) {  // C(s): Σ_j a_ij c_j^{q-1} = c_i^q / q
    const Eigen::VectorXd left = tableau_.a * tableau_.c.array().pow(q - 1).matrix();
    const Eigen::VectorXd right = tableau_.c.array().pow(q).matrix() / q;
    EXPECT_LT((left - right).lpNorm<Eigen::Infinity>(), rounding) << q;
  }
}

TEST_P(GaussTableau, FormsASymplecticPairWithItsConjugate) {
  for (Eigen::Index i = 0; i < tableau_.stages(); ++i) {
    for (Eigen::Index j = 0; j < tableau_.stages(); ++j) {  // (eq:DMOC_RK_symp)
      EXPECT_NEAR(tableau_.b[i] * tableau_.a_conjugate(i, j) + tableau_.b[j] * tableau_.a(j, i),
                  tableau_.b[i] * tableau_.b[j], rounding);
    }
  }
}

TEST_P(GaussTableau, IsItsOwnConjugate) {
  // Gauss methods are symplectic by themselves: Ã = A.
  EXPECT_LT((tableau_.a - tableau_.a_conjugate).lpNorm<Eigen::Infinity>(), rounding);
}

TEST_P(GaussTableau, IsSymmetricInTimeWithPositiveWeights) {
  const Eigen::Index s = tableau_.stages();
  EXPECT_GT(tableau_.b.minCoeff(), 0.0);
  for (Eigen::Index i = 0; i < s; ++i) {
    EXPECT_NEAR(tableau_.b[i], tableau_.b[s - 1 - i], rounding);
    EXPECT_NEAR(tableau_.c[i] + tableau_.c[s - 1 - i], 1.0, rounding);
    if (i > 0) {
      EXPECT_GT(tableau_.c[i], tableau_.c[i - 1]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Stages, GaussTableau, testing::ValuesIn(tableau_stages("gauss")),
                         testing::PrintToStringParamName());

class LobattoTableau : public testing::TestWithParam<int> {
 protected:
  Tableau tableau_ = lobatto_tableau(GetParam());
};

TEST_P(LobattoTableau, IntegratesPolynomialsOfDegreeTwiceItsStagesMinusThree) {
  const int order = 2 * GetParam() - 2;
  EXPECT_EQ(tableau_.order, order);
  for (int q = 1; q <= order; ++q) {
    EXPECT_NEAR(tableau_.b.dot(tableau_.c.array().pow(q - 1).matrix()), 1.0 / q, rounding) << q;
  }
  EXPECT_GT(std::abs(tableau_.b.dot(tableau_.c.array().pow(order).matrix()) - 1.0 / (order + 1)), 1e-5);
}

TEST_P(LobattoTableau, HasTheEndsOfTheIntervalAmongItsStages) {
  const Eigen::Index last = tableau_.stages() - 1;
  EXPECT_EQ(tableau_.c[0], 0.0);
  EXPECT_EQ(tableau_.c[last], 1.0);
  EXPECT_LT(tableau_.a.row(0).lpNorm<Eigen::Infinity>(), rounding);                                // Q_1 = q_k
  EXPECT_LT((tableau_.a.row(last).transpose() - tableau_.b).lpNorm<Eigen::Infinity>(), rounding);  // Q_s = q_{k+1}
  EXPECT_LT(tableau_.a_conjugate.col(last).lpNorm<Eigen::Infinity>(), rounding);                   // IIIB
  EXPECT_LT((tableau_.a_conjugate.col(0).array() - tableau_.b[0]).matrix().lpNorm<Eigen::Infinity>(), rounding);
}

TEST_P(LobattoTableau, HasStageOrderSForConfigurationsAndTwoLessForMomenta) {
  const int s = GetParam();
  const auto defect = [&](const Eigen::MatrixXd& a, int q) {  // C(q)
    const Eigen::VectorXd powers = tableau_.c.array().pow(q - 1).matrix();
    return (a * powers - tableau_.c.array().pow(q).matrix() / q).lpNorm<Eigen::Infinity>();
  };
  for (int q = 1; q <= s; ++q) EXPECT_LT(defect(tableau_.a, q), rounding) << q;
  for (int q = 1; q <= s - 2; ++q) EXPECT_LT(defect(tableau_.a_conjugate, q), rounding) << q;
  EXPECT_GT(defect(tableau_.a_conjugate, s - 1), 1e-3);  // why momenta at the stages are of low order
}

TEST_P(LobattoTableau, FormsASymplecticPairWithItsConjugate) {
  EXPECT_GT(tableau_.b.minCoeff(), 0.0);
  const Eigen::MatrixXd weights = tableau_.b.asDiagonal();
  const Eigen::MatrixXd defect = weights * tableau_.a_conjugate + (weights * tableau_.a).transpose() -
                                 tableau_.b * tableau_.b.transpose();  // (eq:DMOC_RK_symp)
  EXPECT_LT(defect.cwiseAbs().maxCoeff(), rounding);
  EXPECT_GT((tableau_.a - tableau_.a_conjugate).cwiseAbs().maxCoeff(), 0.1);  // it is not symplectic by itself
}

TEST_P(LobattoTableau, SharesControlsOnlyUnderItsOtherName) {
  EXPECT_FALSE(tableau_.shares_controls);
  const Tableau shared = make_tableau("lobatto_shared", GetParam());
  EXPECT_TRUE(shared.shares_controls);
  EXPECT_EQ(shared.family, "lobatto_shared");
  EXPECT_EQ(shared.a, tableau_.a);
}

INSTANTIATE_TEST_SUITE_P(Stages, LobattoTableau, testing::ValuesIn(tableau_stages("lobatto")),
                         testing::PrintToStringParamName());

TEST(Tableau, OfTwoLobattoStagesIsTheTrapezoidalRule) {
  const Tableau lobatto = lobatto_tableau(2);
  Eigen::Matrix2d trapezoidal;
  trapezoidal << 0.0, 0.0, 0.5, 0.5;
  EXPECT_LT((lobatto.a - trapezoidal).cwiseAbs().maxCoeff(), rounding);
}

TEST(Tableau, OfOneGaussStageIsTheMidpointRuleExactly) {
  const Tableau midpoint = make_tableau("gauss", 1);
  EXPECT_EQ(midpoint.a(0, 0), 0.5);
  EXPECT_EQ(midpoint.a_conjugate(0, 0), 0.5);
  EXPECT_EQ(midpoint.b[0], 1.0);
  EXPECT_EQ(midpoint.c[0], 0.5);
}

TEST(Tableau, OfTwoGaussStagesIsTheHammerHollingsworthMethod) {
  const Tableau gauss = make_tableau("gauss", 2);
  const double root = std::sqrt(3.0) / 6.0;
  EXPECT_NEAR(gauss.c[0], 0.5 - root, rounding);
  EXPECT_NEAR(gauss.a(0, 0), 0.25, rounding);
  EXPECT_NEAR(gauss.a(0, 1), 0.25 - root, rounding);
  EXPECT_NEAR(gauss.a(1, 0), 0.25 + root, rounding);
}

TEST(Tableau, OfGivenNodesReproducesLobattoIIIAAndItsConjugateIIIB) {
  const Tableau lobatto = collocation_tableau("lobatto", {0.0L, 0.5L, 1.0L}, 4);
  Eigen::Matrix3d iiia;
  iiia << 0.0, 0.0, 0.0, 5.0, 8.0, -1.0, 4.0, 16.0, 4.0;
  Eigen::Matrix3d iiib;
  iiib << 4.0, -4.0, 0.0, 4.0, 8.0, 0.0, 4.0, 20.0, 0.0;
  EXPECT_LT((24.0 * lobatto.a - iiia).lpNorm<Eigen::Infinity>(), 1e-14);
  EXPECT_LT((24.0 * lobatto.a_conjugate - iiib).lpNorm<Eigen::Infinity>(), 1e-14);
}

TEST(Tableau, RefusesCoincidingNodesAndWeightsThatAreNotPositive) {
  EXPECT_THROW(static_cast<void>(collocation_tableau("twice", {0.5L, 0.5L}, 1)), Error);
  // ∫ of the first Lagrange polynomial of 0, 0.4 is 1 - 1/0.8 < 0.
  EXPECT_THROW(static_cast<void>(collocation_tableau("negative", {0.0L, 0.4L}, 2)), Error);
}

TEST(Tableau, RefusesUnknownFamiliesAndStagesNamingWhatThereIs) {
  for (const std::string& name : tableau_names()) {
    tests::expect_error_naming({"radau", name}, [] { static_cast<void>(make_tableau("radau", 2)); });
  }
  for (const int stages : {-1, 0, 5}) {
    tests::expect_error_naming({"1 to 4", std::to_string(stages)},
                               [&] { static_cast<void>(make_tableau("gauss", stages)); });
  }
  for (const int stages : {1, 5}) {
    tests::expect_error_naming({"2 to 4", std::to_string(stages)},
                               [&] { static_cast<void>(make_tableau("lobatto", stages)); });
  }
}

const Eigen::VectorXd nodes = (Eigen::VectorXd(4) << -0.5, 0.1, 0.4, 1.0).finished();

TEST(LagrangeBasis, IsOneAtItsOwnNodeAndZeroAtTheOthers) {
  for (Eigen::Index i = 0; i < nodes.size(); ++i) {
    EXPECT_EQ(lagrange_basis(nodes, nodes[i]), Eigen::VectorXd(Eigen::VectorXd::Unit(nodes.size(), i)));
  }
}

TEST(LagrangeBasis, ReproducesCubicPolynomials) {
  const auto cubic = [](double x) { return ((2.0 * x - 3.0) * x + 0.5) * x - 1.0; };
  for (const double tau : {-1.0, 0.0, 0.3, 0.77, 2.0}) {
    EXPECT_NEAR(nodes.unaryExpr(cubic).dot(lagrange_basis(nodes, tau)), cubic(tau), 1e-12);
  }
}

}  // namespace
}  // namespace dmocbench
