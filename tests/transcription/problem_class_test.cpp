// The whole problem class of section 3.1, each part by a problem that can be stated in two ways or solved by hand.
#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/transcription/start.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::all_between;
using tests::Restated;
using tests::Scheme;
using tests::Solved;
using Statement = Restated::Statement;

ExpressionVector one(const Expression& entry) { return ExpressionVector::Constant(1, entry); }

Solved solved(const Problem& problem, const Scheme& scheme, Eigen::Index intervals, CostForm form = CostForm::bolza) {
  return tests::solve(problem, scheme, Grid::uniform(intervals), guessed_motion(problem), 1e-11, form);
}

class ProblemClass : public testing::TestWithParam<Scheme> {
 protected:
  static void expect_same(const Problem& one_way, const Problem& other_way, double tolerance = 1e-9) {
    const Solved a = solved(one_way, GetParam(), 12);
    const Solved b = solved(other_way, GetParam(), 12);
    EXPECT_NEAR(a.trajectory.cost, b.trajectory.cost, tolerance * std::max(1.0, std::abs(a.trajectory.cost)));
    EXPECT_LT((a.trajectory.q - b.trajectory.q).lpNorm<Eigen::Infinity>(), 100.0 * tolerance);
    EXPECT_LT((a.trajectory.psi_q - b.trajectory.psi_q).lpNorm<Eigen::Infinity>(),
              1e4 * tolerance * a.trajectory.psi_q.lpNorm<Eigen::Infinity>());
  }
};

TEST_P(ProblemClass, FinalStateByBoundsAndByConditionsIsTheSameProblem) {
  const tests::MovingFrame fixed;
  const Restated conditioned(fixed, [&](Statement& s) {
    const BoundaryState last = fixed.final_state();
    s.last = tests::free_end(2);
    s.conditions = [last](const State&, const State& end) {
      ExpressionVector r(4);
      r << end.q[0] - last.q[0], end.q[1] - last.q[1], end.v[0] - last.v[0], end.v[1] - last.v[1];
      return r;
    };
  });
  expect_same(fixed, conditioned);
}

TEST_P(ProblemClass, InitialStateByBoundsAndByConditionsIsTheSameProblem) {
  const tests::MovingFrame fixed;
  const Restated conditioned(fixed, [&](Statement& s) {
    const BoundaryState state = fixed.initial_state();
    s.first.free_velocity(0).free_velocity(1).free_configuration(1);
    s.conditions = [state](const State& first, const State&) {
      ExpressionVector r(3);
      r << first.q[1] - state.q[1], first.v[0] - state.v[0], first.v[1] - state.v[1];
      return r;
    };
  });
  expect_same(fixed, conditioned);
}

TEST_P(ProblemClass, HorizonPinnedByItsBoundIsTheFixedHorizon) {
  // A longer swing-up is cheaper, so the upper bound is active.
  const tests::Pendulum fixed;
  const Restated pinned(fixed, [](Statement& s) { s.horizon = {1.0, 2.0}; });
  expect_same(fixed, pinned, 1e-8);
}

TEST_P(ProblemClass, MayerAndBolzaFormHaveTheSameSolution) {
  const tests::MovingFrame problem;
  const Solved bolza = solved(problem, GetParam(), 12);
  const Solved mayer = solved(problem, GetParam(), 12, CostForm::mayer);
  EXPECT_NEAR(bolza.trajectory.cost, mayer.trajectory.cost, 1e-9 * std::abs(bolza.trajectory.cost));
  EXPECT_LT((bolza.trajectory.q - mayer.trajectory.q).lpNorm<Eigen::Infinity>(), 1e-8);
  EXPECT_LT((bolza.trajectory.stage_u - mayer.trajectory.stage_u).lpNorm<Eigen::Infinity>(), 1e-7);
  EXPECT_LT((bolza.trajectory.psi_p - mayer.trajectory.psi_p).lpNorm<Eigen::Infinity>(), 1e-7);
}

TEST_P(ProblemClass, RunningCostThatIsARateEqualsItsFinalCost) {
  // ∫ d/dt (q² - ½q) dt = q(T)² - ½q(T), and Gauss integrates the polynomial q² along an interval exactly.
  if (GetParam().family != "gauss") GTEST_SKIP() << "Gauss only";
  const tests::DoubleIntegrator base;
  const auto loose = [](Statement& s) { s.last = tests::free_end(1); };
  const Restated running(base, [&](Statement& s) {
    loose(s);
    s.running_cost = [](const ControlledState& x) {
      return 0.5 * x.u[0] * x.u[0] + 2.0 * x.q[0] * x.v[0] - 0.5 * x.v[0];
    };
  });
  const Restated final(base, [&](Statement& s) {
    loose(s);
    s.final_cost = [](const State& last) { return last.q[0] * last.q[0] - 0.5 * last.q[0]; };
  });
  const Trajectory a = solved(running, GetParam(), 12).trajectory;
  const Trajectory b = solved(final, GetParam(), 12).trajectory;
  EXPECT_LT(b.cost, -1e-3);
  EXPECT_NEAR(a.cost, b.cost, 1e-11);
  EXPECT_LT((a.q - b.q).lpNorm<Eigen::Infinity>(), 1e-9);
}

TEST_P(ProblemClass, PenaltyOnTheFinalStateHasItsClosedForm) {
  // min ½∫u² + (w/2)(q(T) - 1)²: u = λ(T - t), q(T) = λT³/3, λ = w(1 - q(T)); T = 1, w = 3: q(T) = ½, J = ¾.
  const tests::DoubleIntegrator base;
  const Restated penalised(base, [](Statement& s) {
    s.last.free_configuration(0).free_velocity(0);
    s.final_cost = [](const State& last) { return 1.5 * (last.q[0] - 1.0) * (last.q[0] - 1.0); };
  });
  const auto errors = [&](Eigen::Index intervals) { return solved(penalised, GetParam(), intervals).trajectory; };
  const Trajectory coarse = errors(8);
  const Trajectory fine = errors(16);
  const bool exact = coarse.tableau.order >= 4;  // polynomials of degree 3 at the nodes
  const double error = std::abs(fine.cost - 0.75);
  EXPECT_LT(error, exact ? 1e-10 : 2e-3);
  if (!exact) {
    EXPECT_NEAR(std::log2(std::abs(coarse.cost - 0.75) / error), 2.0, 0.1);
  }
  // Transversality: ψ(T) = ∇Φ.
  EXPECT_NEAR(fine.psi_q(16, 0), 3.0 * (fine.q(16, 0) - 1.0), 1e-8);
  EXPECT_NEAR(fine.psi_p(16, 0), 0.0, 1e-8);
}

TEST_P(ProblemClass, VelocityBoundAndPathConstraintAreTheSameProblem) {
  const tests::DoubleIntegrator base;
  const Restated bounded(base, [](Statement& s) { s.v = all_between(1, -tests::infinity, 1.2); });
  const Restated constrained(
      base, [](Statement& s) { s.path_constraints = [](const ControlledState& x) { return one(1.2 - x.v[0]); }; });
  const Solved a = solved(bounded, GetParam(), 64);
  const Solved b = solved(constrained, GetParam(), 64);
  EXPECT_NEAR(a.trajectory.cost, b.trajectory.cost, 1e-8 * a.trajectory.cost);
  EXPECT_LT(a.trajectory.stage_v.maxCoeff(), 1.2 + 1e-9);
  // v rises parabolically to 1.2 in t₁ = ¾(2 - 2/1.2), stays, and falls: J = 4 · 1.2² / (3 t₁) = 7.68.
  EXPECT_NEAR(a.trajectory.cost, 7.68, 0.02);
}

TEST_P(ProblemClass, ControlBoundsHoldAtEveryStageAndCost) {
  const tests::DoubleIntegrator base;
  const Restated bounded(base, [](Statement& s) { s.u = all_between(1, -5.0, 5.0); });
  const Solved found = solved(bounded, GetParam(), 16);
  EXPECT_LT(found.trajectory.stage_u.lpNorm<Eigen::Infinity>(), 5.0 + 1e-9);
  EXPECT_GT(found.trajectory.stage_u.maxCoeff(), 5.0 - 1e-6);
  EXPECT_GT(found.trajectory.cost, 6.0);
}

TEST_P(ProblemClass, ConfigurationBoundsHoldAtEveryNode) {
  const tests::DoubleIntegrator base;
  const Restated bounded(base, [](Statement& s) {
    s.running_cost = [](const ControlledState& x) { return 0.5 * x.u[0] * x.u[0] + 200.0 * x.q[0]; };
    s.q = all_between(1, -0.02, 1.0);
  });
  const Solved found = solved(bounded, GetParam(), 16);
  EXPECT_GT(found.trajectory.q.minCoeff(), -0.02 - 1e-9);
  EXPECT_LT(found.trajectory.q.minCoeff(), -0.02 + 1e-6);
}

TEST_P(ProblemClass, ShortestTimeUnderABoundedForceIsTwo) {
  // |u| <= 1 from 0 to 1 at rest: full speed ahead for one unit of time, full brake for another.
  const tests::DoubleIntegrator base;
  const Restated fastest(base, [](Statement& s) {
    s.horizon = {0.5, 10.0};
    s.u = all_between(1, -1.0, 1.0);
    s.running_cost = [](const ControlledState&) { return Expression(0.0); };
    s.final_cost = [](const State& last) { return last.t; };
  });
  const Solved found = solved(fastest, GetParam(), 16);  // the switch lies on a node
  EXPECT_NEAR(found.trajectory.cost, 2.0, 1e-8);
  EXPECT_NEAR(found.trajectory.node_times[16], 2.0, 1e-8);
}

TEST_P(ProblemClass, PeriodicMotionHasItsClosedForm) {
  // q̈ = -4q + u, cost ½u² + ½(q - cos Ωt)² over a period, Ω = 2π/T with T = 1: q = A cos Ωt with D = (4 - Ω²)²,
  // A = 1/(1 + D), J = (T/4) D/(1 + D).
  const tests::HarmonicOscillator base;
  const double frequency = 2.0 * std::numbers::pi;
  const Restated periodic(base, [&](Statement& s) {
    s.first = tests::free_end(1);
    s.last = tests::free_end(1);
    s.conditions = [](const State& first, const State& last) {
      ExpressionVector r(2);
      r << last.q[0] - first.q[0], last.v[0] - first.v[0];
      return r;
    };
    s.running_cost = [frequency](const ControlledState& x) {
      const Expression miss = x.q[0] - cos(frequency * x.t);
      return 0.5 * x.u[0] * x.u[0] + 0.5 * miss * miss;
    };
  });
  const double d = std::pow(4.0 - frequency * frequency, 2);
  const Trajectory found = solved(periodic, GetParam(), 32).trajectory;
  EXPECT_NEAR(found.cost, 0.25 * d / (1.0 + d), found.tableau.order > 2 ? 1e-6 : 1e-3);
  EXPECT_NEAR(found.q(0, 0), found.q(32, 0), 1e-9);
  EXPECT_NEAR(found.v(0, 0), found.v(32, 0), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, ProblemClass,
                         testing::Values(Scheme{"dmoc", 1}, Scheme{"dmoc", 2}, Scheme{"dmoc", 3, "lobatto"},
                                         Scheme{"hamiltonian", 1}, Scheme{"hamiltonian", 2},
                                         Scheme{"hamiltonian", 3, "lobatto"}, Scheme{"tangent", 1},
                                         Scheme{"tangent", 2}, Scheme{"tangent", 3, "lobatto_shared"}),
                         tests::by_label);

TEST(ProblemClassCounts, FixedEndsAddNoUnknownsAndGeneralEndsAddOneVelocityEach) {
  const tests::MovingFrame fixed;
  const Restated loose(fixed, [](Statement& s) { s.last = tests::free_end(2); });
  const auto sizes = [](const Problem& problem, const std::string& method) {
    const auto program = tests::transcribe(problem, {method, 1}, Grid::uniform(8));
    return std::pair(program->variable_count(), program->constraint_count());
  };
  using Sizes = std::pair<std::size_t, std::size_t>;
  EXPECT_EQ(sizes(fixed, "dmoc"), (Sizes{2 * 9 + 2 * 8, 2 * 9}));
  EXPECT_EQ(sizes(loose, "dmoc"), (Sizes{2 * 9 + 2 * 8 + 2, 2 * 9}));
  EXPECT_EQ(sizes(loose, "hamiltonian"), (Sizes{4 * 9 + 2 * 8 + 2, 4 * 8 + 2}));
  EXPECT_EQ(sizes(loose, "tangent"), sizes(fixed, "tangent"));
}

/// What is said of the double integrator with a change.
std::string sentence(const std::function<void(Statement&)>& change) {
  const tests::DoubleIntegrator base;
  const Restated problem(base, change);
  return tests::sentence_of_error([&] { tests::transcribe(problem, {"dmoc", 1}, Grid::uniform(8)); });
}

TEST(ProblemClassRefusals, NameTheFunctionAndTheQuantity) {
  EXPECT_PRED2(tests::says, sentence([](Statement& s) { s.u = all_between(1, 2.0, 1.0); }),
               "bounds().u: entry 0 has the lower");
  EXPECT_PRED2(tests::says, sentence([](Statement& s) { s.v = all_between(2, -1.0, 1.0); }),
               "bounds().v has 2 entries");
  EXPECT_PRED2(tests::says, sentence([](Statement& s) { s.q = all_between(1, -1.0, 0.5); }),
               "bounds().last and bounds().q");
  EXPECT_PRED2(tests::says, sentence([](Statement& s) { s.horizon = {2.0, 3.0}; }), "horizon is 1");
  EXPECT_PRED2(tests::says, sentence([](Statement& s) {
                 s.horizon = {-1.0, 3.0};
               }),
               "bounds().horizon must be positive");
}

/// What an error says; "" where there is none.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

class EndsAgainstPathConstraints : public testing::Test {
 protected:
  using Path = Expression (*)(const ControlledState&);

  /// What is said of the double integrator, from rest at 0 to rest at 1 in T = 1, with h >= 0; "" if nothing is.
  static std::string said(
      Path h, const std::function<void(Statement&)>& more = [](Statement&) {}) {
    const tests::DoubleIntegrator base;
    const Restated problem(base, [&](Statement& s) {
      s.path_constraints = [h](const ControlledState& x) {
        ExpressionVector constraints(2);
        constraints << 2.0 - x.q[0], h(x);
        return constraints;
      };
      more(s);
    });
    return refusal([&] { tests::transcribe(problem, {"tangent", 1}, Grid::uniform(8)); });
  }
  static void expect_refusal(const std::string& sentence, const std::string& end, const std::string& value) {
    EXPECT_PRED2(tests::says, sentence,
                 end + " and path_constraints contradict each other: path_constraints[1] is " + value);
  }
};

TEST_F(EndsAgainstPathConstraints, AreRefusedWithTheEndAndTheAmount) {
  expect_refusal(said([](const ControlledState& x) { return x.q[0] - 0.25; }), "initial_state", "-0.25 at t = 0,");
  expect_refusal(said([](const ControlledState& x) { return 0.75 - x.q[0]; }), "final_state", "-0.25 at t = 1,");
  expect_refusal(said([](const ControlledState& x) { return x.v[0] - 0.5; }), "initial_state", "-0.5");
  expect_refusal(said([](const ControlledState& x) { return 0.5 - x.q[0] * x.t; }), "final_state", "-0.5");
}

TEST_F(EndsAgainstPathConstraints, AreNoneWhereSomethingThatIsReadIsFree) {
  EXPECT_EQ(said([](const ControlledState& x) { return x.u[0] + x.q[0] - 0.25; }), "");
  EXPECT_EQ(said([](const ControlledState& x) { return 0.5 - x.q[0] * x.t; },
                 [](Statement& s) {
                   s.horizon = {0.1, 2.0};
                 }),
            "");
  EXPECT_EQ(said([](const ControlledState& x) { return 0.5 - x.q[0] + x.v[0]; },
                 [](Statement& s) { s.last.free_velocity(0); }),
            "");
  expect_refusal(said([](const ControlledState& x) { return 0.5 - x.q[0]; },
                      [](Statement& s) {
                        s.last.free_velocity(0), s.horizon = {0.1, 2.0};
                      }),
                 "final_state", "-0.5");
}

TEST_F(EndsAgainstPathConstraints, AreNoneOnTheEdge) {
  EXPECT_EQ(said([](const ControlledState& x) { return 1.0 - x.q[0]; }), "");
  EXPECT_EQ(said([](const ControlledState& x) { return sqrt(x.q[0]); }), "");
  // 1 and 3e7 are known to twelve digits here.
  EXPECT_EQ(said([](const ControlledState& x) { return 9e14 - pow(3e7 * x.q[0], 2.0) - 1e-3; }), "");
}

TEST_F(EndsAgainstPathConstraints, AreRefusedAlsoWhenTheyAreSetLater) {
  const tests::DoubleIntegrator base;
  const Restated problem(
      base, [](Statement& s) { s.path_constraints = [](const ControlledState& x) { return one(x.q[0] + 0.5); }; });
  const auto program = tests::transcribe(problem, {"dmoc", 1}, Grid::uniform(8));
  const auto set = [&](double q) {
    return refusal([&] { program->set_initial_state(BoundaryState::at_rest(Eigen::VectorXd::Constant(1, q))); });
  };
  EXPECT_EQ(set(-0.5), "");
  EXPECT_PRED2(tests::says, set(-0.75), "path_constraints[0] is -0.25");
  EXPECT_EQ(program->bounds().first.q.lower[0], -0.5);
}

TEST(ProblemClassRefusals, NameEndsThatMoveFasterThanTheBounds) {
  const tests::DoubleIntegrator base;
  const auto sentence = [&](double velocity) {
    const Restated problem(base, [&](Statement& s) {
      s.v = all_between(1, -1.0, 2.0);
      s.first.free_velocity(0);
      s.first.v.lower[0] = velocity;
    });
    return refusal([&] { tests::transcribe(problem, {"dmoc", 1}, Grid::uniform(8)); });
  };
  EXPECT_EQ(sentence(-3.0), "");
  EXPECT_PRED2(tests::says, sentence(3.0),
               "bounds().first and bounds().v leave no value for v[0]: the lower bound 3 lies");
}

TEST(ProblemClassRefusals, PrintSmallNumbersAsTheyAre) {
  EXPECT_PRED2(tests::says, sentence([](Statement& s) { s.u = all_between(1, 1e-7, -1e-7); }),
               "the lower bound 1e-07 above the upper bound -1e-07");
  EXPECT_PRED2(tests::says, sentence([](Statement& s) { s.horizon = {1e-7, 2e-8}; }), "got 1e-07 and 2e-08");
  EXPECT_PRED2(tests::says, sentence([](Statement& s) { s.last = tests::free_end(1), s.last.q.upper[0] = 1e-7; }),
               "outside its bounds -inf and 1e-07");
}

TEST(ProblemClassRefusals, NameTheIntervalOfTheGuessWhereAFormulaFails) {
  // The guess is q = t: sqrt(q - 0.6) is not a number before t = 0.6.
  EXPECT_PRED2(tests::says, sentence([](Statement& s) {
                 s.running_cost = [](const ControlledState& x) { return sqrt(x.q[0] - 0.6) + x.u[0] * x.u[0]; };
               }),
               "at its guess in interval 0 (t = 0.0078125), running_cost is not a number; give a guess that");
  // u = 0 at the guess, where u^1.5 and its slope are 0.
  EXPECT_PRED2(tests::says, sentence([](Statement& s) {
                 s.running_cost = [](const ControlledState& x) { return pow(x.u[0], 1.5); };
               }),
               "at its guess in interval 0 (t = 0.0078125), a second derivative of running_cost is not a number");
  EXPECT_PRED2(tests::says, sentence([](Statement& s) {
                 s.path_constraints = [](const ControlledState& x) {
                   ExpressionVector h(2);
                   h << x.q[0], 2.0 + log(0.5 - x.q[0]);
                   return h;
                 };
               }),
               "in interval 4 (t = 0.507812), path_constraints[1] is not a number");
}

TEST(ProblemClassRefusals, NameASingularMass) {
  EXPECT_PRED2(tests::says, tests::sentence_of_error([] {
                 tests::transcribe(tests::SingularMass(), {"dmoc", 1}, Grid::uniform(8));
               }),
               "L_vv is singular");
}

}  // namespace
}  // namespace dmocbench
