#include "methods/indirect/control_from_costate.hpp"

#include <gtest/gtest.h>

#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

/// A cost that is not quadratic in the control: C = cosh u, so that u = -asinh ψ_p.
class HyperbolicCost final : public tests::SmallProblem {
 public:
  HyperbolicCost() : SmallProblem("hyperbolic_cost", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1) {}
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return cosh(x.u[0]); }
};

const Eigen::Vector2d q(1.3, 0.2);
const Eigen::Vector2d v(-0.1, 0.8);
const Eigen::Vector2d psi_p(0.7, -1.9);

TEST(ControlFromCostate, OfTheOrbitIsMinusHalfTheRadiusTimesTheCostate) {
  const ControlFromCostate control(*make_problem("orbital_transfer"));
  const Eigen::VectorXd u = control.control(q, v, psi_p, 0.0, Eigen::VectorXd::Zero(1));
  EXPECT_NEAR(u[0], -0.5 * q[0] * psi_p[1], 1e-14);
}

TEST(ControlFromCostate, OfTheTwoLinkAreTheTorquesOnEitherLink) {
  const ControlFromCostate control(*make_problem("two_link_manipulator"));
  const Eigen::VectorXd u = control.control(q, v, psi_p, 0.0, Eigen::VectorXd::Zero(2));
  EXPECT_NEAR(u[0], -psi_p[0], 1e-14);
  EXPECT_NEAR(u[1], psi_p[0] - psi_p[1], 1e-14);
}

TEST(ControlFromCostate, OfACostThatIsNotQuadraticIsFoundByNewtonsMethod) {
  const ControlFromCostate control{HyperbolicCost()};
  const auto one = [](double value) { return Eigen::VectorXd::Constant(1, value); };
  for (const double psi : {-3.0, -0.1, 0.0, 0.4, 5.0}) {
    EXPECT_NEAR(control.control(one(0.0), one(0.0), one(psi), 0.0, one(1.0))[0], -std::asinh(psi), 1e-13);
  }
}

TEST(ControlFromCostate, WrongSizesAndMissingCostatesAreRefused) {
  const ControlFromCostate control(*make_problem("orbital_transfer"));
  tests::expect_error_naming({"size"},
                             [&] { static_cast<void>(control.control(q, v, psi_p, 0.0, Eigen::VectorXd::Zero(2))); });
  tests::expect_error_naming({"costates"}, [&] { static_cast<void>(control.at_nodes(Trajectory())); });
}

}  // namespace
}  // namespace dmocbench
