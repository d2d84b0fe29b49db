// Problems composed of phases: what the composition has to keep of its parts.
#include "methods/mechanics/phased_problem.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/transcription/motions/phase_trajectories.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A driven mass on a spring, with an end for each number that is given.
class Sprung final : public tests::SmallProblem {
 public:
  struct Ends {
    double q, v;
    bool is_open = false;
  };
  Sprung(Ends first, Ends last, double horizon, HorizonBounds duration = {})
      : SmallProblem("sprung", at(first.q, first.v), at(last.q, last.v), horizon, 1,
                     {{"stiffness", 2.0, "", "of the spring", 0.0, 10.0}}),
        first_is_open_(first.is_open),
        last_is_open_(last.is_open),
        duration_(duration) {}
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * mass * x.v[0] * x.v[0] - 0.5 * varying("stiffness") * x.q[0] * x.q[0];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return ExpressionVector{{x.u[0] - 0.3 * x.v[0] + (with_wind ? Expression(x.t) : Expression(0.0))}};
  }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    if (most_x < infinity) return ExpressionVector{{most_x - x.q[0]}};
    return least_control > -infinity ? ExpressionVector{{x.u[0] - least_control}} : ExpressionVector();
  }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    if (first_is_open_) bounds.first.free_configuration(0).free_velocity(0);
    if (last_is_open_) bounds.last.free_configuration(0).free_velocity(0);
    if (duration_.is_free()) bounds.horizon = duration_;
    if (velocity.any()) bounds.v = velocity;
    if (last_velocity.any()) bounds.last.v = last_velocity;
    return bounds;
  }

  double mass = 1.0;
  bool with_wind = false;
  double least_control = -infinity;
  double most_x = infinity;
  Bounds velocity = Bounds::none(1);
  Bounds last_velocity = Bounds::none(1);

 private:
  bool first_is_open_;
  bool last_is_open_;
  HorizonBounds duration_;
};

/// Phases whose conditions are functions.
class Composed final : public PhasedProblem {
 public:
  using PhasedProblem::PhasedProblem;
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ExpressionVector link(std::size_t i, const PhaseEnd& before, const PhaseEnd& after) const override {
    return of_link ? of_link(before, after) : PhasedProblem::link(i, before, after);
  }
  [[nodiscard]] ExpressionVector conditions(const std::vector<PhaseEnd>& first,
                                            const std::vector<PhaseEnd>& last) const override {
    return of_ends ? of_ends(first, last) : ExpressionVector();
  }
  std::function<ExpressionVector(const PhaseEnd&, const PhaseEnd&)> of_link;
  std::function<ExpressionVector(const std::vector<PhaseEnd>&, const std::vector<PhaseEnd>&)> of_ends;
};

constexpr Sprung::Ends start{0.0, 0.0};
constexpr Sprung::Ends half_way{0.5, 1.0, true};
constexpr Sprung::Ends target{1.0, 0.5};

std::shared_ptr<Sprung> sprung(Sprung::Ends first, Sprung::Ends last, double horizon, HorizonBounds duration = {}) {
  return std::make_shared<Sprung>(first, last, horizon, duration);
}

Trajectory solved(const Problem& problem, const tests::Scheme& scheme, Eigen::Index intervals) {
  return tests::confirmed(problem, scheme, intervals, guessed_motion(problem), 1e-9).motion;
}

const std::vector<tests::Scheme> schemes{{"dmoc", 1},        {"hamiltonian", 1}, {"tangent", 1},        {"dmoc", 2},
                                         {"hamiltonian", 2}, {"tangent", 2},     {"dmoc", 3, "lobatto"}};

TEST(PhasedProblem, OfContinuousPhasesIsTheProblemOnOneGrid) {
  const Sprung whole(start, target, 1.0);
  const PhasedProblem phased({{"a", sprung(start, half_way, 0.5)}, {"b", sprung(half_way, target, 0.5)}});
  for (const tests::Scheme& scheme : schemes) {
    SCOPED_TRACE(scheme.label());
    const Trajectory one = solved(whole, scheme, 16);
    const Trajectory two = solved(phased, scheme, 8);
    EXPECT_NEAR(two.cost, one.cost, 1e-12 * one.cost);
    for (Eigen::Index k = 0; k <= 8; ++k) {
      EXPECT_NEAR(two.q(k, 0), one.q(k, 0), 1e-12);
      EXPECT_NEAR(two.q(k, 1), one.q(8 + k, 0), 1e-12);
      EXPECT_NEAR(two.p(k, 1), one.p(8 + k, 0), 1e-11);
      EXPECT_NEAR(two.psi_p(k, 0), one.psi_p(k, 0), 1e-10);
      EXPECT_NEAR(two.psi_p(k, 1), one.psi_p(8 + k, 0), 1e-10);
    }
  }
}

TEST(PhasedProblem, OfPhasesWithFreeDurationsAndGivenTotalTimeIsTheProblemOnOneGrid) {
  const Sprung whole(start, target, 1.0);
  const HorizonBounds duration{0.1, 2.0};
  Composed phased({{"a", sprung(start, half_way, 0.3, duration)}, {"b", sprung(half_way, target, 0.6, duration)}});
  phased.of_ends = [](const auto& /*first*/, const auto& last) {
    return ExpressionVector{{last[0].t - 0.4, last[1].t - 1.0}};
  };
  const Trajectory one = solved(whole, {"dmoc", 3}, 40);
  const Trajectory two = solved(phased, {"dmoc", 3}, 40);
  EXPECT_NEAR(two.cost, one.cost, 1e-11 * one.cost);
  EXPECT_NEAR(two.q(40, 0), one.q(16, 0), 1e-10);
  EXPECT_NEAR(two.p(40, 0), one.p(16, 0), 1e-9);
}

TEST(PhasedProblem, HasTheTimeOfEveryPhaseBeginAtZero) {
  auto late = sprung(start, target, 2.0);
  late->with_wind = true;
  const auto early = sprung(start, target, 1.0);
  const Composed side_by_side({{"early", early}, {"late", late}});
  const auto unlinked = [](const PhaseEnd& /*before*/, const PhaseEnd& /*after*/) { return ExpressionVector(); };
  Composed phased = side_by_side;
  phased.of_link = unlinked;
  const Trajectory both = solved(phased, {"dmoc", 2}, 8);
  const Trajectory one = solved(*early, {"dmoc", 2}, 8);
  const Trajectory other = solved(*late, {"dmoc", 2}, 8);
  EXPECT_NEAR(both.cost, one.cost + other.cost, 1e-12 * both.cost);
  EXPECT_LT((both.q.col(0) - one.q).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((both.q.col(1) - other.q).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((both.p.col(1) - other.p).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(PhasedProblem, GivesItsParametersToItsPhases) {
  PhasedProblem phased({{"a", sprung(start, half_way, 0.5)}, {"b", sprung(half_way, target, 0.5)}});
  Sprung whole(start, target, 1.0);
  const double soft = solved(phased, {"dmoc", 2}, 8).cost;
  phased.set_parameter("stiffness", 7.0);
  whole.set_parameter("stiffness", 7.0);
  const double stiff = solved(phased, {"dmoc", 2}, 8).cost;
  EXPECT_GT(std::abs(stiff - soft), 0.1);
  EXPECT_NEAR(stiff, solved(whole, {"dmoc", 2}, 16).cost, 1e-12);
  EXPECT_EQ(TracedProblem(phased).varying_parameters(), std::vector<std::string>{"stiffness"});
}

TEST(PhasedProblem, KeepsMomentumOrVelocityWhereTheMassChanges) {
  auto heavy = sprung(half_way, target, 0.5);
  heavy->mass = 2.0;
  Composed phased({{"light", sprung(start, half_way, 0.5)}, {"heavy", heavy}});
  const Trajectory by_velocity = solved(phased, {"dmoc", 1}, 8);
  EXPECT_NEAR(by_velocity.v(0, 1), by_velocity.v(8, 0), 1e-12);
  EXPECT_NEAR(by_velocity.p(0, 1), 2.0 * by_velocity.p(8, 0), 1e-12);
  phased.of_link = momentum_kept;
  const Trajectory by_momentum = solved(phased, {"dmoc", 1}, 8);
  EXPECT_NEAR(by_momentum.p(0, 1), by_momentum.p(8, 0), 1e-12);
  EXPECT_NEAR(by_momentum.v(0, 1), 0.5 * by_momentum.v(8, 0), 1e-12);
}

TEST(PhasedProblem, HoldsBoundsOfVelocitiesWhateverTheDuration) {
  const HorizonBounds duration{0.1, 2.0};
  auto slow = sprung(half_way, target, 0.5, duration);
  slow->velocity = Bounds::all(1, -infinity, 1.2);
  auto to_half_way = sprung(start, {0.5, 0.8, true}, 0.5, duration);
  to_half_way->last_velocity = Bounds::all(1, 0.2, 0.9);
  Composed phased({{"a", to_half_way}, {"b", slow}});
  phased.of_ends = [](const auto& /*first*/, const auto& last) { return ExpressionVector{{last[1].t - 1.0}}; };
  for (const tests::Scheme& scheme : schemes) {
    SCOPED_TRACE(scheme.label());
    const Trajectory motion = solved(phased, scheme, 8);
    const std::vector<std::size_t> unknowns = phased.unknowns();
    ASSERT_EQ(phased.parameters()[unknowns[1]].name, "v_a_q1_at_end");
    const double shares[] = {motion.unknowns[0] / phased.horizon(), motion.unknowns[2] / phased.horizon()};
    EXPECT_NEAR(motion.v(8, 0) / shares[0], motion.unknowns[1], 1e-11);
    EXPECT_LE(motion.v(8, 0) / shares[0], 0.9 + 1e-9);
    EXPECT_LE(motion.stage_v.col(1).maxCoeff() / shares[1], 1.2 + 1e-9);
  }
}

/// In a plane from rest to rest, slowly along the second axis.
class Plane final : public tests::SmallProblem {
 public:
  explicit Plane(double longest)
      : SmallProblem("plane", BoundaryState::at_rest(Eigen::Vector2d(0, 0)),
                     BoundaryState::at_rest(Eigen::Vector2d(1, 1)), 1.0, 2,
                     {{.name = "longest", .value = longest, .unit = "s", .meaning = "upper bound", .lower = 0.5}}) {}
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override { return {.description = "two masses"}; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.horizon = {0.5, parameter("longest")};
    bounds.v = Bounds::none(2);
    bounds.v.upper[1] = 1.2;
    return bounds;
  }
};

TEST(PhasedProblem, GivesTheMultiplierOfAVelocityToItsCoordinate) {
  Composed phased({{"a", std::make_shared<Plane>(1.0)}});
  const Trajectory motion = solved(phased, {"dmoc", 1}, 16);
  const Eigen::MatrixXd prices = phase_trajectories(phased, motion)[0].motion.prices.stage_v;
  ASSERT_EQ(prices.cols(), 2);
  EXPECT_EQ(prices.col(0).lpNorm<Eigen::Infinity>(), 0.0);
  EXPECT_GT(prices.col(1).lpNorm<Eigen::Infinity>(), 1e-3);
}

TEST(PhasedProblem, RefusesARangeOfDurationsThatFollowsAParameter) {
  Composed phased({{"a", std::make_shared<Plane>(1.0)}});
  phased.set_parameter("longest", 2.0);
  tests::expect_error_naming({"phase a", "0.5 to 1", "0.5 to 2"}, [&] { static_cast<void>(phased.bounds()); });
}

TEST(PhasedProblem, HoldsPathConstraintsAndTheirCounts) {
  auto pushed = sprung(half_way, target, 0.5);
  pushed->least_control = -1.0;
  const PhasedProblem phased({{"a", sprung(start, half_way, 0.5)}, {"b", pushed}});
  const Trajectory motion = solved(phased, {"dmoc", 2}, 8);
  EXPECT_NEAR(motion.stage_u.col(1).minCoeff(), -1.0, 1e-8);
  EXPECT_GE(motion.stage_u.col(1).minCoeff(), -1.0 - 1e-9);
}

TEST(PhasedProblem, TakesItsGuardAsPathConstraintAlsoWhereAStageIsAtTheSwitch) {
  auto below = sprung(start, half_way, 0.5);
  below->most_x = 0.45;
  Composed phased({{"a", below}, {"b", sprung(half_way, target, 0.5)}});
  phased.of_link = [](const PhaseEnd& before, const PhaseEnd& after) {
    return stacked({continuous(before, after), ExpressionVector{{0.45 - before.q[0]}}});
  };
  const double cost = solved(phased, {"dmoc", 3}, 16).cost;
  for (const char* const method : {"dmoc", "hamiltonian", "tangent"}) {
    for (const tests::Scheme& scheme : {tests::Scheme{method, 2}, {method, 2, "lobatto"}, {method, 3, "lobatto"}}) {
      const Trajectory motion = solved(phased, scheme, 16);
      EXPECT_NEAR(motion.q(16, 0), 0.45, 1e-12) << scheme.label();
      EXPECT_LE(motion.q.col(0).maxCoeff(), 0.45 + 1e-12) << scheme.label();
      EXPECT_NEAR(motion.cost, cost, 0.01 * cost) << scheme.label();
    }
  }
}

TEST(PhasedProblem, BranchesFromTheEndOfAnyPhaseBeforeIt) {
  const PhasedProblem phased({{"trunk", sprung(start, half_way, 0.5)},
                              {"left", sprung(half_way, target, 0.5)},
                              {"right", sprung(half_way, {2.0, 0.0}, 0.7), 0}});
  const Trajectory motion = solved(phased, {"dmoc", 1}, 8);
  EXPECT_NEAR(motion.q(0, 1), motion.q(8, 0), 1e-12);
  EXPECT_NEAR(motion.q(0, 2), motion.q(8, 0), 1e-12);
  EXPECT_NEAR(motion.p(0, 2), motion.p(8, 0), 1e-12);
  EXPECT_NEAR(motion.q(8, 2), 2.0, 1e-15);
}

TEST(PhasedProblem, RefusesStatementsThatCannotBeMeant) {
  const auto a = sprung(start, half_way, 0.5);
  const auto b = sprung(half_way, target, 0.5);
  using Phases = std::vector<PhasedProblem::Phase>;
  const auto expect_refused = [](std::initializer_list<std::string> parts, const Phases& phases) {
    tests::expect_error_naming(parts, [&] { static_cast<void>(TracedProblem(PhasedProblem(phases))); });
  };
  expect_refused({"at least one phase"}, {});
  expect_refused({"two phases are named a"}, {{"a", a}, {"a", b}});
  expect_refused({"phase b", "lower bound of its duration is 0", "positive"},
                 {{"a", a}, {"b", sprung(half_way, target, 0.5, {0.0, 2.0})}});
  expect_refused({"phase b", "follows phase 1"}, {{"a", a}, {"b", b, 1}});
  auto stiff = sprung(half_way, target, 0.5);
  stiff->set_parameter("stiffness", 3.0);
  expect_refused({"phase b", "stiffness"}, {{"a", a}, {"b", stiff}});
  expect_refused({"the link from a to b has 2 entries", "only 0 numbers"},
                 {{"a", sprung(start, target, 0.5)}, {"b", sprung(start, target, 0.5)}});
  const auto expect_link_refused = [&](std::initializer_list<std::string> parts, const auto& link) {
    Composed phased({{"a", a}, {"b", b}});
    phased.of_link = link;
    tests::expect_error_naming(parts, [&] { static_cast<void>(TracedProblem(phased)); });
  };
  expect_link_refused(
      {"has 1 entry", "2 numbers"},
      [](const PhaseEnd& before, const PhaseEnd& after) -> ExpressionVector { return after.q - before.q; });
  EXPECT_EQ(Composed({{"a", a}, {"b", b}}).condition_in_words(1), "the link from a to b, entry [1]");
  EXPECT_EQ(time_in_words(Composed({{"a", a}, {"b", b}}), 0.0, a->horizon()), "0 to 1 of each phase");
  expect_link_refused({"1 guard has 2 impulses"}, [](const PhaseEnd& before, const PhaseEnd& after) {
    return impact([](const ExpressionVector& q) { return q; }, 1.0, ExpressionVector{{1.0, 2.0}}, before, after);
  });
}

}  // namespace
}  // namespace dmocbench
