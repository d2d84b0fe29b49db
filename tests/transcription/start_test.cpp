#include "methods/transcription/start.hpp"

#include <gtest/gtest.h>

#include "methods/mechanics/legendre_transform.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

/// The optimum of the double integrator: q is a cubic, u a line, so Gauss with s = 3 contains it.
MotionPoint optimum(double t) {
  return {.q = Eigen::VectorXd::Constant(1, 3.0 * t * t - 2.0 * t * t * t),
          .v = Eigen::VectorXd::Constant(1, 6.0 * t - 6.0 * t * t),
          .u = Eigen::VectorXd::Constant(1, 6.0 - 12.0 * t)};
}

TEST(Sample, OfAMotionInTheSpaceLeavesRoundingInTheRows) {
  const tests::DoubleIntegrator problem;
  const auto program = tests::transcribe(problem, {"dmoc", 3}, tests::graded_grid(5));
  EXPECT_LT(tests::row_residual(*program, sample(*program, {optimum, problem.horizon()})), 1e-12);
}

TEST(Sample, OfAUniformMotionIsExactForEveryScheme) {
  // v constant, u = 0: every slope is known exactly, those of p and v too.
  const tests::DoubleIntegrator base;
  const auto point = [](double q) {
    return BoundaryState{Eigen::VectorXd::Constant(1, q), Eigen::VectorXd::Constant(1, 2.0)};
  };
  const tests::WithEnds problem(base, point(0.5), point(2.5));
  for (const Scheme& scheme : tests::all_schemes()) {
    const auto program = tests::transcribe(problem, scheme, tests::graded_grid(5));
    const auto at = [](double t) {
      return MotionPoint{Eigen::VectorXd::Constant(1, 0.5 + 2.0 * t), Eigen::VectorXd::Constant(1, 2.0),
                         Eigen::VectorXd::Zero(1)};
    };
    const Motion uniform{at, problem.horizon()};
    EXPECT_LT(tests::row_residual(*program, sample(*program, uniform)), 1e-13) << scheme.label();
  }
}

TEST(Sample, OfASolutionOnAFinerGridHasResidualsThatVanishWithTheStep) {
  const auto problem = make_problem("two_link_manipulator");
  const Motion& motion = tests::common_start(*problem);
  for (const std::string& method : paper_families()) {
    const auto residual = [&](int intervals) {
      const auto program = tests::transcribe(*problem, {method, 1}, Grid::uniform(intervals));
      return tests::row_residual(*program, sample(*program, motion));
    };
    EXPECT_LT(residual(48), 0.5 * residual(12)) << method;
  }
}

TEST(Sample, GivesFixedVariablesTheirValuesWhateverTheMotion) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    const auto at = [&](double t) {
      MotionPoint point = problem->guess(t);
      point.q.array() += 0.3;
      point.v.array() += 5.0;
      return point;
    };
    const Motion elsewhere{at, problem->horizon()};
    for (const Scheme& scheme : tests::all_schemes()) {
      const auto program = tests::transcribe(*problem, scheme, Grid::uniform(6));
      const Eigen::VectorXd x = sample(*program, elsewhere);
      Eigen::Index fixed = 0;
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        if (program->variable_lower()[i] != program->variable_upper()[i]) continue;
        EXPECT_EQ(x[i], program->variable_lower()[i]);
        ++fixed;
      }
      EXPECT_EQ(fixed, (scheme.method == "dmoc" ? 2 : 4) * problem->configuration_size());
    }
  }
}

TEST(Sample, PutsVelocitiesMomentaAndControlsWhereTheLayoutSays) {
  const tests::MovingFrame problem;
  const auto at = [](double t) {
    return MotionPoint{Eigen::Vector2d(std::sin(t), t * t), Eigen::Vector2d(std::cos(t), 2.0 * t),
                       Eigen::Vector2d(1.0 + t, -t)};
  };
  const Motion motion{at, problem.horizon()};
  LegendreTransform legendre{TracedProblem(problem)};
  for (const Scheme& scheme : tests::all_schemes()) {
    const auto program = tests::transcribe(problem, scheme, tests::graded_grid(4));
    const ProgramBlocks& blocks = program->blocks();
    const Eigen::VectorXd x = sample(*program, motion);
    const auto entry = [&](std::size_t column, Eigen::Index k) { return x[static_cast<Eigen::Index>(column) + k]; };
    for (Eigen::Index k = 1; k < 4; ++k) {
      const double t = program->node_times(x)[k];
      const MotionPoint node = at(t);
      const Eigen::VectorXd p = legendre.momentum(node.q, node.v, t);
      for (Eigen::Index i = 0; i < 2; ++i) {
        EXPECT_EQ(entry(blocks.unknown(Quantity::configuration).at(i), k), node.q[i]);
        if (scheme.method == "hamiltonian") {
          EXPECT_EQ(entry(blocks.unknown(Quantity::second).at(i), k), p[i]);
        }
        if (scheme.method == "tangent") {
          EXPECT_EQ(entry(blocks.unknown(Quantity::second).at(i), k), node.v[i]);
        }
      }
      for (Eigen::Index j = 0; j < scheme.stages; ++j) {
        const MotionPoint stage = at(t + program->tableau().c[j] * program->steps(x)[k]);
        for (Eigen::Index i = 0; i < 2; ++i) {
          EXPECT_EQ(entry(blocks.unknown(Quantity::control, j).at(i), k), stage.u[i]);
          if (j + 1 < scheme.stages) {
            EXPECT_EQ(entry(blocks.unknown(Quantity::rate, j).at(i), k), stage.v[i]);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace dmocbench
