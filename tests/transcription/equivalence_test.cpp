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
using tests::Solved;

/// What a solution may leave in its own rows: Ipopt stops below this, and so must the other method's rows.
constexpr double tolerance = 1e-11;

/// Rows of stages are of the size of forces, up to 1/h times those of nodes.
double allowed(const Transcription& program) {
  return 10.0 * std::max(tolerance, program.rounding_floors().largest) / program.step_inputs().minCoeff();
}

TEST(Equivalence, ASolutionOfDmocSolvesTheHamiltonianRowsAndBack) {
  for (const auto& problem : problems()) {
    for (const int s : {1, 2, 3, 4}) {
      SCOPED_TRACE(problem->name() + ", s = " + std::to_string(s));
      const Grid grid = tests::graded_grid(24);
      const Motion& start = tests::common_start(*problem);
      const Solved dmoc = tests::solve(*problem, {"dmoc", s}, grid, start, tolerance);
      const Solved hamiltonian = tests::solve(*problem, {"hamiltonian", s}, grid, start, tolerance);
      EXPECT_LT(row_residual(*hamiltonian.transcription, pack(*hamiltonian.transcription, dmoc.trajectory)),
                allowed(*dmoc.transcription));
      EXPECT_LT(row_residual(*dmoc.transcription, pack(*dmoc.transcription, hamiltonian.trajectory)),
                allowed(*dmoc.transcription));
    }
  }
}

TEST(Equivalence, HoldsForThePairLobattoIIIAAndIIIB) {
  // Gauss cannot tell A from its conjugate; here A and Ã differ, and only the symplectic pair is variational.
  for (const auto& problem : problems()) {
    for (const int s : {2, 3, 4}) {
      SCOPED_TRACE(problem->name() + ", lobatto " + std::to_string(s));
      const Tableau lobatto = lobatto_tableau(s);
      const Grid grid = tests::graded_grid(24);
      const Motion& start = tests::common_start(*problem);
      const Solved dmoc = tests::solve(*problem, "dmoc", lobatto, grid, start, tolerance);
      const Solved hamiltonian = tests::solve(*problem, "hamiltonian", lobatto, grid, start, tolerance);
      EXPECT_LT(row_residual(*hamiltonian.transcription, pack(*hamiltonian.transcription, dmoc.trajectory)),
                allowed(*dmoc.transcription));
      EXPECT_LT(row_residual(*dmoc.transcription, pack(*dmoc.transcription, hamiltonian.trajectory)),
                allowed(*dmoc.transcription));
    }
  }
}

TEST(Equivalence, DmocAndHamiltonianHaveTheSameOptimum) {
  for (const auto& problem : problems()) {
    for (const tests::Scheme& scheme : tests::all_schemes()) {
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
    const Motion guess = guessed_motion(*problem);
    for (const int s : {1, 2, 3, 4}) {
      SCOPED_TRACE(problem->name() + ", s = " + std::to_string(s));
      const Grid grid = tests::graded_grid(20);
      const Solved tangent = tests::solve(*problem, {"tangent", s}, grid, guess, tolerance);
      const Solved hamiltonian = tests::solve(*problem, {"hamiltonian", s}, grid, guess, tolerance);
      EXPECT_LT(row_residual(*hamiltonian.transcription, pack(*hamiltonian.transcription, tangent.trajectory)),
                allowed(*tangent.transcription));
      EXPECT_LT(row_residual(*tangent.transcription, pack(*tangent.transcription, hamiltonian.trajectory)),
                allowed(*tangent.transcription));
      EXPECT_NEAR(tangent.trajectory.cost, hamiltonian.trajectory.cost, 1e-9);
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
