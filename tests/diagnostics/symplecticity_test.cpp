#include <gtest/gtest.h>

#include "methods/diagnostics/one_step_map.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "problems/registry.hpp"

namespace dmocbench {
namespace {

double defect_of_step(const std::string& method, const Tableau& tableau) {
  const auto problem = make_problem("two_link_manipulator");
  const TracedProblem traced(*problem);
  const Eigen::VectorXd q = Eigen::Vector2d(-1.0, 0.5);
  const Eigen::VectorXd v = Eigen::Vector2d(1.0, -0.5);
  const auto element = make_element(method);
  const OneStepMap<double> map(traced, *element, tableau);
  const auto step = map.advance(q, LegendreTransform(traced).momentum(q, v, 0.0), v,
                                Eigen::MatrixXd::Zero(element->controls(tableau).stages(), 2), 0.1, 0.0);
  return symplecticity_defect(map.jacobian(step));
}

TEST(SymplecticityDefect, IsZeroForAShearAndNotForAScaling) {
  Eigen::MatrixXd shear = Eigen::MatrixXd::Identity(4, 4);
  shear.topRightCorner(2, 2) << 1.0, 2.0, 2.0, -3.0;
  EXPECT_EQ(symplecticity_defect(shear), 0.0);
  EXPECT_NEAR(symplecticity_defect(Eigen::MatrixXd(2.0 * Eigen::MatrixXd::Identity(4, 4))), 3.0, 1e-15);
}

TEST(SymplecticityDefect, IsRoundingForDmocAndHamiltonianAndNotForTangentWhereTheMassMovesWithTheConfiguration) {
  for (const int stages : {1, 2, 3}) {
    const Tableau tableau = gauss_tableau(stages);
    EXPECT_LT(defect_of_step("dmoc", tableau), 1e-13);
    EXPECT_LT(defect_of_step("hamiltonian", tableau), 1e-13);
    EXPECT_GT(defect_of_step("tangent", tableau), 1e-9);
  }
}

TEST(SymplecticityDefect, IsRoundingForGalerkinElementsWithEveryQuadrature) {
  for (const auto& [method, tableau] : {std::pair("galerkin_1_1", gauss_tableau(3)),
                                        {"galerkin_2_1", gauss_tableau(2)},
                                        {"galerkin_2_3", lobatto_tableau(3)},
                                        {"galerkin_3_2_shared", gauss_tableau(4)},
                                        {"galerkin_3_1", lobatto_tableau(4)}}) {
    EXPECT_LT(defect_of_step(method, tableau), 1e-13) << method;
  }
}

}  // namespace
}  // namespace dmocbench
