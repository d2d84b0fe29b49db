#include "bench/experiments/banded_kkt.hpp"

#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "problems/brachistochrone.hpp"
#include "problems/orbital_transfer.hpp"
#include "problems/two_link_manipulator.hpp"
#include "tests/support/dense_kkt.hpp"
#include "tests/support/random_structured_program.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/system_choice.hpp"

namespace dmocbench::kkt {
namespace {

using tests::DenseKkt;
using tests::KktNumbers;
using tests::RandomShape;
using tests::RandomStructuredProgram;
using tests::SystemChoice;

/// A program of every kind of place, unknown and row, one after the other as the seed counts.
RandomShape shape_of(unsigned seed) {
  const auto turn = [seed](unsigned every) { return seed % every; };
  RandomShape shape;
  shape.intervals = 2 + turn(17);
  shape.node = 1 + turn(3);
  shape.rows_at_nodes = turn(2) == 0;
  shape.rates = turn(5) < 3 ? 0 : 2;
  shape.controls = 1 + turn(2);
  shape.inequalities = turn(4) == 3 ? 2 : 0;
  shape.horizon = turn(3) == 1;
  shape.velocity[0] = turn(7) == 2;
  shape.velocity[1] = turn(5) == 2;
  shape.fixed = {shape.node, turn(6) == 1 ? 0 : shape.node};
  shape.conditions = turn(4) <= 1 ? 1 : 0;
  shape.roughness = 0.1;
  shape.coupling = 0.5;
  return shape;
}

TEST(BandedKkt, SolvesRandomSystemsLikeDenseLinearAlgebra) {
  int solved = 0;
  int with_border = 0;
  int untrusted = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    const RandomShape shape = shape_of(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + shape.label());
    RandomStructuredProgram program(shape, seed);
    const KktNumbers numbers = SystemChoice(seed).numbers(program, shape.hessian);
    const DenseKkt dense(program, numbers);
    const DenseKkt::Inertia inertia = dense.inertia();
    if (!(inertia.rank > 1e-9) || !(inertia.smallest > 1e-9 * inertia.largest)) continue;
    BandedKkt kkt(program);
    Eigen::VectorXd primal(numbers.gradient.size());
    Eigen::VectorXd multipliers(numbers.rows.size());
    const FactorisationStatus verdict =
        kkt.solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers});
    // A band that is singular without its border: too few unknowns for its rows.
    if (verdict == FactorisationStatus::untrusted && kkt.order().border_size > 0) {
      ++untrusted;
      continue;
    }
    ASSERT_EQ(verdict, FactorisationStatus::solved);
    EXPECT_LT(dense.backward_error(primal, multipliers), 1e-13);
    Eigen::VectorXd found(primal.size() + multipliers.size());
    found << primal, multipliers;
    const Eigen::VectorXd wanted = dense.solution();
    EXPECT_LT((found - wanted).lpNorm<Eigen::Infinity>(), 1e-8 * wanted.lpNorm<Eigen::Infinity>());
    ++solved;
    if (kkt.order().border_size > 0) ++with_border;
  }
  EXPECT_GT(solved, 250);
  EXPECT_GT(with_border, 50);
  EXPECT_LE(untrusted, 2);
}

/// Without rows every direction is one along which the rows do not change.
TEST(BandedKkt, SeesCurvatureDownwardsWhereTheSlopePointsThere) {
  RandomShape shape;
  shape.intervals = 8;
  RandomStructuredProgram program(shape, 1);
  KktNumbers numbers = SystemChoice(1).numbers(program, shape.hessian);
  BandedKkt kkt(program);
  Eigen::VectorXd primal(numbers.gradient.size());
  Eigen::VectorXd multipliers(numbers.rows.size());
  numbers.diagonal.setConstant(-1e3);
  EXPECT_EQ(kkt.solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers}),
            FactorisationStatus::wrong_inertia);
  numbers.diagonal.setConstant(1e3);
  EXPECT_EQ(kkt.solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers}),
            FactorisationStatus::solved);
}

/// The bandwidth of one-stage methods: rows and unknowns of two nodes and of the interval between them.
TEST(BandedKkt, FindsTheBandwidth) {
  const OrbitalTransfer orbit;
  const TwoLinkManipulator two_link;
  const auto half_bandwidth = [](const Problem& problem, const std::string& method) {
    const auto program = tests::transcribe(problem, {method}, Grid::uniform(12));
    return node_order(*program).half_bandwidth;
  };
  EXPECT_EQ(half_bandwidth(orbit, "dmoc"), 8U);
  EXPECT_EQ(half_bandwidth(orbit, "hamiltonian"), 10U);
  EXPECT_EQ(half_bandwidth(two_link, "dmoc"), 9U);
  EXPECT_EQ(half_bandwidth(two_link, "hamiltonian"), 11U);
}

TEST(BandedKkt, CountsTheOperationsOfAFactorisation) {
  const OrbitalTransfer orbit;
  constexpr int intervals = 64;
  const auto program = tests::transcribe(orbit, {"dmoc"}, Grid::uniform(intervals));
  BandedKkt kkt(*program);
  const auto n = static_cast<Eigen::Index>(program->variable_count());
  const auto m = static_cast<Eigen::Index>(program->constraint_count());
  KktNumbers numbers;
  numbers.hessian.setZero(static_cast<Eigen::Index>(program->hessian_structure().size()));
  numbers.jacobian.resize(static_cast<Eigen::Index>(program->jacobian_structure().size()));
  program->jacobian(sample(*program, tests::common_start(orbit)), numbers.jacobian);
  numbers.diagonal.setOnes(n);
  numbers.compliance.setZero(m);
  numbers.gradient.setOnes(n);
  numbers.rows.setOnes(m);
  ASSERT_EQ(kkt.solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {numbers.gradient, numbers.rows}),
            FactorisationStatus::solved);
  const auto lines = static_cast<double>(n + m);
  const auto width = static_cast<double>(kkt.order().half_bandwidth);
  EXPECT_GT(kkt.factorisation_operations(), 0.9 * lines * width * width);
  EXPECT_LT(kkt.factorisation_operations(), lines * width * (2.0 * width + 1.0));
}

Solution solve_banded(NonlinearProgram& program, const Eigen::VectorXd& start) {
  InteriorPointOptions choices;
  choices.make_kkt_system = [](NonlinearProgram& of) { return std::make_unique<BandedKkt>(of); };
  return InteriorPointSolver({}, choices).solve(program, start);
}

void expect_agreement_with_ipopt(const Problem& problem, Eigen::Index intervals, const Motion& motion,
                                 int most_stages = 2) {
  for (const tests::Scheme& scheme : tests::schemes_of({"gauss"}, most_stages)) {
    SCOPED_TRACE(problem.name() + ", " + scheme.label() + ", N = " + std::to_string(intervals));
    const auto program = tests::transcribe(problem, scheme, Grid::uniform(intervals));
    const Eigen::VectorXd start = sample(*program, motion);
    const Solution ipopt = make_solver("ipopt")->solve(*program, start);
    const Solution banded = solve_banded(*program, start);
    ASSERT_EQ(ipopt.status, Status::solved) << ipopt.message;
    ASSERT_EQ(banded.status, Status::solved) << banded.message;
    EXPECT_NEAR(banded.objective, ipopt.objective, 1e-9 * std::abs(ipopt.objective));
  }
}

TEST(BandedKkt, SolvesThePapersProblemsAsIpoptDoes) {
  const OrbitalTransfer orbit;
  const TwoLinkManipulator two_link;
  for (const Eigen::Index intervals : {24, 64}) {
    expect_agreement_with_ipopt(orbit, intervals, tests::common_start(orbit));
    expect_agreement_with_ipopt(two_link, intervals, tests::common_start(two_link));
  }
}

/// Minimum time: the KKT matrix without the horizon's line is singular at the solution.
TEST(BandedKkt, SolvesAProblemOfMinimumTime) {
  const Brachistochrone problem;
  expect_agreement_with_ipopt(problem, 16, guessed_motion(problem), 1);
}

TEST(BandedKkt, SolvesEverythingAtOnce) {
  const tests::Everything everything;
  expect_agreement_with_ipopt(everything.problem(), 12, guessed_motion(everything.problem()));
}

TEST(BandedKkt, RefusesAProgramWithoutIntervalsInASentence) {
  tests::SmallProgram program = tests::rosenbrock();
  const std::string sentence = tests::sentence_of_error([&] {
    return solve_banded(program, tests::vector({-1.2, 1.0}));
  });
  EXPECT_NE(sentence.find("interval structure"), std::string::npos) << sentence;
}

}  // namespace
}  // namespace dmocbench::kkt
