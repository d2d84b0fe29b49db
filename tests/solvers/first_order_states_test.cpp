// First-order states: orders at the nodes, costates, momenta of a changing mass, and what does not change without them.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "methods/diagnostics/accuracy.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/replay_error.hpp"
#include "methods/indirect/control_from_costate.hpp"
#include "methods/mechanics/first_order_problem.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "methods/transcription/start.hpp"
#include "problems/control_rate.hpp"
#include "problems/orbital_transfer_with_mass.hpp"
#include "problems/two_link_with_motors.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Answer;
using tests::Scheme;

Answer solved_tightly(const Problem& problem, const Scheme& scheme, Eigen::Index intervals, const Motion& start,
                      const std::string& solver = "interior_point") {
  return tests::confirmed(problem, scheme, intervals, start, 1e-10, solver);
}

/// Gauss with four stages, of order 8, on 512 intervals.
struct ReferenceMotion {
  explicit ReferenceMotion(std::unique_ptr<Problem> of)
      : problem(std::move(of)),
        near(smooth_motion(solved_tightly(*problem, {"tangent", 2}, 64, guessed_motion(*problem)).motion)),
        motion(solved_tightly(*problem, {"hamiltonian", 4}, 512, near).motion) {}
  std::unique_ptr<Problem> problem;
  Motion near;
  Trajectory motion;
};

const ReferenceMotion& reference_of(const std::string& name) {
  static const ReferenceMotion orbit(std::make_unique<OrbitalTransferWithMass>());
  static const ReferenceMotion arm(std::make_unique<TwoLinkWithMotors>());
  return name == "orbit" ? orbit : arm;
}

class OrdersOfFirstOrderStates : public testing::TestWithParam<std::tuple<std::string, Scheme>> {};

TEST_P(OrdersOfFirstOrderStates, AreThoseOfTheTableauAtTheNodes) {
  const auto& [name, scheme] = GetParam();
  const ReferenceMotion& reference = reference_of(name);
  const int order = scheme.tableau().order;
  // Where the errors are far above rounding, and the terms of higher order are small.
  const Eigen::Index finest = order == 2 ? 512 : order == 4 || name == "arm" ? 256 : 128;
  const auto errors = [&](Eigen::Index intervals) {
    const Trajectory motion = solved_tightly(*reference.problem, scheme, intervals, reference.near).motion;
    std::vector<double> all;
    for (const auto part :
         {&Trajectory::q, &Trajectory::p, &Trajectory::y, &Trajectory::psi_q, &Trajectory::psi_p, &Trajectory::psi_y}) {
      const Eigen::MatrixXd& exact = reference.motion.*part;
      const Eigen::MatrixXd at_nodes = exact(Eigen::seqN(0, intervals + 1, 512 / intervals), Eigen::all);
      all.push_back((motion.*part - at_nodes).lpNorm<Eigen::Infinity>());
    }
    // On the orbit errors of the cost cancel.
    if (name == "arm") all.push_back(std::abs(motion.cost - reference.motion.cost));
    return all;
  };
  const std::vector<double> coarse = errors(finest / 2);
  const std::vector<double> fine = errors(finest);
  const std::vector<std::string> names{"q", "p", "y", "psi_q", "psi_p", "psi_y", "cost"};
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const double slope = std::log2(coarse[i] / fine[i]);
    EXPECT_GT(slope, order - 0.2) << names[i] << ": errors " << coarse[i] << ", " << fine[i];
    if (names[i] == "cost") continue;  // where terms cancel, it may converge faster
    EXPECT_NEAR(slope, order, 0.2) << names[i] << ": errors " << coarse[i] << ", " << fine[i];
  }
}

/// The polynomial through the twelve nodes of a reference around t, for a table of its nodes.
class NodesAround {
 public:
  NodesAround(const Eigen::VectorXd& times, double t) {
    const auto after = std::upper_bound(times.begin(), times.end(), t) - times.begin();
    first_ = std::clamp<Eigen::Index>(after - count / 2, 0, times.size() - count);
    weights_.setOnes(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j < count; ++j) {
        if (i != j) weights_[i] *= (t - times[first_ + j]) / (times[first_ + i] - times[first_ + j]);
      }
    }
  }
  [[nodiscard]] Eigen::VectorXd of(const Eigen::MatrixXd& table) const {
    return table.middleRows(first_, count).transpose() * weights_;
  }

 private:
  static constexpr Eigen::Index count = 12;
  Eigen::Index first_;
  Eigen::VectorXd weights_;
};

// Exact controls at the stages are those of the maximum principle at the reference's state and costate there.
TEST_P(OrdersOfFirstOrderStates, AreLowerForControlsAtTheStages) {
  const auto& [name, scheme] = GetParam();
  const ReferenceMotion& reference = reference_of(name);
  const ControlFromCostate principle(*reference.problem);
  const auto error = [&](Eigen::Index intervals) {
    const Trajectory motion = solved_tightly(*reference.problem, scheme, intervals, reference.near).motion;
    double largest = 0.0;
    for (Eigen::Index row = 0; row < motion.stage_times.size(); ++row) {
      const double t = motion.stage_times[row];
      const NodesAround at(reference.motion.node_times, t);
      const Eigen::VectorXd u = motion.stage_u.row(row);
      const Eigen::VectorXd exact =
          principle.control(at.of(reference.motion.q), at.of(reference.motion.v), at.of(reference.motion.psi_p), t, u,
                            at.of(reference.motion.y), at.of(reference.motion.psi_y));
      largest = std::max(largest, (u - exact).norm());
    }
    return largest;
  };
  const int order = scheme.family == "gauss" ? scheme.stages + 1 : scheme.stages - 1;
  const Eigen::Index finest = name == "arm" ? 1024 : 128;
  const double slope = std::log2(error(finest / 2) / error(finest));
  EXPECT_GT(slope, order - 0.2);
  // On the orbit, terms of higher order are larger on all grids above rounding.
  if (name == "arm") {
    EXPECT_LT(slope, order + 0.2);
  }
}

INSTANTIATE_TEST_SUITE_P(All, OrdersOfFirstOrderStates,
                         testing::Combine(testing::Values("orbit", "arm"), testing::ValuesIn(tests::all_schemes())),
                         [](const auto& instance) {
                           const Scheme& scheme = std::get<1>(instance.param);
                           return std::get<0>(instance.param) + "_" + scheme.label();
                         });

class FirstOrderStates : public testing::TestWithParam<Scheme> {};

TEST_P(FirstOrderStates, CostOneUnknownMoreForEachPerStageOfAnInterval) {
  const TwoLinkWithMotors with;
  const TwoLinkManipulator without;
  const auto unknowns = [&](const Problem& problem, Eigen::Index intervals) {
    return static_cast<long>(tests::transcribe(problem, GetParam(), Grid::uniform(intervals))->variable_count());
  };
  const auto per_interval = [&](const Problem& problem) { return unknowns(problem, 9) - unknowns(problem, 8); };
  EXPECT_EQ(per_interval(with) - per_interval(without), 2 * GetParam().stages);
}

TEST_P(FirstOrderStates, CostatesAreTheGradientOfTheLeastCost) {
  const ReferenceMotion& reference = reference_of("orbit");
  const Answer answer = solved_tightly(*reference.problem, GetParam(), 16, reference.near);
  LegendreTransform legendre(answer.program->traced_problem());
  const MotionPoint first = answer.motion.node(0);
  const Eigen::VectorXd p = answer.motion.p.row(0).transpose();
  const auto cost_from = [&](const Eigen::VectorXd& q, const Eigen::VectorXd& momentum, double mass) {
    const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, mass);
    Transcription& program = *answer.program;
    program.set_initial_state({.q = q, .v = legendre.velocity(q, momentum, 0.0, first.v, y), .y = y});
    SolverOptions options;
    options.tolerance = 1e-11;
    const Solution solution = make_solver("interior_point", options)->solve(program, answer.solution.primal);
    EXPECT_EQ(solution.status, Status::solved) << solution.message;
    return solution.objective / program.cost_scale();
  };
  constexpr double step = 1e-4;
  const auto expect_slope = [&](double costate, const auto& cost_at) {
    const double slope =
        (8.0 * (cost_at(step) - cost_at(-step)) - (cost_at(2.0 * step) - cost_at(-2.0 * step))) / (12.0 * step);
    EXPECT_NEAR(costate, slope, 1e-5 * answer.motion.psi_p.row(0).norm());
  };
  expect_slope(answer.motion.psi_y(0, 0), [&](double e) { return cost_from(first.q, p, first.y[0] + e); });
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(2, i);
    expect_slope(answer.motion.psi_q(0, i), [&](double e) { return cost_from(first.q + e * unit, p, first.y[0]); });
    expect_slope(answer.motion.psi_p(0, i), [&](double e) { return cost_from(first.q, p + e * unit, first.y[0]); });
  }
}

TEST_P(FirstOrderStates, FreeOnesHaveNoCostateAtTheEnd) {
  const ReferenceMotion& reference = reference_of("arm");
  const Trajectory motion = solved_tightly(*reference.problem, GetParam(), 16, reference.near).motion;
  EXPECT_LT(motion.psi_y.bottomRows(1).norm(), 1e-7 * motion.psi_y.norm());
}

TEST_P(FirstOrderStates, MomentaOfAChangingMassAreTheWorkOfTheForces) {
  const ReferenceMotion& reference = reference_of("orbit");
  const Trajectory motion = solved_tightly(*reference.problem, GetParam(), 32, reference.near).motion;
  EXPECT_LT(motion.y(32, 0), 0.9);
  const MomentumConsistency consistency = momentum_consistency(*reference.problem, motion);
  if (GetParam().method != "tangent") {
    EXPECT_LT(consistency.largest, 1e-12);
  } else if (GetParam().tableau().order == 2) {
    EXPECT_GT(consistency.largest, 1e-9);
  }
}

TEST_P(FirstOrderStates, ReplayOfTheControlsLeadsToTheEnd) {
  const ReferenceMotion& reference = reference_of("arm");
  const auto missed = [&](Eigen::Index intervals) {
    const Trajectory motion = solved_tightly(*reference.problem, GetParam(), intervals, reference.near).motion;
    EXPECT_NEAR(replay_error(*reference.problem, motion).cost, motion.cost, 0.1 * motion.cost);
    return replay_error(*reference.problem, motion).norm();
  };
  const double coarse = missed(32);
  EXPECT_LT(missed(64), 0.5 * coarse);
}

TEST_P(FirstOrderStates, EveryIntervalLeadsToTheNextNode) {
  const ReferenceMotion& reference = reference_of("orbit");
  const Trajectory motion = solved_tightly(*reference.problem, GetParam(), 32, reference.near).motion;
  EXPECT_LT(accuracy(*reference.problem, motion).relative_jump, 0.02);
  Trajectory heavier = motion;
  heavier.y(16, 0) += 0.05;
  EXPECT_GT(accuracy(*reference.problem, heavier).relative_jump, 0.1);
}

TEST_P(FirstOrderStates, MassThatStaysMakesTheProblemOfThePaper) {
  OrbitalTransferWithMass with;
  with.set_parameter("inverse_power", 0.0);
  const OrbitalTransfer without;
  const Motion start = guessed_motion(without);
  const Trajectory a = solved_tightly(with, GetParam(), 32, guessed_motion(with)).motion;
  const Trajectory b = solved_tightly(without, GetParam(), 32, start).motion;
  EXPECT_NEAR(a.cost, b.cost, 1e-9 * b.cost);
  EXPECT_LT((a.q - b.q).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_LT((a.psi_p - b.psi_p).lpNorm<Eigen::Infinity>(), 1e-6 * b.psi_p.lpNorm<Eigen::Infinity>());
}

TEST_P(FirstOrderStates, BoundedRateOfAForceHasItsClosedForm) {
  if (GetParam().family == "lobatto" && GetParam().stages == 3) {
    GTEST_SKIP() << "the cost reads no control, and three Lobatto stages leave it all but undetermined";
  }
  const ControlRate problem;
  for (const std::string solver : {"ipopt", "interior_point"}) {
    const Trajectory motion = solved_tightly(problem, GetParam(), 64, guessed_motion(problem), solver).motion;
    EXPECT_NEAR(motion.cost, 24.0 / 13.0, 3e-3);
    EXPECT_LT(motion.stage_u.lpNorm<Eigen::Infinity>(), 4.0 + 1e-8);
    // At t = 1, where no bound acts.
    EXPECT_NEAR(motion.y(32, 0), 1.5 - 348.0 / 169.0 * 0.625, 0.01);
  }
}

TEST_P(FirstOrderStates, BoundsOnThemHoldAtEveryNode) {
  class Limited final : public tests::SmallProblem {
   public:
    Limited() : SmallProblem("limited", at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0), 1.0, 1) {}
    [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"force"}; }
    [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override { return x.u; }
    [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.y; }
    [[nodiscard]] ProblemBounds bounds() const override {
      ProblemBounds bounds = Problem::bounds();
      bounds.y = Bounds::all(1, -5.0, 5.0);
      return bounds;
    }
  };
  const Limited problem;
  for (const std::string solver : {"ipopt", "interior_point"}) {
    const Trajectory motion = solved_tightly(problem, GetParam(), 32, guessed_motion(problem), solver).motion;
    EXPECT_NEAR(motion.y.maxCoeff(), 5.0, 1e-6);
    EXPECT_NEAR(motion.y.minCoeff(), -5.0, 1e-6);
  }
}

TEST_P(FirstOrderStates, BothInteriorPointMethodsAgreeOnCoarseAndFineGrids) {
  const ReferenceMotion& reference = reference_of("arm");
  for (const Eigen::Index intervals : {64, 1024}) {
    if (intervals > 64 && GetParam().stages > 2) continue;
    const Answer by_intervals = solved_tightly(*reference.problem, GetParam(), intervals, reference.near);
    const Answer by_ipopt = solved_tightly(*reference.problem, GetParam(), intervals, reference.near, "ipopt");
    EXPECT_NEAR(by_intervals.motion.cost, by_ipopt.motion.cost, 1e-8 * by_ipopt.motion.cost);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FirstOrderStates, testing::ValuesIn(tests::all_schemes()), tests::by_label);

class EqualFirstOrderStates : public testing::TestWithParam<std::tuple<std::string, int>> {};

TEST_P(EqualFirstOrderStates, SolutionOfDmocSolvesTheProgramOfHamiltonianCollocation) {
  const auto& [family, stages] = GetParam();
  for (const std::string name : {"orbit", "arm"}) {
    const ReferenceMotion& reference = reference_of(name);
    const Trajectory motion = solved_tightly(*reference.problem, {"dmoc", stages, family}, 32, reference.near).motion;
    const auto other = tests::transcribe(*reference.problem, {"hamiltonian", stages, family}, Grid::uniform(32));
    EXPECT_LT(tests::row_residual(*other, embed(*reference.problem, *other, motion)), 1e-9) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EqualFirstOrderStates,
                         testing::Values(std::tuple("gauss", 1), std::tuple("gauss", 2), std::tuple("gauss", 3),
                                         std::tuple("lobatto", 2), std::tuple("lobatto", 3)),
                         [](const auto& instance) {
                           return std::get<0>(instance.param) + std::to_string(std::get<1>(instance.param));
                         });

TEST(FirstOrderStatesRefused, ByShooting) {
  const TwoLinkWithMotors problem;
  for (const int stages : {1, 2, 3}) {
    EXPECT_EQ(tests::sentence_of_error([&] {
                static_cast<void>(tests::transcribe(problem, {"multiple_shooting_rk4_1", stages}, Grid::uniform(8)));
              }),
              "this method does not support first-order states (Problem::first_order_names); choose dmoc, "
              "hamiltonian, tangent or galerkin");
  }
}

/// ẏ = u from 1 to the end, C = y² + u².
class Decay final : public FirstOrderProblem {
 public:
  Decay(double from, double to, double horizon, bool starts_open = false)
      : from_(from), to_(to), horizon_(horizon), starts_open_(starts_open) {}
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"x"}; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return x.y[0] * x.y[0] + x.u[0] * x.u[0];
  }
  [[nodiscard]] BoundaryState initial_state() const override { return at(Eigen::VectorXd::Constant(1, from_)); }
  [[nodiscard]] BoundaryState final_state() const override { return at(Eigen::VectorXd::Constant(1, to_)); }
  [[nodiscard]] double horizon() const override { return horizon_; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = FirstOrderProblem::bounds();
    if (starts_open_) bounds.first.free_first_order(0);
    return bounds;
  }
  [[nodiscard]] double optimum() const {
    return (from_ * from_ + to_ * to_) / std::tanh(horizon_) - 2.0 * from_ * to_ / std::sinh(horizon_);
  }

 private:
  double from_;
  double to_;
  double horizon_;
  bool starts_open_;
};

TEST(FirstOrderStatesAlone, HaveTheSameSolutionByAllMethods) {
  const Decay decay(1.0, 0.75, 1.0);
  for (const int stages : {1, 2}) {
    const Trajectory dmoc = solved_tightly(decay, {"dmoc", stages}, 16, guessed_motion(decay)).motion;
    const Trajectory fine = solved_tightly(decay, {"dmoc", stages}, 32, guessed_motion(decay)).motion;
    EXPECT_NEAR(std::log2((dmoc.cost - decay.optimum()) / (fine.cost - decay.optimum())), 2.0 * stages, 0.1);
    EXPECT_EQ(dmoc.q.cwiseAbs().maxCoeff(), 0.0);
    for (const char* const method : {"hamiltonian", "tangent"}) {
      const Trajectory other = solved_tightly(decay, {method, stages}, 16, guessed_motion(decay)).motion;
      EXPECT_LT((other.y - dmoc.y).cwiseAbs().maxCoeff(), 1e-14) << method;
      EXPECT_LT((other.stage_u - dmoc.stage_u).cwiseAbs().maxCoeff(), 1e-12) << method;
      EXPECT_LT((other.psi_y - dmoc.psi_y).cwiseAbs().maxCoeff(), 1e-12) << method;
    }
  }
}

TEST(FirstOrderStatesAlone, MayHavePhases) {
  const Decay first(1.0, 0.9, 0.75);
  const Decay second(0.9, 0.75, 0.25, true);
  const PhasedProblem both({{"first", std::make_shared<Decay>(first)}, {"second", std::make_shared<Decay>(second)}});
  const Trajectory motion = solved_tightly(both, {"dmoc", 3}, 32, guessed_motion(both)).motion;
  EXPECT_NEAR(motion.cost, first.optimum() + second.optimum(), 1e-12);
  EXPECT_LT(replay_error(both, motion).norm(), 1e-7);
}

TEST(FirstOrderStatesRefused, WithRatesOfAnotherSize) {
  class Short final : public tests::SmallProblem {
   public:
    Short() : SmallProblem("short", of_two(), of_two(), 1.0, 1) {}
    [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"a", "b"}; }
    [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override { return x.u; }

   private:
    static BoundaryState of_two() {
      return {Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(2)};
    }
  };
  EXPECT_EQ(tests::sentence_of_error([] {
              static_cast<void>(tests::transcribe(Short(), {"dmoc", 1}, Grid::uniform(8)));
            }),
            "short: first_order_rates has 1 entry, expected 2");
}

}  // namespace
}  // namespace dmocbench
