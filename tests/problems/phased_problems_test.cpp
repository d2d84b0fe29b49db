// The library's problems of several phases: reference values, orders, and what holds at their switches.
#include <cmath>
#include <map>
#include <ostream>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "methods/diagnostics/replay_error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/bouncing_ball.hpp"
#include "problems/bouncing_hopper.hpp"
#include "problems/registry.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

using tests::Answer;
using tests::Scheme;

Answer solved(const Problem& problem, const Scheme& scheme, Eigen::Index intervals) {
  return tests::confirmed(problem, scheme, intervals, guessed_motion(problem), 1e-9);
}

double unknown(const Problem& problem, const Trajectory& motion, const std::string& name) {
  const std::vector<std::size_t> unknowns = problem.unknowns();
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    if (problem.parameters()[unknowns[i]].name == name) return motion.unknowns[static_cast<Eigen::Index>(i)];
  }
  throw Error("no unknown " + name);
}

/// A problem with values that were computed without any transcription.
struct Known {
  std::string problem;
  std::map<std::string, double> settings;
  std::map<std::string, double> unknowns;
  Eigen::Index intervals = 16;  ///< the coarser of two grids

  [[nodiscard]] std::unique_ptr<Problem> make() const {
    auto made = make_problem(problem);
    for (const auto& [name, value] : settings) made->set_parameter(name, value);
    return made;
  }
};

std::ostream& operator<<(std::ostream& stream, const Known& known) { return stream << known.problem; }

class KnownPhases : public testing::TestWithParam<Known> {};

TEST_P(KnownPhases, HaveTheOrderOfTheTableauInCostAndUnknowns) {
  const auto problem = GetParam().make();
  const double optimum = tests::value_of(problem->card().reference).objective;
  for (const std::string& method : paper_families()) {
    for (const int s : {1, 2}) {
      const Scheme scheme{method, s};
      if (!tests::takes_constraints(*problem, scheme)) continue;
      SCOPED_TRACE(scheme.label());
      const Eigen::Index intervals = GetParam().intervals * (s == 1 ? 2 : 1);
      const Trajectory coarse = solved(*problem, scheme, intervals).motion;
      const Trajectory fine = solved(*problem, scheme, 2 * intervals).motion;
      const auto order = [](double of_coarse, double of_fine) { return std::log2(std::abs(of_coarse / of_fine)); };
      EXPECT_NEAR(order(coarse.cost - optimum, fine.cost - optimum), 2.0 * s, 0.1 * s) << coarse.cost - optimum;
      for (const auto& [name, value] : GetParam().unknowns) {
        EXPECT_NEAR(order(unknown(*problem, coarse, name) - value, unknown(*problem, fine, name) - value), 2.0 * s,
                    0.1 * s)
            << name << ' ' << unknown(*problem, coarse, name) - value;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Library, KnownPhases,
    testing::Values(Known{"bouncing_hopper", {}, {{"duration_down", 0.978648964134}, {"impulse", 1.0693204786}}},
                    Known{"bouncing_hopper", {{"restitution", 0.6}}, {{"duration_down", 0.905454720388}}},
                    Known{"bouncing_hopper", {{"restitution", 0.0}}, {{"duration_down", 0.847402971567}}},
                    Known{"compass_gait", {}, {{"duration_step", 0.799689358043}}},
                    Known{"two_stage_rocket", {}, {{"duration_first", 0.263049700362}}},
                    Known{"refraction", {}, {{"duration_upper", 0.51065320286368062}}, 64},
                    Known{"swing_and_release", {}, {}}),
    [](const auto& instance) { return instance.param.problem + "_" + std::to_string(instance.index); });

/// u is linear in time in each phase: one stage has order 2, two stages are exact.
TEST(BouncingBall, HasItsClosedForm) {
  for (const auto& [restitution, t, v] :
       {std::tuple(1.0, 0.65117240677679886, -4.01008151015003293), {0.7, 0.56528634841633673, -4.50789920035556841}}) {
    BouncingBall ball;
    ball.set_parameter("restitution", restitution);
    const double optimum = tests::value_of(ball.card().reference).objective;
    for (const std::string& method : paper_families()) {
      SCOPED_TRACE(method);
      const auto error = [&](Eigen::Index intervals) {
        return solved(ball, {method, 1}, intervals).motion.cost - optimum;
      };
      EXPECT_NEAR(std::log2(error(16) / error(32)), 2.0, 0.02);
      const Trajectory exact = solved(ball, {method, 2}, 4).motion;
      EXPECT_NEAR(exact.cost, optimum, 1e-13 * optimum);
      EXPECT_NEAR(unknown(ball, exact, "duration_fall"), t, 1e-11);
      EXPECT_NEAR(unknown(ball, exact, "impulse"), -(1.0 + restitution) * v, 1e-10);
      // ψ⁻ = R'ᵀψ⁺ + ν ∂γ/∂q: in the direction of p the guard says nothing.
      EXPECT_NEAR(exact.psi_p(4, 0), -restitution * exact.psi_p(0, 1), 1e-10);
    }
  }
}

TEST(PhasesOfTheLibrary, HaveEqualSolutionsByDmocAndByHamiltonianCollocation) {
  for (const std::string name : {"bouncing_ball", "bouncing_hopper", "compass_gait", "two_stage_rocket"}) {
    SCOPED_TRACE(name);
    const auto problem = make_problem(name);
    for (const int s : {1, 2}) {
      const Trajectory dmoc = solved(*problem, {"dmoc", s}, 32).motion;
      const Trajectory hamiltonian = solved(*problem, {"hamiltonian", s}, 32).motion;
      EXPECT_LT((dmoc.q - hamiltonian.q).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_LT((dmoc.stage_u - hamiltonian.stage_u).cwiseAbs().maxCoeff(), 1e-10);
      EXPECT_LT((dmoc.unknowns - hamiltonian.unknowns).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}

/// The replay of each phase begins where the one before has come to.
TEST(PhasesOfTheLibrary, AreReplayedThroughTheirSwitches) {
  const BouncingBall ball;
  EXPECT_LT(replay_error(ball, solved(ball, {"dmoc", 2}, 4).motion).norm(), 1e-10);  // its controls are linear
  for (const std::string name : {"bouncing_hopper", "compass_gait", "two_stage_rocket", "swing_and_release"}) {
    SCOPED_TRACE(name);
    const auto problem = make_problem(name);
    const auto error = [&](Eigen::Index intervals) {
      return replay_error(*problem, solved(*problem, {"dmoc", 1}, intervals).motion).norm();
    };
    EXPECT_NEAR(std::log2(error(32) / error(64)), 2.0, 0.1);
  }
  const BouncingHopper hopper;
  Trajectory pushed = solved(hopper, {"dmoc", 2}, 64).motion;
  const double before = replay_error(hopper, pushed).norm();
  pushed.stage_u.col(0).array() += 1e-3;
  const double after = replay_error(hopper, pushed).norm();
  EXPECT_LT(before, 1e-6);
  EXPECT_GT(after, 1e-4);  // a push of the first phase reaches the end of the second
  EXPECT_NEAR(replay_error(ball, solved(ball, {"dmoc", 2}, 4).motion).cost, 13.578573105569905, 1e-11);
}

/// p_φ at the end less p_φ at the start less all torque. Where the surface is round the impact does not change p_φ.
double momentum_defect(const Problem& hopper, const Trajectory& motion) {
  double torque = 0.0;
  for (Eigen::Index row = 0; row < motion.stage_times.size(); ++row) {
    const MotionPoint x = motion.stage(row);
    const double width = motion.step(row / motion.stages()) * motion.tableau.b[row % motion.stages()];
    for (Eigen::Index phase = 0; phase < 2; ++phase) {
      const double r = x.q[2 * phase];
      const double share = motion.unknowns[1 + phase] / hopper.horizon();
      torque += width * (share * r * x.u[2 * phase + 1] - 0.1 * r * r * x.v[2 * phase + 1]);
    }
  }
  const Eigen::Index last = motion.intervals();
  return motion.p(last, 3) - motion.p(0, 1) - torque;
}

TEST(BouncingHopper, BalancesItsMomentumAcrossTheImpactExceptByTangentSpaceCollocation) {
  BouncingHopper hopper;
  hopper.set_parameter("unevenness", 0.0);
  for (const int s : {1, 2}) {
    EXPECT_LT(std::abs(momentum_defect(hopper, solved(hopper, {"dmoc", s}, 32).motion)), 1e-14);
    EXPECT_LT(std::abs(momentum_defect(hopper, solved(hopper, {"hamiltonian", s}, 32).motion)), 1e-14);
    EXPECT_GT(std::abs(momentum_defect(hopper, solved(hopper, {"tangent", s}, 32).motion)), s == 1 ? 1e-6 : 1e-10);
  }
}

/// (q, p) after an impact of the hopper, as a function of (q, p) before.
ExpressionVector after_impact(const ExpressionVector& x, double restitution) {
  const ExpressionVector gradient{{1.0, 0.45 * sin(3.0 * x[1])}};
  const ExpressionVector by_mass{{gradient[0], gradient[1] / (x[0] * x[0])}};
  const Expression along = by_mass[0] * x[2] + by_mass[1] * x[3];
  const Expression impulse = -(1.0 + restitution) * along / (gradient[0] * by_mass[0] + gradient[1] * by_mass[1]);
  return ExpressionVector{{x[0], x[1], x[2] + impulse * gradient[0], x[3] + impulse * gradient[1]}};
}

/// ψ⁻ = R'ᵀψ⁺ + ν ∂γ/∂q.
TEST(BouncingHopper, HasCostatesThatJumpByTheLawOfTheImpact) {
  for (const double restitution : {1.0, 0.6, 0.0}) {
    BouncingHopper hopper;
    hopper.set_parameter("restitution", restitution);
    for (const tests::Scheme& scheme : {Scheme{"dmoc", 1}, Scheme{"hamiltonian", 1}, Scheme{"dmoc", 2}}) {
      SCOPED_TRACE(scheme.label());
      const Trajectory motion = solved(hopper, scheme, 32).motion;
      Eigen::Vector4d before;
      before << motion.q.row(32).head(2).transpose(), motion.p.row(32).head(2).transpose();
      const ExpressionVector x = input_vector(0, 4);
      const ExpressionVector law = after_impact(x, restitution);
      const std::vector<double> values =
          replay<double>(Schedule(stacked({law, ExpressionVector(jacobian(law, x).reshaped())})),
                         std::span<const double>(before.data(), 4));
      const Eigen::Map<const Eigen::Vector4d> after(values.data());
      const Eigen::Map<const Eigen::Matrix4d> derivative(values.data() + 4);
      EXPECT_LT((after.tail(2).transpose() - motion.p.row(0).tail(2)).norm(), 1e-12);
      Eigen::Vector4d psi_before, psi_after;
      psi_before << motion.psi_q.row(32).head(2).transpose(), motion.psi_p.row(32).head(2).transpose();
      psi_after << motion.psi_q.row(0).tail(2).transpose(), motion.psi_p.row(0).tail(2).transpose();
      const Eigen::Vector4d rest = psi_before - derivative.transpose() * psi_after;
      EXPECT_LT(rest.tail(2).norm(), 1e-12);
      EXPECT_NEAR(rest[1], 0.45 * std::sin(3.0 * before[1]) * rest[0], 1e-12);  // along the gradient of the guard
      EXPECT_GT(std::abs(rest[0]), 1e-3);
    }
  }
}

}  // namespace
}  // namespace dmocbench
