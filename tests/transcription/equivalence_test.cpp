// DMOC, Hamiltonian collocation and, where L_vv is constant, tangent-space collocation are the same discrete system
// (section 3.3 of the paper): the solution of one leaves only rounding in the rows of the other.

#include <gtest/gtest.h>

#include "problems/registry.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::pack;
using tests::problems;
using tests::row_residual;
using tests::Scheme;
using tests::Solved;

/// What a solution may leave in its own rows: Ipopt stops below this, and so must the other method's rows.
constexpr double tolerance = 1e-11;

/// Rows of stages are of the size of forces, up to 1/h times those of nodes.
double allowed(const Transcription& program) {
  return 10.0 * std::max(tolerance, program.rounding_floors().largest) / program.step_inputs().minCoeff();
}

/// Solutions of both schemes leave only rounding in the rows of the other one.
void expect_equal_rows(const Problem& problem, const Scheme& scheme, const Scheme& other, const Grid& grid,
                       const Motion& start) {
  SCOPED_TRACE(problem.name() + ", " + scheme.label());
  const Solved one = tests::solve(problem, scheme, grid, start, tolerance);
  const Solved two = tests::solve(problem, other, grid, start, tolerance);
  const double rounding = allowed(*one.transcription);
  EXPECT_LT(row_residual(*two.transcription, pack(*two.transcription, one.trajectory)), rounding);
  EXPECT_LT(row_residual(*one.transcription, pack(*one.transcription, two.trajectory)), rounding);
  EXPECT_NEAR(one.trajectory.cost, two.trajectory.cost, 1e-10 * two.trajectory.cost);
}

/// The conjugate Ã of a Gauss tableau is A itself. With Lobatto IIIA and IIIB they differ, and only the symplectic pair
/// is variational.
TEST(Equivalence, ASolutionOfDmocSolvesTheHamiltonianRowsAndBack) {
  for (const auto& problem : problems()) {
    for (const Scheme& scheme : tests::all_schemes(4)) {
      if (scheme.method != "dmoc") continue;
      expect_equal_rows(*problem, scheme, {"hamiltonian", scheme.stages, scheme.family}, tests::graded_grid(24),
                        tests::common_start(*problem));
    }
  }
}

TEST(Equivalence, DmocAndHamiltonianHaveTheSameOptimum) {
  for (const auto& problem : problems()) {
    for (const Scheme& scheme : tests::all_schemes()) {
      if (scheme.method != "dmoc") continue;
      SCOPED_TRACE(problem->name() + ", " + scheme.label());
      const Grid grid = Grid::uniform(48);
      const Motion& start = tests::common_start(*problem);
      const Trajectory a = tests::solve(*problem, scheme, grid, start, 1e-11).trajectory;
      const Trajectory b =
          tests::solve(*problem, {"hamiltonian", scheme.stages, scheme.family}, grid, start, 1e-11).trajectory;
      EXPECT_NEAR(a.cost, b.cost, 1e-10 * b.cost);
      const double scale = b.q.lpNorm<Eigen::Infinity>();
      EXPECT_LT((a.q - b.q).lpNorm<Eigen::Infinity>(), 1e-9 * scale);
      EXPECT_LT((a.p - b.p).lpNorm<Eigen::Infinity>(), 1e-9 * b.p.lpNorm<Eigen::Infinity>());
      EXPECT_LT((a.stage_u - b.stage_u).lpNorm<Eigen::Infinity>(), 1e-8 * b.stage_u.lpNorm<Eigen::Infinity>());
      const double psi_scale = std::max(b.psi_q.lpNorm<Eigen::Infinity>(), b.psi_p.lpNorm<Eigen::Infinity>());
      EXPECT_LT((a.psi_q - b.psi_q).lpNorm<Eigen::Infinity>(), 1e-7 * psi_scale);
      EXPECT_LT((a.psi_p - b.psi_p).lpNorm<Eigen::Infinity>(), 1e-7 * psi_scale);
    }
  }
}

TEST(Equivalence, TangentSolvesTheHamiltonianRowsIfTheMassIsConstant) {
  const tests::Pendulum pendulum;  // not linear in q
  const auto oscillator = make_problem("forced_oscillator");
  for (const Problem* problem :
       {static_cast<const Problem*>(&pendulum), static_cast<const Problem*>(oscillator.get())}) {
    for (const int s : {1, 2, 3, 4}) {
      expect_equal_rows(*problem, {"tangent", s}, {"hamiltonian", s}, tests::graded_grid(20), guessed_motion(*problem));
    }
  }
}

TEST(Equivalence, TangentDiffersFromHamiltonianIfTheMassDependsOnTheConfiguration) {
  // Otherwise the test above would hold for the wrong reason.
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    const Solved tangent = tests::solve(*problem, {"tangent", 1}, Grid::uniform(48), tests::common_start(*problem));
    const auto hamiltonian = tests::transcribe(*problem, {"hamiltonian", 1}, Grid::uniform(48));
    EXPECT_GT(row_residual(*hamiltonian, pack(*hamiltonian, tangent.trajectory)), 1e-6) << name;
  }
}

}  // namespace
}  // namespace dmocbench
