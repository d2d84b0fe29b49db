#include "methods/kkt/refined_kkt.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "methods/kkt/sparse_kkt.hpp"
#include "tests/support/system_choice.hpp"

namespace dmocbench::kkt {
namespace {

using tests::DenseKkt;
using tests::KktNumbers;
using tests::RandomPoints;
using tests::RandomShape;
using tests::RandomStructuredProgram;
using tests::SystemChoice;

/// The sparse factorisation, with what it finds spoilt.
class SpoiltKkt final : public KktSystem {
 public:
  using Spoil = std::function<FactorisationStatus(FactorisationStatus, Eigen::VectorXd& primal_step,
                                                  Eigen::VectorXd& multiplier_step)>;
  SpoiltKkt(const NonlinearProgram& program, Spoil spoil, int& solves)
      : exact_(program, SparseKkt::Order::along_the_horizon), spoil_(std::move(spoil)), solves_(solves) {}

  [[nodiscard]] FactorisationStatus solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                          const KktStep& step) override {
    ++solves_;
    const FactorisationStatus verdict = exact_.solve(matrix, right_hand_side, step);
    return spoil_(verdict, step.primal, step.multipliers);
  }

 private:
  SparseKkt exact_;
  Spoil spoil_;
  int& solves_;
};

/// A system with a minimum, of a program with rows of intervals, inequalities, a free horizon and fixed ends.
struct System {
  explicit System(unsigned seed, RandomShape::Hessian hessian = RandomShape::Hessian::definite)
      : program(shape_with(hessian), seed), numbers(SystemChoice(seed).numbers(program, hessian)) {}

  static RandomShape shape_with(RandomShape::Hessian hessian) {
    RandomShape shape;
    shape.intervals = 12;
    shape.node = 2;
    shape.rows_at_nodes = true;
    shape.inequalities = 1;
    shape.horizon = true;
    shape.fixed = {2, 1};
    shape.coupling = 0.2;
    shape.hessian = hessian;
    return shape;
  }

  RandomStructuredProgram program;
  KktNumbers numbers;
};

struct Found {
  FactorisationStatus verdict = FactorisationStatus::untrusted;
  double error = 0.0;  // relative to the exact step
  double error_of_sparse = 0.0;
  int solves = 0;  // by the spoilt factorisation
  int refinements = 0;
  int fallbacks = 0;
};

Found found_with(System& system, const SpoiltKkt::Spoil& spoil, double accuracy) {
  Found found;
  const KktNumbers& numbers = system.numbers;
  RefinedKkt kkt(system.program, std::make_unique<SpoiltKkt>(system.program, spoil, found.solves), accuracy);
  const DenseKkt dense(system.program, numbers);
  const Eigen::VectorXd wanted = dense.solution();
  const auto error_of = [&](KktSystem& any, FactorisationStatus& verdict) {
    Eigen::VectorXd primal(numbers.gradient.size());
    Eigen::VectorXd multipliers(numbers.rows.size());
    verdict = any.solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers});
    Eigen::VectorXd steps(wanted.size());
    steps << primal, multipliers;
    return (steps - wanted).lpNorm<Eigen::Infinity>() / wanted.lpNorm<Eigen::Infinity>();
  };
  found.error = error_of(kkt, found.verdict);
  SparseKkt sparse(system.program, SparseKkt::Order::along_the_horizon);  // as it falls back to
  FactorisationStatus of_sparse{};
  found.error_of_sparse = error_of(sparse, of_sparse);
  found.refinements = kkt.refinements();
  found.fallbacks = kkt.fallbacks();
  return found;
}

FactorisationStatus untouched(FactorisationStatus verdict, Eigen::VectorXd& /*primal*/,
                              Eigen::VectorXd& /*multipliers*/) {
  return verdict;
}

TEST(RefinedKkt, LeavesAnExactStepAlone) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    System system(seed);
    const Found found = found_with(system, untouched, 1e-10);
    EXPECT_EQ(found.verdict, FactorisationStatus::solved);
    EXPECT_EQ(found.error, found.error_of_sparse);
    EXPECT_EQ(found.refinements, 0);
    EXPECT_EQ(found.fallbacks, 0);
  }
}

TEST(RefinedKkt, MakesInaccurateStepsAsGoodAsThoseOfTheSparseFactorisationInAFewRefinements) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    System system(seed);
    RandomPoints random(seed);
    const auto spoil = [&](FactorisationStatus verdict, Eigen::VectorXd& primal, Eigen::VectorXd& multipliers) {
      primal.array() *= 1.0 + random.vector(primal.size(), -1e-3, 1e-3).array();
      multipliers.array() *= 1.0 + random.vector(multipliers.size(), -1e-3, 1e-3).array();
      return verdict;
    };
    const Found found = found_with(system, spoil, 1e-13);
    EXPECT_EQ(found.verdict, FactorisationStatus::solved);
    EXPECT_LE(found.error, found.error_of_sparse);
    EXPECT_GE(found.refinements, 2);
    EXPECT_LE(found.refinements, 5);
    EXPECT_EQ(found.fallbacks, 0);
  }
}

TEST(RefinedKkt, FallsBackToTheSparseFactorisationWhereRefinementDoesNotHelp) {
  const auto doubled = [](FactorisationStatus verdict, Eigen::VectorXd& primal, Eigen::VectorXd& multipliers) {
    primal *= 2.0;
    multipliers *= 2.0;
    return verdict;
  };
  const auto infinite = [](FactorisationStatus verdict, Eigen::VectorXd& primal, Eigen::VectorXd& /*multipliers*/) {
    primal[primal.size() / 2] = std::numeric_limits<double>::infinity();
    return verdict;
  };
  for (const SpoiltKkt::Spoil& spoil : {SpoiltKkt::Spoil(doubled), SpoiltKkt::Spoil(infinite)}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      System system(seed);
      const Found found = found_with(system, spoil, 1e-6);
      EXPECT_EQ(found.verdict, FactorisationStatus::solved);
      EXPECT_EQ(found.fallbacks, 1);
      EXPECT_EQ(found.error, found.error_of_sparse);
      EXPECT_LE(found.solves, 3) << "it should have given up";
    }
  }
}

/// A correction that makes things worse is taken back.
TEST(RefinedKkt, KeepsTheBestStep) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    System system(seed);
    int solves = 0;
    const auto spoil = [&](FactorisationStatus verdict, Eigen::VectorXd& primal, Eigen::VectorXd& multipliers) {
      const double factor = solves++ == 0 ? 1.0 + 1e-5 : 100.0;
      primal *= factor;
      multipliers *= factor;
      return verdict;
    };
    const Found found = found_with(system, spoil, 1e-6);  // good enough not to fall back
    EXPECT_EQ(found.verdict, FactorisationStatus::solved);
    EXPECT_EQ(found.refinements, 1);
    EXPECT_EQ(found.fallbacks, 0);
    EXPECT_NEAR(found.error, 1e-5, 1e-9);
  }
}

TEST(RefinedKkt, FallsBackWhereTheFastWayTrustsItselfNoMoreOrFindsDependentRows) {
  for (const FactorisationStatus reported : {FactorisationStatus::untrusted, FactorisationStatus::singular}) {
    System system(1);
    const auto spoil = [&](FactorisationStatus /*verdict*/, Eigen::VectorXd& primal, Eigen::VectorXd& /*multipliers*/) {
      primal.setConstant(std::numeric_limits<double>::quiet_NaN());
      return reported;
    };
    const Found found = found_with(system, spoil, 1e-6);
    EXPECT_EQ(found.verdict, FactorisationStatus::solved);
    EXPECT_EQ(found.fallbacks, 1);
    EXPECT_EQ(found.refinements, 0);
    EXPECT_EQ(found.error, found.error_of_sparse);
  }
}

TEST(RefinedKkt, BelievesAWrongInertia) {
  System system(1);
  const auto spoil = [](FactorisationStatus, Eigen::VectorXd&, Eigen::VectorXd&) {
    return FactorisationStatus::wrong_inertia;
  };
  const Found found = found_with(system, spoil, 1e-6);
  EXPECT_EQ(found.verdict, FactorisationStatus::wrong_inertia);
  EXPECT_EQ(found.fallbacks, 0);
  EXPECT_EQ(found.refinements, 0);
  EXPECT_EQ(found.solves, 1);
}

/// As Newton's method asks: each matrix is refused at first, and solved with a shift.
TEST(RefinedKkt, ChecksTheRefusalsOfMatrixAfterMatrixAndBelievesNoneOnceOneWasWrong) {
  System system(1);
  const KktNumbers& numbers = system.numbers;
  bool refuses = true;
  int solves = 0;
  const auto spoil = [&](FactorisationStatus verdict, Eigen::VectorXd&, Eigen::VectorXd&) {
    return refuses ? FactorisationStatus::wrong_inertia : verdict;
  };
  RefinedKkt kkt(system.program, std::make_unique<SpoiltKkt>(system.program, spoil, solves));
  Eigen::VectorXd primal(numbers.gradient.size());
  Eigen::VectorXd multipliers(numbers.rows.size());
  const auto solve = [&](bool is_refused) {
    refuses = is_refused;
    return kkt.solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers});
  };
  for (int matrix = 0; matrix < 32; ++matrix) {
    EXPECT_EQ(solve(true), FactorisationStatus::wrong_inertia) << matrix;
    EXPECT_EQ(solve(false), FactorisationStatus::solved) << matrix;
  }
  EXPECT_EQ(kkt.fallbacks(), 0);
  for (int matrix = 0; matrix < 20; ++matrix) EXPECT_EQ(solve(true), FactorisationStatus::solved) << matrix;
  EXPECT_EQ(kkt.fallbacks(), 20);
  kkt.begin_solve();
  EXPECT_EQ(solve(true), FactorisationStatus::wrong_inertia) << "it remembers another solve";
}

/// Rounding may hide it from the pivots of the sparse factorisation, which then solves these systems with multipliers
/// of 1e15 and more, that leave of the right-hand side as much as no step.
TEST(RefinedKkt, RefusesRowsThatDependOnEachOtherWhereTheSparseFactorisationDoesNot) {
  int missed_by_sparse = 0;
  for (const unsigned seed : {234U, 444U, 537U, 893U, 1014U, 1052U, 1207U, 1243U, 1268U, 1507U, 1721U, 1923U}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SystemChoice choice(seed);
    const RandomShape shape = choice.shape();
    RandomStructuredProgram program(shape, seed);
    const KktNumbers numbers = choice.numbers(program, shape.hessian);
    ASSERT_LT(DenseKkt(program, numbers).inertia().rank, 1e-15);
    const auto verdict_of = [&](KktSystem& kkt) {
      Eigen::VectorXd primal(numbers.gradient.size());
      Eigen::VectorXd multipliers(numbers.rows.size());
      return kkt.solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers});
    };
    for (const auto order : {SparseKkt::Order::found, SparseKkt::Order::along_the_horizon}) {
      SparseKkt sparse(program, order);
      if (verdict_of(sparse) == FactorisationStatus::solved) ++missed_by_sparse;
      RefinedKkt refined(program, std::make_unique<SparseKkt>(program, order));
      const FactorisationStatus verdict = verdict_of(refined);
      EXPECT_TRUE(verdict == FactorisationStatus::singular || verdict == FactorisationStatus::wrong_inertia);
    }
  }
  EXPECT_GT(missed_by_sparse, 0) << "this test shows nothing";
}

TEST(RefinedKkt, FindsTheWrongInertiaOfTheSparseFactorisationThatItFallsBackTo) {
  System system(1);
  system.numbers.diagonal.setConstant(-1e3);
  const auto spoil = [](FactorisationStatus, Eigen::VectorXd&, Eigen::VectorXd&) {
    return FactorisationStatus::untrusted;
  };
  const Found found = found_with(system, spoil, 1e-6);
  EXPECT_EQ(found.verdict, FactorisationStatus::wrong_inertia);
  EXPECT_EQ(found.fallbacks, 1);
}

}  // namespace
}  // namespace dmocbench::kkt
