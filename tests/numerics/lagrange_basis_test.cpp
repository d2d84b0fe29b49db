#include "methods/numerics/lagrange_basis.hpp"

#include <gtest/gtest.h>

namespace dmocbench {
namespace {

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
