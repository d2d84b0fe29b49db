// Free mechanisms step by step, by DMOC's interval: what 100 000 steps leave of constraints and momenta.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "methods/diagnostics/traced_newton.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/motion_constraints.hpp"
#include "methods/transcription/elements/dmoc_element.hpp"
#include "problems/satellite_directors.hpp"
#include "problems/spherical_pendulum_cartesian.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

constexpr int many_steps = 100'000;
constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();

/// The steps (q_k, p_k⁻) ↦ (q_{k+1}, p_{k+1}⁺) of a mechanism without control, with a step of 0.01.
class FreeSteps {
 public:
  FreeSteps(const Problem& problem, const Tableau& tableau, const BoundaryState& from)
      : traced_(problem), n_(traced_.configuration_size()) {
    InputCounter counter;
    IntervalUnknowns unknowns;
    unknowns.left_q = counter.take(n_);
    const ExpressionVector p = counter.take(n_);
    const std::size_t first = counter.taken();
    const DmocElement element;
    unknowns.right_q = counter.take(n_);
    for (Eigen::Index i = 1; i < tableau.stages(); ++i) unknowns.rates_q.push_back(counter.take(n_));
    for (Eigen::Index i = 0; i < element.multipliers(tableau); ++i) {
      unknowns.multipliers.push_back(counter.take(traced_.holonomic_count()));
    }
    const auto count = static_cast<Eigen::Index>(counter.taken() - first);
    unknowns.controls.assign(static_cast<std::size_t>(tableau.stages()), ExpressionVector(traced_.control_size()));
    unknowns.h = Expression(step);
    const IntervalTrace trace = element.trace(traced_, tableau, unknowns);
    newton_ = TracedNewton<double>(stacked({trace.left_momentum - p, trace.stage_equations}), first, count);
    momentum_ = Schedule(trace.right_momentum);
    const Eigen::VectorXd p_0 = LegendreTransform(traced_).momentum(from.q, from.v, 0.0);
    numbers_.insert(numbers_.end(), from.q.begin(), from.q.end());
    numbers_.insert(numbers_.end(), p_0.begin(), p_0.end());
    numbers_.insert(numbers_.end(), from.q.begin(), from.q.end());
    for (Eigen::Index i = 1; i < tableau.stages(); ++i) numbers_.insert(numbers_.end(), from.v.begin(), from.v.end());
    numbers_.resize(counter.taken(), 0.0);
  }

  void advance() {
    newton_.solve(numbers_);
    const std::vector<double> p = replay<double>(momentum_, std::span<const double>(numbers_));
    std::copy_n(numbers_.begin() + 2 * n_, n_, numbers_.begin());
    std::ranges::copy(p, numbers_.begin() + n_);
  }
  [[nodiscard]] Eigen::VectorXd q() const { return Eigen::Map<const Eigen::VectorXd>(numbers_.data(), n_); }
  [[nodiscard]] Eigen::VectorXd p() const { return Eigen::Map<const Eigen::VectorXd>(numbers_.data() + n_, n_); }
  [[nodiscard]] const TracedProblem& traced() const { return traced_; }

 private:
  static constexpr double step = 0.01;
  TracedProblem traced_;
  Eigen::Index n_;
  TracedNewton<double> newton_;
  Schedule momentum_;
  std::vector<double> numbers_;  // q_k, p_k⁻, then the unknowns from the step before
};

class ConstrainedSteps : public testing::TestWithParam<tests::Scheme> {};

TEST_P(ConstrainedSteps, KeepTheSphereAndTheMomentumAboutTheVerticalToRounding) {
  const SphericalPendulumCartesian problem;
  FreeSteps motion(problem, GetParam().tableau(), problem.initial_state());
  MotionConstraints constraints(motion.traced());
  const auto about_vertical = [&] {
    const Eigen::VectorXd q = motion.q();
    return q[0] * motion.p()[1] - q[1] * motion.p()[0];
  };
  const double momentum = about_vertical();
  double of_g = 0.0;
  double of_momentum = 0.0;
  for (int k = 0; k < many_steps; ++k) {
    motion.advance();
    const Eigen::VectorXd q = motion.q();
    constraints.evaluate(q);
    of_g = std::max(of_g, std::abs(constraints.residual()[0]) / q.cwiseAbs2().maxCoeff());
    of_momentum = std::max(of_momentum, std::abs(about_vertical() / momentum - 1.0));
  }
  EXPECT_LT(of_g, 100.0 * machine_epsilon);
  EXPECT_LT(of_momentum, many_steps * machine_epsilon);
}

TEST_P(ConstrainedSteps, KeepTheRotationAndTheAngularMomentumOfTheSatelliteToRounding) {
  const SatelliteDirectors problem;
  const Eigen::Vector3d spin(0.3, 1.0, 0.2);  // near the middle axis, so that it tumbles
  BoundaryState from = problem.initial_state();
  for (Eigen::Index i = 0; i < 9; i += 3) {
    from.v.segment<3>(i) = spin.cross(Eigen::Vector3d(from.q.segment<3>(i)));
  }
  FreeSteps motion(problem, GetParam().tableau(), from);
  const auto angular_momentum = [&] {
    const Eigen::VectorXd q = motion.q();
    const Eigen::VectorXd p = motion.p();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < 9; i += 3) {
      sum += Eigen::Vector3d(q.segment<3>(i)).cross(Eigen::Vector3d(p.segment<3>(i)));
    }
    return sum;
  };
  const Eigen::Vector3d momentum = angular_momentum();
  double of_rotation = 0.0;
  double of_momentum = 0.0;
  double farthest = 0.0;
  for (int k = 0; k < many_steps; ++k) {
    motion.advance();
    const Eigen::Matrix3d rotation = motion.q().reshaped(3, 3);
    const Eigen::Matrix3d product = rotation.transpose() * rotation - Eigen::Matrix3d::Identity();
    of_rotation = std::max(of_rotation, product.cwiseAbs().maxCoeff());
    of_momentum = std::max(of_momentum, (angular_momentum() - momentum).norm() / momentum.norm());
    farthest = std::max(farthest, 1.0 - rotation(1, 1));
  }
  EXPECT_GT(farthest, 0.5);  // it does tumble
  EXPECT_LT(of_rotation, 100.0 * machine_epsilon);
  EXPECT_LT(of_momentum, many_steps * machine_epsilon);
}

INSTANTIATE_TEST_SUITE_P(All, ConstrainedSteps,
                         testing::Values(tests::Scheme{"dmoc", 1}, tests::Scheme{"dmoc", 3, "lobatto"}),
                         [](const auto& instance) {
                           return instance.param.family + std::to_string(instance.param.stages);
                         });

}  // namespace
}  // namespace dmocbench
