#include "methods/diagnostics/violation_between_stages.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Restated;
using tests::Scheme;
using Statement = Restated::Statement;

ViolationBetweenStages violation_of(const Problem& problem, const Trajectory& motion) {
  return violation_between_stages(problem, TracedProblem(problem), motion);
}

Trajectory solved_on(const Problem& problem, const Scheme& scheme, Eigen::Index intervals) {
  return tests::solve(problem, scheme, Grid::uniform(intervals), guessed_motion(problem)).trajectory;
}

/// What the optimum of the double integrator, q = 3t² - 2t³ by two Gauss stages on 8 intervals, violates of a
/// statement.
class OptimumOfDoubleIntegrator : public testing::Test {
 protected:
  [[nodiscard]] ViolationBetweenStages violating(const std::function<void(Statement&)>& state) const {
    return violation_of(Restated(base_, state), motion_);
  }
  const tests::DoubleIntegrator base_;
  const Trajectory motion_ = solved_on(base_, {"dmoc", 2}, 8);
};

TEST_F(OptimumOfDoubleIntegrator, ViolatesNothingWhereNothingIsBounded) {
  const ViolationBetweenStages none = violating([](Statement&) {});
  EXPECT_EQ(none.largest, 0.0);
  EXPECT_TRUE(none.is_motion());
  EXPECT_EQ(violating([](Statement& s) { s.q = tests::all_between(1, -1.0, 1.5); }).largest, 0.0);
}

TEST_F(OptimumOfDoubleIntegrator, IsMeasuredBetweenThePointsWhereItIsBounded) {
  // v = 6t(1 - t) reaches 1.5 at t = ½ (its lines between stages 1/64 more); the nodes reach from 0 to 1.5.
  const ViolationBetweenStages fast = violating([](Statement& s) { s.v = tests::all_between(1, -1.0, 1.25); });
  EXPECT_NEAR(fast.state.size, 0.25, 0.02);
  EXPECT_NEAR(fast.state.share, fast.state.size / 1.5, 1e-9);
  EXPECT_NEAR(fast.state.time, 0.5, 1e-9);
  EXPECT_EQ(fast.state.constraint, "bounds().v: the velocity of q[0] (q1)");
  EXPECT_FALSE(fast.is_motion());
}

TEST_F(OptimumOfDoubleIntegrator, LeavesAPathConstraintByWhatADisplacementWouldRepair) {
  // h = 0.75 - q = -0.25 at the end: q, whose range is 1, is a quarter of it too large.
  const ViolationBetweenStages low = violating([](Statement& s) {
    s.path_constraints = [](const ControlledState& x) { return ExpressionVector::Constant(1, 0.75 - x.q[0]); };
  });
  EXPECT_NEAR(low.state.share, 0.25, 1e-6);
  EXPECT_EQ(low.state.interval, 7);
  EXPECT_EQ(low.state.constraint, "path_constraints[0]");
  // Its unit does not matter, nor does a derivative that vanishes: at q = ½, h = (q - ½)² - 0.01² is least.
  const auto around = [&](double unit) {
    return violating([unit](Statement& s) {
             s.path_constraints = [unit](const ControlledState& x) {
               const Expression d = x.q[0] - 0.5;
               return ExpressionVector::Constant(1, unit * (d * d - 1e-4));
             };
           })
        .state.share;
  };
  EXPECT_NEAR(around(1.0), 1e-4 / largest_violation_of_a_motion, 1e-6);
  EXPECT_NEAR(around(1e3), around(1.0), 1e-9);
}

TEST_F(OptimumOfDoubleIntegrator, EntersAnObstacleByItsDepthInAnyUnit) {
  // q passes through the middle of h = ((q - 0.53)/r)² - 1 >= 0, the whole of its depth.
  const auto share = [&](double radius, double unit) {
    return violating([&](Statement& s) {
             s.path_constraints = [radius, unit](const ControlledState& x) {
               const Expression d = (x.q[0] - 0.53) / radius;
               return ExpressionVector::Constant(1, unit * (d * d - 1.0));
             };
           })
        .state.share;
  };
  for (const double radius : {1e-3, 1e-4, 1e-6}) {
    for (const double unit : {1.0, 1e3}) EXPECT_NEAR(share(radius, unit), 1.0, 0.03) << radius << ' ' << unit;
  }
}

TEST_F(OptimumOfDoubleIntegrator, IsNoMotionWhereAConstraintIsNotANumber) {
  const ViolationBetweenStages undefined = violating([](Statement& s) {
    s.path_constraints = [](const ControlledState& x) {
      return ExpressionVector::Constant(1, log(0.9 - x.q[0]) + 5.0);
    };
  });
  EXPECT_TRUE(std::isinf(undefined.largest));
  EXPECT_FALSE(undefined.is_motion());
}

TEST_F(OptimumOfDoubleIntegrator, MissesByTheImpulseThatClippingTakesAway) {
  // u = 6 - 12t is above 5 until t = 1/12, in the first interval: ∫(u - 5) dt = 1/24, of the range 1.5 of v; below -5
  // in the last one by as much.
  const ViolationBetweenStages strong = violating([](Statement& s) { s.u = tests::all_between(1, -5.0, 5.0); });
  EXPECT_NEAR(strong.control.size, 1.0, 1e-6);
  EXPECT_EQ(strong.control.constraint, "bounds().u: u[0] (u1)");
  EXPECT_NEAR(strong.missed, 2.0 / 24.0 / 1.5, 1e-3);
  // The mean of u - 5 over the interval, relative to the range of u over the stages.
  const double range = motion_.stage_u.maxCoeff() - motion_.stage_u.minCoeff();
  EXPECT_NEAR(strong.control.share, 8.0 / 24.0 / range, 1e-3);
  EXPECT_EQ(strong.intervals_of_control, (std::vector<Eigen::Index>{0, 7}));
  EXPECT_NE(strong.words(base_, motion_).find("galerkin --control-nodes 1"), std::string::npos);
  EXPECT_EQ(strong.state.share, 0.0);
  EXPECT_FALSE(strong.is_motion());
}

TEST(ViolationBetweenStages, MayGrazeAThinObstacleAndNotCrossIt) {
  // A disc in the plane of q and q̇: at t = ½ the optimum passes through (½, 3/2) along q, as deep inside as `depth`.
  const tests::DoubleIntegrator base;
  const Trajectory motion = solved_on(base, {"dmoc", 2}, 64);
  const auto is_motion = [&](double depth) {
    const Restated around(base, [depth](Statement& s) {
      s.path_constraints = [depth](const ControlledState& x) {
        constexpr double radius = 0.01;
        const Expression along = (x.q[0] - 0.5) / radius;
        const Expression across = (x.v[0] - 1.5) / radius - (1.0 - depth);
        return ExpressionVector::Constant(1, along * along + across * across - 1.0);
      };
    });
    return violation_of(around, motion).is_motion();
  };
  EXPECT_TRUE(is_motion(0.05));
  EXPECT_FALSE(is_motion(0.5));
  EXPECT_FALSE(is_motion(1.0));
}

TEST(ViolationBetweenStages, IsSeenWhereAThinWallIsCrossedBetweenTwoStages) {
  const tests::DoubleIntegrator base;
  for (const double radius : {0.03, 0.01, 0.003, 0.001}) {
    const Restated walled(base, [radius](Statement& s) {
      s.path_constraints = [radius](const ControlledState& x) {
        const Expression d = (x.q[0] - 0.53) / radius;
        return ExpressionVector::Constant(1, d * d - 1.0);
      };
    });
    for (const char* method : {"dmoc", "tangent"}) {
      for (const Eigen::Index intervals : {8, 16, 32, 64, 128}) {
        const ViolationBetweenStages found = violation_of(walled, solved_on(walled, {method}, intervals));
        EXPECT_FALSE(found.is_motion()) << method << ' ' << radius << ' ' << intervals;
        EXPECT_NEAR(found.largest, 1.0, 0.02) << method << ' ' << radius << ' ' << intervals;
      }
    }
  }
}

/// Obstacles in the way from q = 0 to 1, functions of the distance from 0.53 over their half width.
const std::vector<std::function<Expression(const Expression&, double)>>& obstacles() {
  static const std::vector<std::function<Expression(const Expression&, double)>> forms{
      [](const Expression& x, double /*radius*/) { return x * x - 1.0; },
      [](const Expression& x, double radius) { return radius * radius * (x * x - 1.0); },
      [](const Expression& x, double radius) { return radius * (sqrt(x * x + 1e-12) - 1.0); },
      [](const Expression& x, double /*radius*/) { return 0.5 - exp(-x * x); },
      [](const Expression& x, double /*radius*/) { return 1.0 - 2.0 / (1.0 + x * x); },
      [](const Expression& x, double /*radius*/) { return tanh(x * x - 1.0); }};
  return forms;
}

TEST(ViolationBetweenStages, IsSeenOfEveryObstacleThatIsCrossedHoweverThinAndFlatAround) {
  const tests::DoubleIntegrator base;
  for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
    for (const int stages : {1, 2}) {
      for (const Eigen::Index intervals : {8, 16, 32, 64, 128, 256}) {
        const Trajectory motion = solved_on(base, {method, stages}, intervals);
        for (std::size_t form = 0; form < obstacles().size(); ++form) {
          for (int width = 0; width < 20; ++width) {
            const double radius = 1e-4 * std::pow(1000.0, width / 19.0);
            const Restated walled(base, [form, radius](Statement& s) {
              s.path_constraints = [form, radius](const ControlledState& x) {
                return ExpressionVector::Constant(1, obstacles()[form]((x.q[0] - 0.53) / radius, radius));
              };
            });
            EXPECT_FALSE(violation_of(walled, motion).is_motion())
                << method << ' ' << stages << ' ' << intervals << " form " << form << " radius " << radius;
          }
        }
      }
    }
  }
}

/// A mass in the plane, from (0, 0) to (1, 0).
class MassInThePlane final : public tests::SmallProblem {
 public:
  MassInThePlane()
      : SmallProblem("mass_in_the_plane", {.q = Eigen::Vector2d::Zero(), .v = Eigen::Vector2d::Zero()},
                     {.q = Eigen::Vector2d::UnitX(), .v = Eigen::Vector2d::Zero()}, 1.0, 2) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v.dot(x.v); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }
};

TEST(ViolationBetweenStages, IsSeenOfADiscWhateverTheFormOfItsDistance) {
  // x goes from 0 to 1 at y = 0, past the centre (0.53, offset) of a disc, as deep in it as 1 - offset / radius.
  const std::vector<std::function<Expression(const Expression&, double)>> forms{
      [](const Expression& square, double r) { return square - r * r; },
      [](const Expression& square, double r) { return sqrt(square) - r; },
      [](const Expression& square, double r) { return log(square) - std::log(r * r); },
      [](const Expression& square, double r) { return 1.0 / (r * r) - 1.0 / square; },
      [](const Expression& square, double r) { return 1.0 / r - 1.0 / sqrt(square); },
      [](const Expression& square, double r) { return 1.0 - pow(r * r / square, 3.0); }};
  const MassInThePlane base;
  for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
    for (const Eigen::Index intervals : {8, 32, 128}) {
      const Trajectory motion = solved_on(base, {method}, intervals);
      for (std::size_t form = 0; form < forms.size(); ++form) {
        for (int width = 0; width < 10; ++width) {
          for (const double offset : {1e-9, 1e-3, 0.1, 0.3, 0.5, 0.99}) {
            const double radius = 1e-4 * std::pow(2000.0, width / 9.0);
            const Restated around(base, [&](Statement& s) {
              s.path_constraints = [&](const ControlledState& x) {
                const Expression along = x.q[0] - 0.53;
                const Expression across = x.q[1] - offset * radius;
                return ExpressionVector::Constant(1, forms[form](along * along + across * across, radius));
              };
            });
            const bool is_motion = violation_of(around, motion).is_motion();
            EXPECT_EQ(is_motion, offset > 0.95)
                << method << ' ' << intervals << " form " << form << " radius " << radius << " offset " << offset;
          }
        }
      }
    }
  }
}

TEST(ViolationBetweenStages, CountsTheVelocityAtNodesWhereOneStageHasTheMean) {
  const tests::DoubleIntegrator base;
  for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
    const Trajectory motion = solved_on(base, {method}, 8);
    const double fastest_stage = motion.stage_v.maxCoeff();
    const double excess = motion.v.maxCoeff() - fastest_stage;
    ASSERT_GT(excess, 0.01) << method;
    const Restated bounded(base, [&](Statement& s) { s.v = tests::all_between(1, -1.0, fastest_stage); });
    const Restated stated(base, [&](Statement& s) {
      s.path_constraints = [&](const ControlledState& x) {
        return ExpressionVector::Constant(1, fastest_stage - x.v[0]);
      };
    });
    for (const Problem* problem : {static_cast<const Problem*>(&bounded), static_cast<const Problem*>(&stated)}) {
      const ViolationBetweenStages found = violation_of(*problem, motion);
      EXPECT_NEAR(found.largest, excess, 1e-6) << method;
      EXPECT_FALSE(found.is_motion()) << method;
    }
  }
}

TEST_F(OptimumOfDoubleIntegrator, LeavesALimitThatIsNotZeroByItsShare) {
  // q is 1 at its end, so that 1000 (q - 0.99) exceeds a limit of 9 by 1; 0.5 % of the range of q change it by 5.
  const auto share = [&](double unit) {
    return violating([unit](Statement& s) {
             s.path = tests::all_between(1, -tests::infinity, 9.0 * unit);
             s.path_constraints = [unit](const ControlledState& x) {
               return ExpressionVector::Constant(1, unit * 1000.0 * (x.q[0] - 0.99));
             };
           })
        .state.share;
  };
  EXPECT_NEAR(share(1.0), 1.0 / 9.0, 1e-6);
  EXPECT_NEAR(share(1e3), 1.0 / 9.0, 1e-6);
}

TEST(ViolationBetweenStages, OfASmoothMotionAlongAConstraintFallsWithTheSquareOfTheStep) {
  const tests::DoubleIntegrator base;
  const Restated slow(base, [](Statement& s) {
    s.path_constraints = [](const ControlledState& x) {
      return ExpressionVector::Constant(1, 1.25 - x.v[0] - 0.2 * x.q[0]);
    };
  });
  const auto share = [&](Eigen::Index intervals) {
    return violation_of(slow, solved_on(slow, {"tangent", 2}, intervals)).state.share;
  };
  EXPECT_LE(share(64), largest_violation_of_a_motion);
  EXPECT_LT(share(128), 0.5 * share(32));
}

/// A mass that leaves q = 0 at one speed and comes back at another, below a bound on q, by a bounded force.
class MassBelowABound final : public tests::SmallProblem {
 public:
  MassBelowABound(double first_speed, double last_speed, double horizon, double highest, double most_force)
      : SmallProblem("mass_below_a_bound", at(0.0, first_speed), at(0.0, last_speed), horizon, 1),
        highest_(highest),
        most_force_(most_force) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * x.v[0] * x.v[0]; }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0]; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = SmallProblem::bounds();
    bounds.q = tests::all_between(1, -tests::infinity, highest_);
    bounds.u = tests::all_between(1, -most_force_, most_force_);
    return bounds;
  }

 private:
  double highest_;
  double most_force_;
};

TEST(ViolationBetweenStages, IsPricedByWhatABoundThatIsLowerByTheExcessAddsToTheCost) {
  // Unbounded, q = 3t - 3t² reaches 0.75 at t = ½, half way between two nodes, where one stage has a line.
  const auto below = [](double bound) { return MassBelowABound(3.0, -3.0, 1.0, bound, 100.0); };
  for (const tests::Scheme& scheme : {Scheme{"dmoc"}, Scheme{"hamiltonian"}, Scheme{"tangent"}}) {
    const Trajectory motion = solved_on(below(0.7), scheme, 17);
    const MotionViolation found = violation_of(below(0.7), motion).state;
    EXPECT_TRUE(found.is_priced) << scheme.label();
    EXPECT_EQ(found.interval, 8) << scheme.label();
    EXPECT_EQ(found.constraint, "bounds().q: q[0] (q1)") << scheme.label();
    const double added = solved_on(below(0.7 - found.size), scheme, 17).cost - motion.cost;
    EXPECT_NEAR(found.share / share_per_added_cost * motion.cost, added, 0.1 * added) << scheme.label();
  }
}

TEST(ViolationBetweenStages, IsSeenWhereNoForceStopsAMassBeforeAWallButTheNodesLieOnBothSidesOfTheTurn) {
  for (const tests::Scheme& scheme : {Scheme{"dmoc", 1}, Scheme{"tangent", 1}, Scheme{"dmoc", 2}}) {
    const auto found = [&](double turn) {  // the least q at which a force of 1 stops it
      const MassBelowABound problem(std::sqrt(2.0 * turn), 0.0, 6.0, 1.0, 1.0);
      return violation_of(problem, solved_on(problem, scheme, 16));
    };
    EXPECT_FALSE(found(1.003).is_motion()) << scheme.label();
    EXPECT_TRUE(found(0.9).is_motion()) << scheme.label();
  }
}

}  // namespace
}  // namespace dmocbench
