// Velocity constraints A(q) q̇ = 0: degrees of freedom, orders at the nodes, equal solutions, impulses, and refusals.
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/mechanics/embedded_problem.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/motion_constraints.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "problems/chaplygin_sleigh_cartesian.hpp"
#include "problems/rolling_disk.hpp"
#include "tests/solvers/constrained_motions.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench {
namespace {

using tests::Answer;
using tests::Scheme;

Answer solved_with_constraints(const Problem& problem, const Scheme& scheme, Eigen::Index intervals,
                               const std::string& solver = "interior_point") {
  return tests::confirmed(problem, scheme, intervals, guessed_motion(problem), 1e-9, solver);
}

double optimum_of(const Problem& problem) { return tests::value_of(problem.card().reference).objective; }

class VelocityConstraintsBy : public testing::TestWithParam<Scheme> {};

TEST_P(VelocityConstraintsBy, LeaveRowsOfFullRankAndAsManyFreedomsAsQuasiVelocities) {
  // The ends have 5 freedoms and conditions on 3 of q and 2 of v each.
  tests::expect_full_rank<ChaplyginSleighCartesian>(GetParam(), {{tests::Ends::given, 5 - 10},
                                                                 {tests::Ends::free_last_velocity, 5 - 8},
                                                                 {tests::Ends::free_last, 5 - 5},
                                                                 {tests::Ends::free_first_velocity, 5 - 8}});
}

/// The sleigh in quasi-velocities, solved with order 8.
const Trajectory& reference() {
  static const Trajectory motion = solved_with_constraints(ChaplyginSleigh(), {"hamiltonian", 4}, 256).motion;
  return motion;
}

/// The errors at the nodes: q, p, the costates along motions, and the cost.
std::map<std::string, double> errors_of_reduced(const Trajectory& motion) {
  const ChaplyginSleighCartesian problem;
  const ChaplyginSleigh quasi;
  const Trajectory& exact = reference();
  const Eigen::Index stride = exact.intervals() / motion.intervals();
  LegendreTransform legendre{TracedProblem(problem)};
  LegendreTransform of_quasi{TracedProblem(quasi)};
  std::map<std::string, double> largest{{"q", 0.0}, {"p", 0.0}, {"psi", 0.0}};
  const auto raise = [&](const char* name, double error) { largest[name] = std::max(largest[name], std::abs(error)); };
  for (Eigen::Index k = 0; k <= motion.intervals(); ++k) {
    const MotionPoint at = exact.node(k * stride);
    const double theta = at.q[1];
    const Eigen::Vector3d q(at.y[0], at.y[1], theta);
    const Eigen::Vector3d along(std::cos(theta), std::sin(theta), 0.0);
    const Eigen::Vector3d across(-std::sin(theta), std::cos(theta), 0.0);
    const Eigen::Vector3d v = at.v[0] * along + at.v[1] * Eigen::Vector3d::UnitZ();
    raise("q", (motion.q.row(k).transpose() - q).norm());
    raise("p", (motion.p.row(k).transpose() - legendre.momentum(q, v, 0.0)).norm());
    // Along x, y, θ with the velocity along the blade kept, and along both velocities.
    const auto values = legendre.at(q, v, 0.0);
    const Eigen::MatrixXd quasi_mass = of_quasi.at(at.q, at.v, 0.0, at.y).mass;
    const Eigen::VectorXd psi_q = motion.psi_q.row(k).transpose();
    const Eigen::VectorXd psi_p = motion.psi_p.row(k).transpose();
    const auto found = [&](const Eigen::Vector3d& dq, const Eigen::Vector3d& dv) {
      return psi_q.dot(dq) + psi_p.dot(values.by_configuration * dq + values.mass * dv);
    };
    const Eigen::Index row = k * stride;
    for (Eigen::Index i = 0; i < 2; ++i) {
      raise("psi", found(Eigen::Vector3d::Unit(i), Eigen::Vector3d::Zero()) - exact.psi_y(row, i));
      const Eigen::Vector3d dv = i == 0 ? along : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
      raise("psi", found(Eigen::Vector3d::Zero(), dv) - exact.psi_p.row(row).dot(quasi_mass.col(i)));
    }
    raise("psi", found(Eigen::Vector3d::UnitZ(), at.v[0] * across) - exact.psi_q(row, 1));
  }
  largest["cost"] = std::abs(motion.cost - optimum_of(problem));
  return largest;
}

TEST_P(VelocityConstraintsBy, HaveTheOrderOfTheTableauAtTheNodes) {
  const ChaplyginSleighCartesian problem;
  const int order = GetParam().tableau().order;
  const Eigen::Index finest = order == 2 ? 256 : 128;
  const std::map<std::string, double> coarse =
      errors_of_reduced(solved_with_constraints(problem, GetParam(), finest / 2).motion);
  const std::map<std::string, double> fine =
      errors_of_reduced(solved_with_constraints(problem, GetParam(), finest).motion);
  for (const auto& [name, error] : fine) {
    EXPECT_NEAR(std::log2(coarse.at(name) / error), order, 0.25)
        << name << ": errors " << coarse.at(name) << ", " << error;
  }
}

TEST_P(VelocityConstraintsBy, HaveTheOrderAndOptimumOfTheRollingDisk) {
  const RollingDisk problem;
  const int order = GetParam().tableau().order;
  const double coarse = solved_with_constraints(problem, GetParam(), 64).motion.cost - optimum_of(problem);
  const double fine = solved_with_constraints(problem, GetParam(), 128).motion.cost - optimum_of(problem);
  EXPECT_NEAR(std::log2(std::abs(coarse / fine)), order, 0.25) << coarse << ", " << fine;
}

TEST_P(VelocityConstraintsBy, HoldAtTheNodesToRounding) {
  const RollingDisk problem;
  const Answer answer = solved_with_constraints(problem, GetParam(), 32);
  MotionConstraints constraints(answer.program->traced_problem());
  for (Eigen::Index k = 0; k <= 32; ++k) {
    constraints.evaluate(answer.motion.q.row(k).transpose());
    EXPECT_LT((constraints.jacobian() * answer.motion.v.row(k).transpose()).norm(), 1e-12);
  }
}

/// Momentum along a rotation is balanced by the work of the forces and the impulses of the forces of constraint, and by
/// tangent-space collocation where L_vv is constant, as on the disk.
TEST_P(VelocityConstraintsBy, LetMomentaBeTheWorkOfTheForcesWithImpulses) {
  const RollingDisk disk;
  const ChaplyginSleighCartesian sleigh;
  for (const Problem* problem : {static_cast<const Problem*>(&disk), static_cast<const Problem*>(&sleigh)}) {
    SCOPED_TRACE(problem->name());
    Trajectory motion = solved_with_constraints(*problem, GetParam(), 16).motion;
    const double defect = momentum_consistency(*problem, motion).largest;
    if (GetParam().method != "tangent") {
      EXPECT_LT(defect, 1e-12);
    } else if (problem == &sleigh) {
      EXPECT_GT(defect, 1e-9);
    }
    motion.left_impulses.setZero();
    motion.right_impulses.setZero();
    motion.stage_constraint_forces.setZero();
    EXPECT_GT(momentum_consistency(*problem, motion).largest, 1e-3);
  }
}

TEST_P(VelocityConstraintsBy, AreKeptByTheReplayOfTheControls) {
  const RollingDisk problem;
  const auto missed = [&](Eigen::Index intervals) {
    return replay_error(problem, solved_with_constraints(problem, GetParam(), intervals).motion).norm();
  };
  EXPECT_LT(missed(64), 0.5 * missed(32));
}

TEST_P(VelocityConstraintsBy, AreSolvedAlikeByIpoptAndByTheEliminationOfIntervals) {
  const ChaplyginSleighCartesian problem;
  const double by_intervals = solved_with_constraints(problem, GetParam(), 48).motion.cost;
  EXPECT_NEAR(solved_with_constraints(problem, GetParam(), 48, "ipopt").motion.cost, by_intervals, 1e-8 * by_intervals);
}

/// The sleigh with the direction (c, s) of its blade as coordinates: one constraint of either kind.
class SleighByDirection final : public Problem {
 public:
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y", "c", "s"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return sleigh_.control_names(); }
  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    return ExpressionVector{{q[2] * q[2] + q[3] * q[3] - 1.0}};
  }
  [[nodiscard]] ExpressionVector velocity_constraints(const ExpressionVector& q,
                                                      const ExpressionVector& v) const override {
    return ExpressionVector{{q[2] * v[1] - q[3] * v[0]}};
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const double a = sleigh_.parameter("offset");
    const Expression centre_x = x.v[0] + a * x.v[2];
    const Expression centre_y = x.v[1] + a * x.v[3];
    return 0.5 * (centre_x * centre_x + centre_y * centre_y) +
           0.5 * sleigh_.parameter("inertia") * (x.v[2] * x.v[2] + x.v[3] * x.v[3]);  // unit mass
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression torque = x.u[1] / (x.q[2] * x.q[2] + x.q[3] * x.q[3]);
    return ExpressionVector{{x.u[0] * x.q[2], x.u[0] * x.q[3], -torque * x.q[3], torque * x.q[2]}};
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }
  [[nodiscard]] BoundaryState initial_state() const override { return at(0.0, 0.0); }
  [[nodiscard]] BoundaryState final_state() const override { return at(1.0, 0.5 * std::numbers::pi); }
  [[nodiscard]] double horizon() const override { return sleigh_.horizon(); }
  [[nodiscard]] MotionPoint guess(double t) const override {
    const double share = t / horizon();
    return {
        .q = at(share, share * 0.5 * std::numbers::pi).q, .v = Eigen::Vector4d::Zero(), .u = Eigen::Vector2d::Zero()};
  }

 private:
  static BoundaryState at(double place, double theta) {
    return BoundaryState::at_rest(Eigen::Vector4d(place, place, std::cos(theta), std::sin(theta)));
  }
  ChaplyginSleigh sleigh_;
};

TEST_P(VelocityConstraintsBy, HaveTheOrderOfTheTableauTogetherWithHolonomicOnes) {
  const SleighByDirection problem;
  const int order = GetParam().tableau().order;
  const double coarse = solved_with_constraints(problem, GetParam(), 64).motion.cost - optimum_of(ChaplyginSleigh());
  const double fine = solved_with_constraints(problem, GetParam(), 128).motion.cost - optimum_of(ChaplyginSleigh());
  EXPECT_NEAR(std::log2(std::abs(coarse / fine)), order, 0.25) << coarse << ", " << fine;
}

INSTANTIATE_TEST_SUITE_P(All, VelocityConstraintsBy,
                         testing::Values(Scheme{"dmoc", 1}, Scheme{"hamiltonian", 1}, Scheme{"tangent", 1},
                                         Scheme{"tangent", 2}, Scheme{"tangent", 2, "lobatto"},
                                         Scheme{"tangent", 3, "lobatto"}),
                         tests::by_label);

void expect_equal(const Problem& problem, Eigen::Index intervals) {
  SCOPED_TRACE(problem.name());
  const Trajectory motion = solved_with_constraints(problem, {"dmoc", 1}, intervals).motion;
  const auto program = tests::transcribe(problem, {"hamiltonian", 1}, Grid::uniform(intervals));
  EXPECT_LT(tests::row_residual(*program, embed(problem, *program, motion)), 1e-10);
  const Trajectory collocated = solved_with_constraints(problem, {"hamiltonian", 1}, intervals).motion;
  const auto distance = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return (a - b).lpNorm<Eigen::Infinity>();
  };
  EXPECT_LT(distance(motion.q, collocated.q), 1e-12);
  EXPECT_LT(distance(motion.p, collocated.p), 1e-12);
  EXPECT_LT(distance(motion.stage_u, collocated.stage_u), 1e-12);
  EXPECT_LT(distance(motion.left_impulses, collocated.left_impulses), 1e-12);
  EXPECT_LT(distance(motion.right_impulses, collocated.right_impulses), 1e-12);
  EXPECT_LT(distance(motion.psi_q, collocated.psi_q), 1e-9);
  EXPECT_LT(distance(motion.psi_p, collocated.psi_p), 1e-9);
  EXPECT_NEAR(motion.cost, collocated.cost, 1e-13 * motion.cost);
}

TEST(VelocityConstraints, GiveEqualSolutionsByDmocAndHamiltonianCollocation) {
  expect_equal(ChaplyginSleighCartesian(), 32);
  expect_equal(RollingDisk(), 32);
  expect_equal(SleighByDirection(), 32);
}

/// One half of the sleigh's time.
class HalfOfTheSleigh final : public ChaplyginSleighCartesian {
 public:
  explicit HalfOfTheSleigh(bool is_first) : is_first_(is_first) {}
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] double horizon() const override { return 0.5 * ChaplyginSleighCartesian::horizon(); }
  [[nodiscard]] BoundaryState initial_state() const override { return is_first_ ? outer_state(true) : middle(); }
  [[nodiscard]] BoundaryState final_state() const override { return is_first_ ? middle() : outer_state(false); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    (is_first_ ? bounds.last : bounds.first) = {Bounds::none(3), Bounds::none(3), Bounds::none(0)};
    return bounds;
  }

 private:
  [[nodiscard]] BoundaryState outer_state(bool first) const {
    return first ? ChaplyginSleighCartesian::initial_state() : ChaplyginSleighCartesian::final_state();
  }
  static BoundaryState middle() {  // as guessed
    return {.q = Eigen::Vector3d(0.5, 0.5, 0.8), .v = Eigen::Vector3d(0.5, 0.5, 0.8)};
  }
  bool is_first_;
};

/// Both halves; velocities are continuous along the blade, and so across it.
class SleighInTwoPhases final : public PhasedProblem {
 public:
  SleighInTwoPhases()
      : PhasedProblem({{"first", std::make_shared<HalfOfTheSleigh>(true)},
                       {"second", std::make_shared<HalfOfTheSleigh>(false)}}) {}
  [[nodiscard]] std::string name() const override { return "sleigh_in_two_phases"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ExpressionVector link(std::size_t /*i*/, const PhaseEnd& before, const PhaseEnd& after) const override {
    const ExpressionVector change = after.v - before.v;
    const Expression along = cos(before.q[2]) * change[0] + sin(before.q[2]) * change[1];
    return stacked({after.q - before.q, ExpressionVector{{along, change[2]}}});
  }
};

TEST(VelocityConstraints, OfTwoPhasesGiveTheSolutionOfOne) {
  const SleighInTwoPhases in_phases;
  const ChaplyginSleighCartesian whole;
  for (const Scheme& scheme : {Scheme{"dmoc", 1}, Scheme{"hamiltonian", 1}, Scheme{"tangent", 2}}) {
    const Trajectory once = solved_with_constraints(whole, scheme, 32).motion;
    const Trajectory motion = solved_with_constraints(in_phases, scheme, 16).motion;
    EXPECT_NEAR(motion.cost, once.cost, 1e-12 * once.cost) << scheme.label();
    EXPECT_LT((motion.q.leftCols(3) - once.q.topRows(17)).lpNorm<Eigen::Infinity>(), 1e-12) << scheme.label();
  }
}

/// A particle in the plane, stated with velocity constraints that may be wrong.
class MisstatedRates : public tests::SmallProblem {
 public:
  using Formula = ExpressionVector (*)(const ExpressionVector& q, const ExpressionVector& v);
  explicit MisstatedRates(Formula formula, double last_rate = 0.0)
      : SmallProblem("misstated", BoundaryState::at_rest(Eigen::Vector2d::Zero()),
                     {.q = Eigen::Vector2d(1.0, 1.0), .v = Eigen::Vector2d(0.0, last_rate)}, 1.0, 1),
        formula_(formula) {}
  [[nodiscard]] ExpressionVector velocity_constraints(const ExpressionVector& q,
                                                      const ExpressionVector& v) const override {
    return formula_(q, v);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0], 0.0}};
  }

 private:
  Formula formula_;
};

std::string refusal(MisstatedRates::Formula formula, const Scheme& scheme = {"dmoc", 1}, double last_rate = 0.0) {
  const MisstatedRates problem(formula, last_rate);
  return tests::sentence_of_error([&] { static_cast<void>(tests::transcribe(problem, scheme, Grid::uniform(8))); });
}

ExpressionVector on_diagonal(const ExpressionVector& /*q*/, const ExpressionVector& v) {
  return ExpressionVector{{v[1] - v[0]}};
}

TEST(VelocityConstraintsRefused, ThatAreNotLinearInTheVelocity) {
  const std::string sentence =
      "misstated: velocity_constraints[0] is not linear in v; state the entries of A(q) v, which vanish at v = 0";
  using Vector = ExpressionVector;
  EXPECT_EQ(refusal([](const Vector& q, const Vector& v) { return Vector{{q[0] * v[0] * v[1]}}; }), sentence);
  EXPECT_EQ(refusal([](const Vector& /*q*/, const Vector& v) { return Vector{{v[0] - 1.0}}; }), sentence);
  EXPECT_EQ(refusal([](const Vector& q, const Vector& v) { return Vector{{v[0] - sin(q[1])}}; }), sentence);
  EXPECT_EQ(refusal([](const Vector& q, const Vector& /*v*/) { return Vector{{q[0] - q[1]}}; }), sentence);
  EXPECT_EQ(refusal([](const Vector& /*q*/, const Vector& /*v*/) { return Vector{{0.0}}; }), sentence);
}

TEST(VelocityConstraintsRefused, ThatLeaveNoFreedomOrAreDependent) {
  using Vector = ExpressionVector;
  EXPECT_EQ(refusal([](const Vector& /*q*/, const Vector& v) {
              return Vector{{v[0], v[1]}};
            }),
            "misstated: 2 constraints leave no degree of freedom for 2 coordinates; state fewer constraints");
  EXPECT_EQ(refusal([](const Vector& q, const Vector& v) { return Vector{{(q[1] - q[0]) * v[0]}}; }),
            "misstated: velocity_constraints are dependent at final_state: A has rank 0, not 1");
}

TEST(VelocityConstraintsRefused, WhereAGivenVelocityViolatesThem) {
  EXPECT_EQ(refusal(on_diagonal, {"dmoc", 1}, 0.5),
            "misstated: final_state violates velocity_constraints[0]: A v = 0.5, but must be 0");
}

TEST(VelocityConstraintsRefused, ByTableausThatAreNotOffered) {
  EXPECT_EQ(refusal(on_diagonal, {"dmoc", 2}),
            "dmoc supports velocity_constraints only with --tableau gauss --stages 1");
  EXPECT_EQ(refusal(on_diagonal, {"hamiltonian", 2, "lobatto"}),
            "hamiltonian supports velocity_constraints only with --tableau gauss --stages 1");
  EXPECT_EQ(refusal(on_diagonal, {"multiple_shooting_rk4_1", 1}),
            "velocity_constraints are not supported with --method multiple_shooting_rk4_1; use dmoc, hamiltonian or "
            "tangent");
}

TEST(VelocityConstraintsRefused, ByAnEmbedding) {
  class Embedded final : public MisstatedRates {
   public:
    Embedded() : MisstatedRates(on_diagonal) {}
    [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
      return ExpressionVector{{q[0] - q[1]}};
    }
    [[nodiscard]] ExpressionVector embedding(const ExpressionVector& theta) const override {
      return ExpressionVector{{theta[0], theta[0]}};
    }
  };
  EXPECT_EQ(tests::sentence_of_error([] { EmbeddedProblem(std::make_shared<const Embedded>()); }),
            "misstated: an embedding does not support velocity_constraints; use multipliers");
}

}  // namespace
}  // namespace dmocbench
