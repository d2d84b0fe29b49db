// Lie group integrators as DMOC with one Gauss stage: on SO(3) by Lee, Leok and McClamroch in directors, on the unit
// quaternions with Cayley's map as retraction in quaternions.
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "methods/diagnostics/discrete_lagrangian.hpp"
#include "methods/mechanics/forwarding_problem.hpp"
#include "methods/mechanics/motion_constraints.hpp"
#include "problems/satellite_directors.hpp"
#include "problems/satellite_quaternion.hpp"

namespace dmocbench {
namespace {

/// A problem without its constraints g(q) = 0, which L_d does not contain.
class Unconstrained final : public ForwardingProblem {
 public:
  explicit Unconstrained(const Problem& problem) : ForwardingProblem(problem) {}
  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& /*q*/) const override { return {}; }
};

Eigen::Matrix3d hat(const Eigen::Vector3d& a) {
  return Eigen::Matrix3d{{0.0, -a[2], a[1]}, {a[2], 0.0, -a[0]}, {-a[1], a[0], 0.0}};
}

/// A rotation by Cayley's map.
Eigen::Matrix3d cayley(const Eigen::Vector3d& f) {
  return Eigen::Matrix3d::Identity() + 4.0 / (4.0 + f.squaredNorm()) * (hat(f) + 0.5 * hat(f) * hat(f));
}

/// Attitudes R_k of the free body: R_{k+1} = R_k F_k, Π_{k+1} = F_k'Π_k, where F_k J_d - J_d F_k' = h hat(Π_k) with
/// J_d = ½ tr(J) 1 - J.
std::vector<Eigen::Matrix3d> free_body(const Eigen::Vector3d& inertia, Eigen::Vector3d momentum, double h, int steps) {
  const Eigen::Matrix3d j_d = (Eigen::Vector3d::Constant(0.5 * inertia.sum()) - inertia).asDiagonal();
  std::vector<Eigen::Matrix3d> attitudes{Eigen::Matrix3d::Identity()};
  for (int k = 0; k < steps; ++k) {
    Eigen::Vector3d f = Eigen::Vector3d::Zero();
    Eigen::Matrix3d turn = cayley(f);
    for (int iteration = 0; iteration < 100; ++iteration) {  // the derivative at F = 1 is J
      const Eigen::Matrix3d rest = turn * j_d - j_d * turn.transpose() - h * hat(momentum);
      f -= Eigen::Vector3d(rest(2, 1), rest(0, 2), rest(1, 0)).cwiseQuotient(inertia);
      turn = cayley(f);
    }
    attitudes.push_back(attitudes.back() * turn);
    momentum = turn.transpose() * momentum;
  }
  return attitudes;
}

TEST(LieGroupIntegrator, SatisfiesTheDiscreteEulerLagrangeEquationsOfDirectorsToRounding) {
  const SatelliteDirectors problem;
  const Eigen::Vector3d inertia(problem.parameter("inertia_1"), problem.parameter("inertia_2"),
                                problem.parameter("inertia_3"));
  constexpr double h = 0.1;
  const Eigen::Vector3d spin(0.7, -0.4, 1.1);
  const std::vector<Eigen::Matrix3d> attitudes = free_body(inertia, inertia.cwiseProduct(spin), h, 50);
  MotionConstraints constraints{TracedProblem(problem)};
  const DiscreteLagrangian discrete(Unconstrained(problem), make_tableau("gauss", 1));
  const auto between = [&](std::size_t k) {
    const auto q = [&](std::size_t node) { return LongVector(attitudes[node].reshaped().cast<long double>()); };
    return discrete.at(q(k), q(k + 1), LongMatrix::Zero(1, 3), h, 0.0);
  };
  double least_impulse = 1.0;
  double largest_rest = 0.0;
  for (std::size_t k = 1; k + 1 < attitudes.size(); ++k) {
    // p_k⁻ - p_k⁺ = w G'λ: the rest after a fit of λ
    const Eigen::VectorXd impulse = (between(k - 1).right_momentum - between(k).left_momentum).cast<double>();
    constraints.evaluate(attitudes[k].reshaped());
    const Eigen::MatrixXd gradients = constraints.jacobian().transpose();
    const Eigen::VectorXd rest = impulse - gradients * gradients.colPivHouseholderQr().solve(impulse);
    least_impulse = std::min(least_impulse, impulse.norm());
    largest_rest = std::max(largest_rest, rest.norm());
  }
  EXPECT_GT(least_impulse, 0.01);
  EXPECT_LT(largest_rest, 1e-14);
}

/// Unit quaternions of a turn about an axis, which is given by its angle times the axis.
Eigen::Vector4d turned(const Eigen::Quaterniond& from, const Eigen::Vector3d& turn) {
  const Eigen::Quaterniond to = from * Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  return {to.w(), to.x(), to.y(), to.z()};
}

// L_d(g_0, g_1) = h l(τ⁻¹(g_0⁻¹ g_1)/h), l(ω) = ½ ωᵀJω: Cayley's map τ(hω) = (1 + a)/(1 - a), a = hω/4, of unit
// quaternions turns by 4 arctan |a| about a.
TEST(LieGroupIntegrator, WithCayleysMapOfUnitQuaternionsHasTheDiscreteLagrangianOfTheQuaternion) {
  const SatelliteQuaternion problem;
  const Eigen::Vector3d inertia(problem.parameter("inertia_1"), problem.parameter("inertia_2"),
                                problem.parameter("inertia_3"));
  constexpr double h = 0.1;
  const DiscreteLagrangian discrete(Unconstrained(problem), make_tableau("gauss", 1));
  const Eigen::Quaterniond from(Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()));
  for (const Eigen::Vector3d& turn : {Eigen::Vector3d(0.3, -0.2, 0.1), Eigen::Vector3d(-1.0, 1.5, 2.0)}) {
    const Eigen::Vector3d omega = 4.0 / h * std::tan(0.25 * turn.norm()) * turn.normalized();
    const double lagrangian = 0.5 * h * omega.dot(inertia.cwiseProduct(omega));
    const auto at = discrete.at(turned(from, Eigen::Vector3d::Zero()).cast<long double>(),
                                turned(from, turn).cast<long double>(), LongMatrix::Zero(1, 3), h, 0.0);
    EXPECT_NEAR(static_cast<double>(at.lagrangian), lagrangian, 1e-14 * lagrangian);
  }
}

}  // namespace
}  // namespace dmocbench
