// Holonomic constraints: degrees of freedom, orders at the nodes, equal solutions, momenta, and what is refused.
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/judgement/polish.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/motion_constraints.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "problems/cart_pole_cartesian.hpp"
#include "problems/spherical_pendulum_cartesian.hpp"
#include "tests/solvers/constrained_motions.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Answer;
using tests::Scheme;

Answer solved(const Problem& problem, const Scheme& scheme, Eigen::Index intervals, const Motion& start,
              const std::string& solver = "interior_point") {
  return tests::confirmed(problem, scheme, intervals, start, 1e-9, solver);
}

/// The minimal statement solved with order 8, and its motion in redundant coordinates at the nodes.
template <class Redundant>
struct Reference {
  static constexpr Eigen::Index intervals = 256;
  Reference()
      : minimal(problem.minimal()), motion(solved(minimal, {"hamiltonian", 4}, intervals, near(minimal)).motion) {
    start = near(problem);
  }
  static Motion near(const Problem& of) {
    return smooth_motion(solved(of, {"dmoc", 1}, 64, guessed_motion(of)).motion);
  }

  Redundant problem;
  decltype(std::declval<Redundant>().minimal()) minimal;
  Trajectory motion;
  Motion start;
};

template <class Redundant>
const Reference<Redundant>& reference() {
  static const Reference<Redundant> known;
  return known;
}

std::vector<Scheme> schemes() {
  std::vector<Scheme> all{{"dmoc", 1}, {"hamiltonian", 1}, {"tangent", 1}, {"tangent", 2}};
  for (const std::string method : {"dmoc", "hamiltonian", "tangent"}) {
    for (const int stages : {2, 3}) all.push_back({method, stages, "lobatto"});
  }
  return all;
}

class HolonomicConstraintsBy : public testing::TestWithParam<Scheme> {};

TEST_P(HolonomicConstraintsBy, LeaveRowsOfFullRankAndAsManyFreedomsAsTheMinimalStatement) {
  // Both ends' states in two coordinates, less their conditions: given momenta of the ends take the place of states.
  tests::expect_full_rank<SphericalPendulumCartesian>(GetParam(), {{tests::Ends::given, 4 - 8},
                                                                   {tests::Ends::free_last_velocity, 4 - 6},
                                                                   {tests::Ends::free_last, 4 - 4},
                                                                   {tests::Ends::free_first_velocity, 4 - 6}});
}

/// The errors at the nodes of a motion in redundant coordinates: q, p, cost, and costates along motions.
template <class Redundant>
std::map<std::string, double> errors(const Trajectory& motion, const Reference<Redundant>& reference) {
  const Eigen::Index stride = Reference<Redundant>::intervals / motion.intervals();
  const TracedProblem traced(reference.problem);
  const TracedProblem of_minimal(reference.minimal);
  LegendreTransform legendre(traced);
  LegendreTransform legendre_of_minimal(of_minimal);
  std::map<std::string, double> largest{{"q", 0.0}, {"p", 0.0}, {"psi", 0.0}};
  for (Eigen::Index k = 0; k <= motion.intervals(); ++k) {
    const MotionPoint exact = reference.motion.node(k * stride);
    const BoundaryState state = reference.problem.lifted({.q = exact.q, .v = exact.v});
    const auto raise = [&](const char* name, double error) { largest[name] = std::max(largest[name], error); };
    raise("q", (motion.q.row(k).transpose() - state.q).norm());
    raise("p", (motion.p.row(k).transpose() - legendre.momentum(state.q, state.v, 0.0)).norm());
    for (Eigen::Index i = 0; i < 2 * exact.q.size(); ++i) {  // along θ_i, then along θ̇_i
      constexpr double step = 1e-5;
      const auto moved = [&](double by) {
        BoundaryState at{.q = exact.q, .v = exact.v};
        (i < exact.q.size() ? at.q[i] : at.v[i - exact.q.size()]) += by;
        return at;
      };
      const BoundaryState ahead = reference.problem.lifted(moved(step));
      const BoundaryState behind = reference.problem.lifted(moved(-step));
      const Eigen::VectorXd along_q = (ahead.q - behind.q) / (2.0 * step);
      const Eigen::VectorXd along_p =
          (legendre.momentum(ahead.q, ahead.v, 0.0) - legendre.momentum(behind.q, behind.v, 0.0)) / (2.0 * step);
      const Eigen::VectorXd minimal_q = (moved(step).q - moved(-step).q) / (2.0 * step);
      const Eigen::VectorXd minimal_p = (legendre_of_minimal.momentum(moved(step).q, moved(step).v, 0.0) -
                                         legendre_of_minimal.momentum(moved(-step).q, moved(-step).v, 0.0)) /
                                        (2.0 * step);
      const double known =
          reference.motion.psi_q.row(k * stride).dot(minimal_q) + reference.motion.psi_p.row(k * stride).dot(minimal_p);
      const double found = motion.psi_q.row(k).dot(along_q) + motion.psi_p.row(k).dot(along_p);
      raise("psi", std::abs(found - known));
    }
  }
  largest["cost"] = std::abs(motion.cost - reference.motion.cost);
  return largest;
}

template <class Redundant>
void expect_orders(const Scheme& scheme) {
  const Reference<Redundant>& known = reference<Redundant>();
  const int order = scheme.tableau().order;
  const Eigen::Index finest = order == 2 ? 256 : 128;
  const auto at = [&](Eigen::Index intervals) {
    return errors(solved(known.problem, scheme, intervals, known.start).motion, known);
  };
  const std::map<std::string, double> coarse = at(finest / 2);
  const std::map<std::string, double> fine = at(finest);
  for (const auto& [name, error] : fine) {
    const double slope = std::log2(coarse.at(name) / error);
    EXPECT_GT(slope, order - 0.25) << name << ": errors " << coarse.at(name) << ", " << error;
    if (name == "cost") continue;  // where terms cancel, it may converge faster
    EXPECT_LT(slope, order + 0.25) << name << ": errors " << coarse.at(name) << ", " << error;
  }
}

TEST_P(HolonomicConstraintsBy, HaveTheOrderOfTheTableauOnTheSphere) {
  expect_orders<SphericalPendulumCartesian>(GetParam());
}

TEST_P(HolonomicConstraintsBy, HaveTheOrderOfTheTableauOnTheCart) { expect_orders<CartPoleCartesian>(GetParam()); }

TEST_P(HolonomicConstraintsBy, HoldAtTheNodesToRounding) {
  const auto& known = reference<CartPoleCartesian>();
  const Answer answer = solved(known.problem, GetParam(), 64, known.start);
  MotionConstraints constraints(answer.program->traced_problem());
  for (Eigen::Index k = 0; k <= 64; ++k) {
    constraints.evaluate(answer.motion.q.row(k).transpose());
    const double size = answer.motion.q.cwiseAbs().maxCoeff();
    EXPECT_LT(std::abs(constraints.residual()[0]), 100.0 * std::numeric_limits<double>::epsilon() * size * size);
    EXPECT_LT((constraints.jacobian() * answer.motion.v.row(k).transpose()).norm(), 1e-12);
  }
}

TEST_P(HolonomicConstraintsBy, LetMomentaBeTheWorkOfTheForces) {
  const auto& known = reference<SphericalPendulumCartesian>();
  const Trajectory motion = solved(known.problem, GetParam(), 16, known.start).motion;
  const MomentumConsistency consistency = momentum_consistency(known.problem, motion);
  if (GetParam().method == "tangent") {
    EXPECT_GT(consistency.largest, 1e-9);
  } else {
    EXPECT_LT(consistency.largest, 1e-12);
  }
}

TEST_P(HolonomicConstraintsBy, AreKeptByTheReplayOfTheControls) {
  const auto& known = reference<SphericalPendulumCartesian>();
  const auto missed = [&](Eigen::Index intervals) {
    return replay_error(known.problem, solved(known.problem, GetParam(), intervals, known.start).motion).norm();
  };
  EXPECT_LT(missed(64), 0.5 * missed(32));
}

TEST_P(HolonomicConstraintsBy, AreSolvedAlikeByIpoptAndByTheEliminationOfIntervals) {
  const CartPoleCartesian problem;
  const Motion start = guessed_motion(problem);
  const double by_intervals = solved(problem, GetParam(), 48, start).motion.cost;
  EXPECT_NEAR(solved(problem, GetParam(), 48, start, "ipopt").motion.cost, by_intervals, 1e-8 * by_intervals);
}

INSTANTIATE_TEST_SUITE_P(All, HolonomicConstraintsBy, testing::ValuesIn(schemes()), tests::by_label);

class EqualWithConstraints : public testing::TestWithParam<Scheme> {};

TEST_P(EqualWithConstraints, SolutionOfDmocSolvesTheProgramOfHamiltonianCollocation) {
  const auto& known = reference<SphericalPendulumCartesian>();
  const Scheme other{"hamiltonian", GetParam().stages, GetParam().family};
  const Trajectory motion = solved(known.problem, GetParam(), 32, known.start).motion;
  const auto program = tests::transcribe(known.problem, other, Grid::uniform(32));
  EXPECT_LT(tests::row_residual(*program, embed(known.problem, *program, motion)), 1e-10);
  const Trajectory collocated = solved(known.problem, other, 32, known.start).motion;
  EXPECT_LT((motion.q - collocated.q).lpNorm<Eigen::Infinity>(), 1e-12);
  EXPECT_LT((motion.p - collocated.p).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_LT((motion.stage_u - collocated.stage_u).lpNorm<Eigen::Infinity>(), 1e-10);
  EXPECT_NEAR(motion.cost, collocated.cost, 1e-13 * motion.cost);
}

INSTANTIATE_TEST_SUITE_P(All, EqualWithConstraints,
                         testing::Values(Scheme{"dmoc", 1}, Scheme{"dmoc", 2, "lobatto"}, Scheme{"dmoc", 3, "lobatto"}),
                         tests::by_label);

/// A bead on the parabola z = x², whose height has no inertia: L_vv is singular.
class Bead final : public tests::SmallProblem {
 public:
  Bead() : SmallProblem("bead", on_parabola(-1.0), on_parabola(1.5), 1.0, 1) {}
  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    return ExpressionVector{{q[1] - q[0] * q[0]}};
  }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0] - x.q[1]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0], 0.0}};
  }

 private:
  static BoundaryState on_parabola(double x) { return BoundaryState::at_rest(Eigen::Vector2d(x, x * x)); }
};

/// The same in its one coordinate: a linear-quadratic problem.
class BeadInOneCoordinate final : public tests::SmallProblem {
 public:
  BeadInOneCoordinate() : SmallProblem("bead_in_one_coordinate", at(-1.0, 0.0), at(1.5, 0.0), 1.0, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0] - x.q[0] * x.q[0]; }
};

TEST(HolonomicConstraintsWithoutInertia, HaveOrderTwoByDmocWithOneGaussStage) {
  const Bead bead;
  const BeadInOneCoordinate minimal;
  const double exact = solved(minimal, {"dmoc", 4}, 64, guessed_motion(minimal)).motion.cost;
  const auto error = [&](Eigen::Index intervals) {
    return std::abs(solved(bead, {"dmoc", 1}, intervals, guessed_motion(bead)).motion.cost - exact);
  };
  EXPECT_NEAR(std::log2(error(32) / error(64)), 2.0, 0.1);
}

TEST(HolonomicConstraintsWithoutInertia, AreRefusedByOtherMethods) {
  for (const Scheme& scheme : {Scheme{"dmoc", 2, "lobatto"}, Scheme{"tangent", 1}}) {
    tests::expect_error_naming({"L_vv is singular", "use dmoc with --tableau gauss --stages 1"},
                               [&] { static_cast<void>(tests::transcribe(Bead(), scheme, Grid::uniform(8))); });
  }
}

/// A particle on a line, stated with constraints that may be wrong.
class Misstated final : public tests::SmallProblem {
 public:
  Misstated(ExpressionVector (*g)(const ExpressionVector&), double last_y)
      : SmallProblem("misstated", BoundaryState::at_rest(Eigen::Vector2d::Zero()),
                     BoundaryState::at_rest(Eigen::Vector2d(1.0, last_y)), 1.0, 1),
        constraints_(g) {}
  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override { return constraints_(q); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0], 0.0}};
  }

 private:
  ExpressionVector (*constraints_)(const ExpressionVector&);
};

std::string refusal(ExpressionVector (*constraints)(const ExpressionVector&), double last_y = 1.0,
                    const Scheme& scheme = {"dmoc", 1}) {
  const Misstated problem(constraints, last_y);
  return tests::sentence_of_error([&] { static_cast<void>(tests::transcribe(problem, scheme, Grid::uniform(8))); });
}

ExpressionVector on_diagonal(const ExpressionVector& q) { return ExpressionVector{{q[1] - q[0]}}; }

TEST(HolonomicConstraintsRefused, ThatDependOnNothing) {
  EXPECT_EQ(refusal([](const ExpressionVector&) { return ExpressionVector{{1.0}}; }),
            "misstated: constraints[0] depends on no coordinate");
}

TEST(HolonomicConstraintsRefused, ThatLeaveNoFreedom) {
  EXPECT_EQ(refusal([](const ExpressionVector& q) {
              return ExpressionVector{{q[0], q[1]}};
            }),
            "misstated: 2 constraints leave no degree of freedom for 2 coordinates; state fewer constraints");
}

TEST(HolonomicConstraintsRefused, WhereAnEndIsOffTheManifold) {
  EXPECT_EQ(refusal(on_diagonal, 1.5), "misstated: final_state violates constraints[0]: g = 0.5, but must be 0");
}

TEST(HolonomicConstraintsRefused, WithGradientsThatVanish) {
  EXPECT_EQ(refusal([](const ExpressionVector& q) { return ExpressionVector{{(q[1] - q[0]) * (q[1] - q[0])}}; }),
            "misstated: constraints are dependent at final_state: G = dg/dq has rank 0, not 1");
}

TEST(HolonomicConstraintsRefused, ByTableausThatAreNotOffered) {
  EXPECT_EQ(refusal(on_diagonal, 1.0, {"dmoc", 2}),
            "dmoc supports constraints g(q) = 0 only with --tableau gauss --stages 1 or --tableau lobatto");
  EXPECT_EQ(refusal(on_diagonal, 1.0, {"hamiltonian", 2}),
            "hamiltonian supports constraints g(q) = 0 only with --tableau gauss --stages 1 or --tableau lobatto");
  EXPECT_EQ(refusal(on_diagonal, 1.0, {"tangent", 3}),
            "tangent supports constraints g(q) = 0 with --tableau gauss --stages 1 or 2, or --tableau lobatto --stages "
            "2 or 3");
  EXPECT_EQ(
      refusal(on_diagonal, 1.0, {"multiple_shooting_rk4_1", 1}),
      "constraints g(q) = 0 are not supported with --method multiple_shooting_rk4_1; use dmoc, hamiltonian or tangent");
}

/// A particle on a line whose inertia grows with its speed.
class FasterIsHeavier final : public tests::SmallProblem {
 public:
  FasterIsHeavier()
      : SmallProblem("faster_is_heavier", BoundaryState::at_rest(Eigen::Vector2d::Zero()),
                     BoundaryState::at_rest(Eigen::Vector2d::Ones()), 1.0, 1) {}
  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override { return on_diagonal(q); }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression squared = x.v.dot(x.v);
    return 0.5 * squared + 0.01 * squared * squared;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0], 0.0}};
  }
};

TEST(HolonomicConstraintsRefused, ByHamiltonianCollocationWhereInertiaDependsOnTheVelocity) {
  const FasterIsHeavier problem;
  for (const Scheme& scheme : {Scheme{"hamiltonian", 1}, Scheme{"hamiltonian", 2, "lobatto"}}) {
    EXPECT_EQ(
        tests::sentence_of_error([&] { static_cast<void>(tests::transcribe(problem, scheme, Grid::uniform(8))); }),
        "faster_is_heavier: hamiltonian supports constraints g(q) = 0 only if L is quadratic in v, but "
        "L_vv depends on v; use dmoc or tangent");
  }
  for (const Scheme& scheme : {Scheme{"dmoc", 1}, Scheme{"tangent", 1}}) {
    solved(problem, scheme, 16, guessed_motion(problem));  // fails where it is not confirmed
  }
}

}  // namespace
}  // namespace dmocbench
