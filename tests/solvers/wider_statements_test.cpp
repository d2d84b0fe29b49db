// What a problem may state besides the class of section 3.1, by Ipopt and by the interior-point method that eliminates
// interval by interval: closed forms, prices and refusals.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "methods/diagnostics/accuracy.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/wider_problems.hpp"

namespace dmocbench {
namespace {

using tests::Restated;
using tests::Scheme;
using Statement = Restated::Statement;

ExpressionVector one(const Expression& entry) { return ExpressionVector::Constant(1, entry); }

class WiderStatements : public testing::TestWithParam<tests::Way> {
 protected:
  static Trajectory solved(const Problem& problem, Eigen::Index intervals) {
    const auto program = tests::transcribe(problem, GetParam().scheme, Grid::uniform(intervals));
    SolverOptions options;
    options.tolerance = 1e-10;
    const Solution solution =
        make_solver(GetParam().solver, options)->solve(*program, sample(*program, guessed_motion(problem)));
    EXPECT_EQ(solution.status, Status::solved) << solution.message;
    return read_trajectory(*program, solution.primal, solution.multipliers);
  }
  /// What may be left of a closed form on 16 intervals: polynomials of low degree, exact from order 4 on.
  static double tolerance() { return GetParam().scheme.tableau().order == 2 ? 0.02 : 1e-7; }
};

TEST_P(WiderStatements, UnknownMassIsThatOfTheClosedForm) {
  const tests::UnknownMass problem;
  const Trajectory motion = solved(problem, 16);
  EXPECT_NEAR(motion.unknowns[0], 3.0 / 7.0, tolerance());
  EXPECT_NEAR(motion.cost, 54.0 / 7.0, 3.0 * tolerance());
  // The momenta are those of the mass that was found.
  EXPECT_NEAR(motion.p(0, 0), motion.unknowns[0], 1e-9);
  EXPECT_LT((motion.p - motion.unknowns[0] * motion.v).lpNorm<Eigen::Infinity>(), 1e-9);
}

TEST_P(WiderStatements, DiagnosticsSeeTheProblemWithTheUnknownsThatWereFound) {
  const tests::UnknownMass problem;
  const Trajectory motion = solved(problem, 16);
  EXPECT_LT(accuracy(problem, motion).relative_jump, GetParam().scheme.tableau().order == 2 ? 5e-3 : 1e-5);
  EXPECT_NEAR(replay_error(problem, motion).cost, motion.cost, 3.0 * tolerance());
  if (GetParam().scheme.method != "tangent") {
    EXPECT_LT(momentum_consistency(problem, motion).largest, 1e-9);
  }
  EXPECT_EQ(problem.parameter("mass"), 1.0);
}

TEST_P(WiderStatements, SolveStartsFromTheUnknownsOfItsStart) {
  const tests::UnknownMass problem;
  const Trajectory motion = solved(problem, 16);
  const auto program = tests::transcribe(problem, GetParam().scheme, Grid::uniform(32));
  const auto of_guess = program->unknown_parameters(sample(*program, guessed_motion(problem)));
  const auto of_motion = program->unknown_parameters(sample(*program, smooth_motion(motion)));
  EXPECT_EQ(of_guess[0], 1.0);
  EXPECT_EQ(of_motion[0], motion.unknowns[0]);
}

TEST_P(WiderStatements, IntegralConstraintHasItsClosedForm) {
  // q = 3t² - 2t³ + c t²(1 - t)² with c = 30(a - ½) has ∫q dt = a and J = 6 + 0.4 c²; dJ/da = 24 c.
  const tests::DoubleIntegrator base;
  const Restated problem(base, [](Statement& s) {
    s.integrands = [](const ControlledState& x) { return one(x.q[0]); };
    s.integrals = Bounds::all(1, 0.6, 0.6);
  });
  const Trajectory coarse = solved(problem, 16);
  const Trajectory fine = solved(problem, 32);
  EXPECT_NEAR(fine.integrals[0], 0.6, 1e-9);
  const auto expect_order = [](double of_coarse, double of_fine) {
    if (std::abs(of_coarse) > 1e-7) {
      EXPECT_NEAR(std::log2(of_coarse / of_fine), GetParam().scheme.tableau().order, 0.1);
    }
  };
  expect_order(coarse.cost - 9.6, fine.cost - 9.6);
  expect_order(coarse.integral_prices[0] - 72.0, fine.integral_prices[0] - 72.0);
}

TEST_P(WiderStatements, IntegralThatNeedsNoConstraintHasNoPrice) {
  const tests::DoubleIntegrator base;
  const Restated problem(base, [](Statement& s) {
    s.integrands = [](const ControlledState& x) {
      ExpressionVector c(2);
      c << x.q[0], x.u[0] * x.u[0];
      return c;
    };
    s.integrals = {Eigen::Vector2d(0.4, 0.0), Eigen::Vector2d(0.55, tests::infinity)};
  });
  const Trajectory motion = solved(problem, 16);
  const Trajectory without = solved(base, 16);
  EXPECT_NEAR(motion.cost, without.cost, 1e-7);
  EXPECT_NEAR(motion.integrals[1], 2.0 * without.cost, 1e-6);  // the cost is half of it
  EXPECT_LT(motion.integral_prices.lpNorm<Eigen::Infinity>(), 1e-6);
}

TEST_P(WiderStatements, PriceOfAnIntegralIsTheSlopeOfTheLeastCost) {
  const tests::DoubleIntegrator base;
  const auto solved_with = [&](double least) {
    const Restated problem(base, [least](Statement& s) {
      s.integrands = [](const ControlledState& x) { return one(exp(x.q[0])); };
      s.integrals = {Eigen::VectorXd::Constant(1, least), Eigen::VectorXd::Constant(1, tests::infinity)};
    });
    return solved(problem, 16);
  };
  constexpr double step = 1e-3;
  const double slope = (solved_with(2.0 + step).cost - solved_with(2.0 - step).cost) / (2.0 * step);
  EXPECT_GT(slope, 1.0);
  EXPECT_NEAR(solved_with(2.0).integral_prices[0], slope, 1e-4 * slope);
}

TEST_P(WiderStatements, EqualBoundsMakeAnEqualityAlongTheMotion) {
  const Trajectory motion = solved(tests::TwoForces(), 16);
  EXPECT_NEAR(motion.cost, 3.75, 6.0 * tolerance());
  EXPECT_LT((motion.stage_u.col(0) + 3.0 * motion.stage_u.col(1)).lpNorm<Eigen::Infinity>(), 1e-8);
}

TEST_P(WiderStatements, TwoSidedConstraintAndTwoConstraintsAreTheSameProblem) {
  const tests::DoubleIntegrator base;
  const Restated two_sided(base, [](Statement& s) {
    s.path_constraints = [](const ControlledState& x) { return one(x.u[0] + x.v[0]); };
    s.path = Bounds::all(1, -5.0, 5.5);
  });
  const Restated pair(base, [](Statement& s) {
    s.path_constraints = [](const ControlledState& x) {
      ExpressionVector h(2);
      h << x.u[0] + x.v[0] + 5.0, 5.5 - x.u[0] - x.v[0];
      return h;
    };
  });
  const Trajectory a = solved(two_sided, 24);
  const Trajectory b = solved(pair, 24);
  EXPECT_NEAR(a.cost, b.cost, 1e-6 * b.cost);
  const Eigen::VectorXd h = a.stage_u.col(0) + a.stage_v.col(0);
  EXPECT_LT(h.maxCoeff(), 5.5 + 1e-7);
  EXPECT_GT(h.minCoeff(), -5.0 - 1e-7);
  EXPECT_NEAR(h.maxCoeff(), 5.5, 1e-3);  // it acts
  EXPECT_NEAR(h.minCoeff(), -5.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(All, WiderStatements, testing::ValuesIn(tests::ways_by({"ipopt", "interior_point"})),
                         tests::by_label);

class WiderStatementsRefused : public testing::Test {
 protected:
  static std::string sentence(const Problem& problem, const Scheme& scheme = {"dmoc", 1}) {
    return tests::sentence_of_error([&] { static_cast<void>(tests::transcribe(problem, scheme, Grid::uniform(8))); });
  }
  static std::string restated(const std::function<void(Statement&)>& state) {
    const tests::DoubleIntegrator base;
    return sentence(Restated(base, state));
  }
};

TEST_F(WiderStatementsRefused, UnknownThatNoFormulaReads) {
  class Idle final : public tests::SmallProblem {
   public:
    Idle() : SmallProblem("idle", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1, {{"a", 1.0, "", "", 0.0, 2.0, false, true}}) {}
  };
  EXPECT_EQ(sentence(Idle()), "idle: no formula depends on the unknown a; remove it");
}

TEST_F(WiderStatementsRefused, UnknownThatAFormulaReadsAsANumber) {
  class Number final : public tests::SmallProblem {
   public:
    Number()
        : SmallProblem("number", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1, {{"a", 1.0, "", "", 0.0, 2.0, false, true}}) {}
    [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
      return parameter("a") * x.u[0] * x.u[0];
    }
  };
  EXPECT_EQ(sentence(Number()), "number: a formula reads the unknown a as a number, with parameter(); use varying()");
}

TEST_F(WiderStatementsRefused, BoundsOfAnotherSize) {
  EXPECT_EQ(restated([](Statement& s) { s.integrands = [](const ControlledState& x) { return one(x.q[0]); }; }),
            "double_integrator: bounds().integrals has 0 entries, but integrands has 1");
  EXPECT_EQ(restated([](Statement& s) { s.path = Bounds::all(2, 0.0, 1.0); }),
            "double_integrator: bounds().path has 2 entries, but path_constraints has 0");
}

TEST_F(WiderStatementsRefused, BoundsThatContradictEachOther) {
  EXPECT_EQ(restated([](Statement& s) {
              s.path_constraints = [](const ControlledState& x) { return one(x.u[0]); };
              s.path = Bounds::all(1, 1.0, -1.0);
            }),
            "double_integrator: bounds().path: entry 0 has the lower bound 1 above the upper bound -1");
}

TEST_F(WiderStatementsRefused, MoreEqualitiesThanControls) {
  EXPECT_EQ(restated([](Statement& s) {
              s.path_constraints = [](const ControlledState& x) {
                ExpressionVector h(2);
                h << x.u[0] - x.q[0], x.u[0] + x.v[0];
                return h;
              };
              s.path = Bounds::all(2, 0.0, 0.0);
            }),
            "double_integrator: bounds().path makes 2 path constraints equalities; at most 1, one per control, "
            "are possible");
}

TEST_F(WiderStatementsRefused, EqualitiesThatLeaveNothingFree) {
  EXPECT_EQ(restated([](Statement& s) {
              s.path_constraints = [](const ControlledState& x) { return one(x.u[0] - x.q[0]); };
              s.path = Bounds::all(1, 0.0, 0.0);
            }),
            "double_integrator has no free control, so no number of intervals can satisfy both end states");
}

TEST_F(WiderStatementsRefused, EqualityThatTwoIntervalsWouldImposeOnANode) {
  const tests::TwoForces base;
  const Restated problem(base, [](Statement& s) {
    s.path_constraints = [](const ControlledState& x) { return one(x.q[0] - x.t); };
    s.path = Bounds::all(1, 0.0, 0.0);
  });
  EXPECT_EQ(sentence(problem, {"dmoc", 2, "lobatto"}),
            "two_forces: bounds().path makes path_constraints[0] an equality, which two "
            "intervals would impose on the same node; use --tableau gauss");
}

}  // namespace
}  // namespace dmocbench
