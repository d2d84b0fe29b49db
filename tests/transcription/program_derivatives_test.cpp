// The assembled program's derivatives against hyper-dual numbers: the interval's formulas replayed on a scalar that
// differentiates itself, scattered into dense matrices here. A missing or doubled merged entry at a node shows at once.

#include <set>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "methods/expression/replay.hpp"
#include "methods/transcription/elements/families.hpp"
#include "tests/support/hyper_dual.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::HyperDual;
using tests::problem_named;
using tests::RandomPoints;
using tests::Scheme;

struct Derivatives {
  Eigen::VectorXd gradient;
  Eigen::VectorXd rows;
  Eigen::MatrixXd jacobian;
  Eigen::MatrixXd hessian;
};

/// A point near the guess, where both problems are regular (r > 0).
Eigen::VectorXd point_near_guess(const Problem& problem, Transcription& program) {
  RandomPoints random;
  Eigen::VectorXd x = sample(program, guessed_motion(problem));
  return x + random.vector(x.size(), -0.2, 0.2);
}

/// Everything at once, dense, by hyper-dual numbers: both directions run over all pairs of local unknowns.
Derivatives by_hyper_duals(const Transcription& program, const Eigen::VectorXd& x, double factor,
                           const Eigen::VectorXd& multipliers) {
  const IntervalFunctions& functions = program.functions();
  const LocalInputs& numbers = functions.inputs;
  const ProgramBlocks& blocks = program.blocks();
  Derivatives dense;
  dense.gradient.setZero(x.size());
  dense.rows.setZero(multipliers.size());
  dense.jacobian.setZero(multipliers.size(), x.size());
  dense.hessian.setZero(x.size(), x.size());
  for (std::size_t k = 0; k < blocks.intervals(); ++k) {
    const auto interval = static_cast<Eigen::Index>(k);
    const auto unknown = [&](std::size_t a) { return static_cast<Eigen::Index>(blocks.unknown_places()[a].at(k)); };
    const auto row = [&](std::size_t e) {
      return static_cast<Eigen::Index>(blocks.row_places()[functions.rows.places[e]].at(k));
    };
    std::vector<HyperDual> inputs(numbers.count());
    for (std::size_t a = 0; a < numbers.unknowns; ++a) inputs[a] = x[unknown(a)];
    inputs[numbers.step()] = program.step_inputs()[interval];
    inputs[numbers.time()] = program.time_inputs()[interval];
    for (std::size_t a = 0; a < numbers.unknowns; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        inputs[a].e1 = 1.0;
        inputs[b].e2 = 1.0;
        const std::span<const HyperDual> point(inputs);
        const HyperDual cost = replay<HyperDual>(functions.cost, point)[0];
        const std::vector<HyperDual> rows = replay<HyperDual>(functions.rows.schedule, point);
        inputs[a].e1 = 0.0;
        inputs[b].e2 = 0.0;
        double second = factor * cost.e12;
        for (std::size_t e = 0; e < rows.size(); ++e) second += multipliers[row(e)] * rows[e].e12;
        dense.hessian(unknown(a), unknown(b)) += second;
        if (a != b) dense.hessian(unknown(b), unknown(a)) += second;
        if (b != 0) continue;
        dense.gradient[unknown(a)] += cost.e1;
        for (std::size_t e = 0; e < rows.size(); ++e) {
          dense.jacobian(row(e), unknown(a)) += rows[e].e1;
          if (a == 0) dense.rows[row(e)] += rows[e].x;
        }
      }
    }
  }
  return dense;
}

Eigen::MatrixXd dense(const SparsityPattern& pattern, const Eigen::VectorXd& values, Eigen::Index rows,
                      Eigen::Index columns) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, columns);
  for (std::size_t e = 0; e < pattern.size(); ++e) {
    matrix(pattern.rows[e], pattern.columns[e]) += values[static_cast<Eigen::Index>(e)];
  }
  return matrix;
}

/// Largest difference relative to the size of the table: entries of one table differ by rounding of the largest.
double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / std::max(1.0, b.lpNorm<Eigen::Infinity>());
}

Derivatives of_program(Transcription& program, const Eigen::VectorXd& x, double factor,
                       const Eigen::VectorXd& multipliers) {
  const SparsityPattern jacobian = program.jacobian_structure().expand();
  const SparsityPattern hessian = program.hessian_structure().expand();
  Derivatives result;
  result.gradient.resize(x.size());
  result.rows.resize(multipliers.size());
  Eigen::VectorXd jacobian_values(static_cast<Eigen::Index>(jacobian.size()));
  Eigen::VectorXd hessian_values(static_cast<Eigen::Index>(hessian.size()));
  program.gradient(x, result.gradient);
  program.constraints(x, result.rows);
  program.jacobian(x, jacobian_values);
  program.hessian(x, factor, multipliers, hessian_values);
  result.jacobian = dense(jacobian, jacobian_values, multipliers.size(), x.size());
  const Eigen::MatrixXd lower = dense(hessian, hessian_values, x.size(), x.size());
  result.hessian = lower + lower.transpose();
  result.hessian.diagonal() = lower.diagonal();
  return result;
}

using FamilyAndStages = std::pair<std::string, int>;

class ProgramDerivatives : public testing::TestWithParam<std::tuple<std::string, std::string, FamilyAndStages>> {
 protected:
  std::unique_ptr<Problem> problem_ = problem_named(std::get<0>(GetParam()));
  Scheme scheme_{std::get<1>(GetParam()), std::get<2>(GetParam()).second, std::get<2>(GetParam()).first};
};

TEST_P(ProgramDerivatives, AgreeWithHyperDualNumbers) {
  constexpr double tolerance = 2e-14;
  constexpr double factor = 0.7;
  for (const Grid& grid : {Grid::uniform(5), tests::graded_grid(5), Grid::uniform(4)}) {
    const auto program = tests::transcribe(*problem_, scheme_, grid);
    const Eigen::VectorXd x = point_near_guess(*problem_, *program);
    const Eigen::VectorXd multipliers = RandomPoints(7).vector(static_cast<Eigen::Index>(program->constraint_count()));
    const Derivatives ours = of_program(*program, x, factor, multipliers);
    const Derivatives theirs = by_hyper_duals(*program, x, factor, multipliers);
    EXPECT_LT(difference(ours.gradient, theirs.gradient), tolerance);
    EXPECT_LT(difference(ours.rows, theirs.rows), tolerance);
    EXPECT_LT(difference(ours.jacobian, theirs.jacobian), tolerance);
    EXPECT_LT(difference(ours.hessian, theirs.hessian), tolerance);
  }
}

TEST_P(ProgramDerivatives, AgreeWithDifferencesOfTheProgramItself) {
  // Along one random direction; Richardson's extrapolation of central differences, error O(ε⁴).
  const auto program = tests::transcribe(*problem_, scheme_, tests::graded_grid(7));
  const Eigen::VectorXd x = point_near_guess(*problem_, *program);
  const Eigen::VectorXd direction = RandomPoints(11).vector(x.size());
  const Eigen::VectorXd multipliers = RandomPoints(12).vector(static_cast<Eigen::Index>(program->constraint_count()));
  const auto along = [&](const auto& function) -> Eigen::VectorXd {
    const auto central = [&](double e) -> Eigen::VectorXd {
      return (function(x + e * direction) - function(x - e * direction)) / (2.0 * e);
    };
    constexpr double step = 1e-3;
    return (4.0 * central(step / 2.0) - central(step)) / 3.0;
  };
  const Derivatives exact = of_program(*program, x, 1.0, multipliers);
  const auto value_and_rows = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
    Eigen::VectorXd values(multipliers.size() + 1);
    Eigen::VectorXd rows(multipliers.size());
    program->constraints(y, rows);
    values << program->objective(y), rows;
    return values;
  };
  Eigen::VectorXd expected(multipliers.size() + 1);
  expected << exact.gradient.dot(direction), exact.jacobian * direction;
  EXPECT_LT(difference(along(value_and_rows), expected), 1e-9);
  const auto slope_of_lagrangian = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
    const Derivatives at = of_program(*program, y, 1.0, multipliers);
    return at.gradient + at.jacobian.transpose() * multipliers;
  };
  EXPECT_LT(difference(along(slope_of_lagrangian), exact.hessian * direction), 1e-9);
}

TEST_P(ProgramDerivatives, HaveNoPositionTwiceAndTheHessianOnlyItsLowerTriangle) {
  for (const int intervals : {4, 5, 70}) {
    const auto program = tests::transcribe(*problem_, scheme_, Grid::uniform(intervals));
    for (const BlockPattern* pattern : {&program->jacobian_structure(), &program->hessian_structure()}) {
      std::set<std::pair<int, int>> positions;
      pattern->for_each([&](Eigen::Index e, int row, int column) {
        EXPECT_EQ(e, static_cast<Eigen::Index>(positions.size()));
        EXPECT_TRUE(positions.insert({row, column}).second);
        if (pattern == &program->hessian_structure()) {
          EXPECT_GE(row, column);
        }
      });
      EXPECT_EQ(positions.size(), pattern->size());
    }
  }
}

TEST_P(ProgramDerivatives, HaveAsManyRunsOnAnyGridAndThoseOfTheHessianLieOnTheDiagonalOrOffIt) {
  std::set<std::pair<std::size_t, std::size_t>> counts;
  for (const int intervals : {5, 70}) {
    const auto program = tests::transcribe(*problem_, scheme_, Grid::uniform(intervals));
    counts.insert({program->jacobian_structure().runs().size(), program->hessian_structure().runs().size()});
    for (const PatternRun& run : program->hessian_structure().runs()) {
      if (run.row == run.column) {
        EXPECT_EQ(run.row_step, run.column_step);
      } else {
        EXPECT_GT(run.row + (run.length - 1) * run.row_step, run.column + (run.length - 1) * run.column_step);
      }
    }
  }
  EXPECT_EQ(counts.size(), 1U);
}

INSTANTIATE_TEST_SUITE_P(All, ProgramDerivatives,
                         testing::Combine(testing::Values("orbital_transfer", "two_link_manipulator", "moving_frame"),
                                          testing::ValuesIn(paper_families()),
                                          testing::Values(FamilyAndStages{"gauss", 1}, FamilyAndStages{"gauss", 2},
                                                          FamilyAndStages{"gauss", 3}, FamilyAndStages{"lobatto", 2},
                                                          FamilyAndStages{"lobatto", 3},
                                                          FamilyAndStages{"lobatto_shared", 2},
                                                          FamilyAndStages{"lobatto_shared", 3})),
                         [](const auto& instance) {
                           return std::get<0>(instance.param) + "_" + std::get<1>(instance.param) + "_" +
                                  std::get<2>(instance.param).first +
                                  std::to_string(std::get<2>(instance.param).second);
                         });

INSTANTIATE_TEST_SUITE_P(OfShooting, ProgramDerivatives,
                         testing::Combine(testing::Values("two_link_manipulator", "moving_frame"),
                                          testing::Values("multiple_shooting_rk4_1", "multiple_shooting_midpoint_3"),
                                          testing::Values(FamilyAndStages{"gauss", 1}, FamilyAndStages{"gauss", 2})),
                         [](const auto& instance) {
                           return std::get<0>(instance.param) + "_" + std::get<1>(instance.param) + "_" +
                                  std::to_string(std::get<2>(instance.param).second);
                         });

}  // namespace
}  // namespace dmocbench
