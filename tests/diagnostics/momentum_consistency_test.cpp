#include <gtest/gtest.h>

#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/convergence_order.hpp"
#include "methods/error.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;
using tests::Solved;

MomentumConsistency consistency(const Problem& problem, const Scheme& scheme, const Grid& grid) {
  return momentum_consistency(problem,
                              tests::solve(problem, scheme, grid, tests::common_start(problem), 1e-11).trajectory);
}

TEST(MomentumConsistency, OfDmocAndHamiltonianIsTheirResidualHoweverCoarseTheGrid) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    for (const char* method : {"dmoc", "hamiltonian"}) {
      for (const int s : {1, 2, 3}) {
        for (const Grid& grid : {Grid::uniform(16), tests::graded_grid(32)}) {
          EXPECT_LT(consistency(*problem, {method, s}, grid).largest, 1e-10) << name << ", " << method << ", s = " << s;
        }
      }
    }
  }
}

TEST(MomentumConsistency, OfDmocOnTheOrbitIsRounding) {
  const auto problem = make_problem("orbital_transfer");
  const MomentumConsistency measured = consistency(*problem, {"dmoc", 1}, Grid::uniform(512));
  EXPECT_LT(measured.largest, 1e-12);
  EXPECT_GT(measured.largest_force, 1e-4);
}

struct Published {
  std::string problem;
  std::vector<double> defects;  // N = 32, 64, 128, 256
};

TEST(MomentumConsistency, OfTangentFallsWithTheThirdPowerOfTheStepFromItsKnownValues) {
  const std::vector<int> grids{32, 64, 128, 256};
  for (const Published& known : {Published{"orbital_transfer", {1.07e-8, 1.38e-9, 1.73e-10, 2.17e-11}},
                                 Published{"two_link_manipulator", {1.05e-2, 1.33e-3, 1.81e-4, 2.31e-5}}}) {
    const auto problem = make_problem(known.problem);
    std::vector<GridError> defects;
    for (std::size_t i = 0; i < grids.size(); ++i) {
      const double largest = consistency(*problem, {"tangent", 1}, Grid::uniform(grids[i])).largest;
      EXPECT_NEAR(largest, known.defects[i], 0.2 * known.defects[i]) << grids[i];
      defects.push_back({1.0 / grids[i], largest});
    }
    EXPECT_NEAR(fit_order(defects)->order, 3.0, 0.1) << known.problem;
  }
}

TEST(MomentumConsistency, OfTangentIsRoundingIfTheMassIsConstant) {
  const tests::DoubleIntegrator problem;
  for (const Scheme& scheme : tests::all_schemes()) {
    const Trajectory trajectory =
        tests::solve(problem, scheme, tests::graded_grid(8), guessed_motion(problem)).trajectory;
    EXPECT_LT(momentum_consistency(problem, trajectory).largest, 1e-12) << scheme.label();
  }
}

/// Rotations and dilations at once, ξ = (q₁ - q₂, q₁ + q₂). L is not invariant, so L_q·ξ and L_v·Dξ q̇ = |q̇|² both
/// count.
class Spiral final : public tests::CentralForce {
 public:
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    ExpressionVector generator(2);
    generator << q[0] - q[1], q[0] + q[1];
    return generator;
  }
};

TEST(MomentumConsistency, CountsTheChangeOfAGeneratorThatDependsOnTheConfiguration) {
  const Spiral problem;
  for (const Scheme& scheme : tests::all_schemes()) {
    // Its mass is constant, so tangent-space collocation is symplectic where its tableau is: not by Lobatto IIIA alone.
    if (scheme.method == "tangent" && scheme.family == "lobatto") continue;
    const Trajectory trajectory =
        tests::solve(problem, scheme, tests::graded_grid(16), guessed_motion(problem), 1e-11).trajectory;
    EXPECT_LT(momentum_consistency(problem, trajectory).largest, 1e-10) << scheme.label();
  }
}

TEST(MomentumConsistency, OfGalerkinIsRoundingWithEveryQuadratureAndControlSpace) {
  const Spiral problem;
  const auto two_link = make_problem("two_link_manipulator");
  for (const Scheme& scheme :
       {Scheme{"galerkin_1_1", 3}, {"galerkin_2_1", 2}, {"galerkin_2_2", 3, "lobatto"}, {"galerkin_3_2_shared", 4}}) {
    SCOPED_TRACE(scheme.label());
    const Trajectory spiral =
        tests::solve(problem, scheme, tests::graded_grid(16), guessed_motion(problem), 1e-11).trajectory;
    EXPECT_LT(momentum_consistency(problem, spiral).largest, 1e-10);
    EXPECT_LT(consistency(*two_link, scheme, Grid::uniform(32)).largest, 1e-10);
  }
}

TEST(MomentumConsistency, IsNoIdentityButTheRowOfTheNodeAlongTheSymmetry) {
  // At a point that solves nothing the defect of interval k is minus the row of node k + 1: only solving makes it
  // vanish.
  const auto problem = make_problem("two_link_manipulator");
  for (const int s : {1, 2}) {
    const auto program = tests::transcribe(*problem, {"dmoc", s}, Grid::uniform(10));
    Eigen::VectorXd x = sample(*program, guessed_motion(*problem));
    x += tests::RandomPoints().vector(x.size(), -0.1, 0.1);
    Eigen::VectorXd rows(static_cast<Eigen::Index>(program->constraint_count()));
    program->constraints(x, rows);
    const MomentumConsistency measured =
        momentum_consistency(*problem, read_trajectory(*program, x, Eigen::VectorXd()));
    for (Eigen::Index k = 0; k + 1 < 10; ++k) {
      const auto row = [&](Eigen::Index i) {
        return rows[program->blocks().row(Equation::euler_lagrange).index(i) + k + 1];
      };
      EXPECT_NEAR(measured.defects[k], -(row(0) + row(1)), 1e-11);
      EXPECT_GT(std::abs(measured.defects[k]), 1e-6);
    }
  }
}

TEST(MomentumConsistency, SumsItsDefectsToTheTotalAndTheirMagnitudesToTheMean) {
  const auto problem = make_problem("two_link_manipulator");
  const MomentumConsistency measured = consistency(*problem, {"tangent", 1}, Grid::uniform(32));
  ASSERT_EQ(measured.defects.size(), 32);
  EXPECT_DOUBLE_EQ(measured.largest, measured.defects.cwiseAbs().maxCoeff());
  EXPECT_DOUBLE_EQ(measured.mean, measured.defects.cwiseAbs().mean());
  EXPECT_DOUBLE_EQ(measured.total, std::abs(measured.defects.sum()));
}

TEST(CostateMomentum, IsConstantAlongOptimaOfSymmetricProblemsByEveryMethodInEitherChart) {
  for (const std::string name : {"orbital_transfer", "kepler_cartesian", "hovercraft"}) {
    const auto problem = make_problem(name);
    for (const std::string& method : paper_families()) {
      const Solved solved =
          tests::solve(*problem, {method, 2}, Grid::uniform(32), tests::common_start(*problem), 1e-11);
      EXPECT_LT(costate_momentum(*problem, solved.trajectory).spread, 1e-7) << name << ", " << method;
    }
  }
}

TEST(CostateMomentum, MovesWhereGravityBreaksTheSymmetry) {
  const auto problem = make_problem("two_link_manipulator");
  const Solved solved = tests::solve(*problem, {"dmoc", 1}, Grid::uniform(64), tests::common_start(*problem), 1e-11);
  EXPECT_GT(costate_momentum(*problem, solved.trajectory).spread, 1e-3);
  Trajectory without = solved.trajectory;
  without.psi_q.resize(0, 0);
  EXPECT_THROW(static_cast<void>(costate_momentum(*problem, without)), Error);
}

TEST(MomentumConsistency, NeedsASymmetry) {
  const tests::Pendulum problem;
  const auto program = tests::transcribe(problem, {"dmoc", 1}, Grid::uniform(8));
  const Trajectory trajectory = read_trajectory(*program, sample(*program, guessed_motion(problem)), Eigen::VectorXd());
  tests::expect_error_naming({"pendulum", "symmetry"},
                             [&] { static_cast<void>(momentum_consistency(problem, trajectory)); });
}

}  // namespace
}  // namespace dmocbench
