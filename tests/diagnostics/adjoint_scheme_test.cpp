// The KKT multipliers of DMOC and of Hamiltonian collocation satisfy the adjoint partitioned Runge-Kutta scheme with
// the coefficients of (th:orderapp); with others, or with a wrong sign, they do not.
#include "methods/diagnostics/adjoint_scheme.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/judgement/polish.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

std::vector<std::unique_ptr<Problem>> problems_with_adjoints() {
  std::vector<std::unique_ptr<Problem>> all = tests::problems();
  for (const char* name : {"forced_oscillator", "two_link_with_motors", "orbital_transfer_with_mass"}) {
    all.push_back(make_problem(name));
  }
  return all;
}

std::vector<Scheme> schemes(const std::vector<std::string>& families) {
  std::vector<Scheme> structured;
  for (const Scheme& scheme : tests::schemes_of(families, 4)) {
    if (scheme.method != "tangent") structured.push_back(scheme);
  }
  return structured;
}

/// The trajectory of an answer; multipliers times `sign`.
Trajectory trajectory_of(const tests::Solved& answer, double sign = 1.0) {
  return read_trajectory(*answer.transcription, answer.solution.primal, sign * answer.solution.multipliers);
}

/// The polished solution from a motion.
tests::Solved polished_answer(const Motion& start, const Problem& problem, const Scheme& scheme) {
  tests::Solved answer = tests::solve(problem, scheme, tests::graded_grid(24), start);
  polish(*answer.transcription, answer.solution);
  return answer;
}

Trajectory polished(const Problem& problem, const Scheme& scheme) {
  return trajectory_of(polished_answer(tests::common_start(problem), problem, scheme));
}

AdjointResidual residual(const Problem& problem, const Trajectory& trajectory) {
  return adjoint_residual(problem, trajectory, adjoint_coefficients(trajectory.tableau));
}

constexpr double rounding = 1e-9;
constexpr double far_above_rounding = 1e-5;

TEST(AdjointScheme, HasTheCoefficientsOfTheStateSchemeWithBothHalvesExchanged) {
  for (const std::string& family : tableau_names()) {
    for (const int s : tableau_stages(family)) {
      const Tableau tableau = make_tableau(family, s);
      const AdjointCoefficients adjoint = adjoint_coefficients(tableau);
      EXPECT_LT((adjoint.a_q - tableau.a_conjugate).lpNorm<Eigen::Infinity>(), 1e-15) << family << " " << s;
      EXPECT_LT((adjoint.a_p - tableau.a).lpNorm<Eigen::Infinity>(), 1e-15) << family << " " << s;
    }
  }
}

TEST(AdjointScheme, ResidualIsAtRoundoffForEveryTableauAndFarAboveItIfMultipliersHaveTheWrongSign) {
  for (const auto& problem : problems_with_adjoints()) {
    for (const Scheme& scheme : schemes({"gauss", "lobatto", "lobatto_shared"})) {
      const tests::Solved answer = polished_answer(tests::common_start(*problem), *problem, scheme);
      const AdjointResidual left = residual(*problem, trajectory_of(answer));
      EXPECT_LT(left.step_q, rounding) << problem->name() << ", " << scheme.label();
      EXPECT_LT(left.step_p, rounding) << problem->name() << ", " << scheme.label();
      EXPECT_LT(left.stage_q, rounding) << problem->name() << ", " << scheme.label();
      EXPECT_LT(left.stage_p, rounding) << problem->name() << ", " << scheme.label();
      EXPECT_LT(left.step_y, rounding) << problem->name() << ", " << scheme.label();
      EXPECT_LT(left.stage_y, rounding) << problem->name() << ", " << scheme.label();
      EXPECT_EQ(left.control.has_value(), scheme.family != "lobatto_shared");
      EXPECT_LT(left.control.value_or(0.0), rounding) << problem->name() << ", " << scheme.label();
      if (!left.control) continue;  // the other equations are linear in the multipliers
      const double of_wrong_sign = residual(*problem, trajectory_of(answer, -1.0)).largest();
      EXPECT_GT(of_wrong_sign, far_above_rounding) << problem->name() << ", " << scheme.label();
    }
  }
}

TEST(AdjointScheme, PlainCoefficientsLeaveMuchMoreThanRounding) {
  // Gauss is its own conjugate and cannot tell; Lobatto IIIA and IIIB can.
  const auto problem = make_problem("two_link_manipulator");
  for (const Scheme& scheme : schemes({"lobatto"})) {
    const Trajectory trajectory = polished(*problem, scheme);
    const AdjointCoefficients plain{.a_q = trajectory.tableau.a, .a_p = trajectory.tableau.a_conjugate};
    const AdjointResidual left = adjoint_residual(*problem, trajectory, plain);
    EXPECT_GT(left.stage_q, far_above_rounding) << scheme.label();
    EXPECT_GT(left.stage_p, far_above_rounding) << scheme.label();
  }
}

TEST(AdjointScheme, ADisturbedCostateIsSeen) {
  const auto problem = make_problem("two_link_manipulator");
  const Trajectory good = polished(*problem, {"dmoc", 2});
  const auto with_motors = make_problem("two_link_with_motors");
  Trajectory disturbed_current = polished(*with_motors, {"dmoc", 2});
  disturbed_current.stage_psi_y(5, 1) *= 1.01;
  EXPECT_GT(residual(*with_motors, disturbed_current).largest(), far_above_rounding);
  for (Eigen::MatrixXd Trajectory::*table :
       {&Trajectory::psi_q, &Trajectory::psi_p, &Trajectory::stage_psi_q, &Trajectory::stage_psi_p}) {
    Trajectory disturbed = good;
    (disturbed.*table)(5, 1) *= 1.01;
    EXPECT_GT(residual(*problem, disturbed).largest(), far_above_rounding);
  }
}

TEST(AdjointScheme, OfTangentSpaceCollocationIsAnotherOneWhereTheMassIsNotConstant) {
  const auto two_link = make_problem("two_link_manipulator");
  const auto oscillator = make_problem("forced_oscillator");
  for (const int s : {1, 2}) {
    EXPECT_GT(residual(*two_link, polished(*two_link, {"tangent", s})).largest(), far_above_rounding);
    EXPECT_LT(residual(*oscillator, polished(*oscillator, {"tangent", s})).largest(), rounding);
  }
}

TEST(AdjointScheme, StageCostatesOfBothFamiliesAgree) {
  // They are read from multipliers of different rows by different formulas.
  int other_minima = 0;  // the arm with motors has several
  for (const auto& problem : problems_with_adjoints()) {
    for (const Scheme& scheme : schemes({"gauss", "lobatto"})) {
      if (scheme.method != "dmoc") continue;
      const Trajectory a = polished(*problem, scheme);
      const Trajectory b =
          trajectory_of(polished_answer(smooth_motion(a), *problem, {"hamiltonian", scheme.stages, scheme.family}));
      if (std::abs(a.cost - b.cost) > 1e-3 * std::abs(a.cost)) {
        ++other_minima;
        continue;
      }
      const double size = std::max(b.stage_psi_q.lpNorm<Eigen::Infinity>(), b.stage_psi_p.lpNorm<Eigen::Infinity>());
      EXPECT_LT((a.stage_psi_q - b.stage_psi_q).lpNorm<Eigen::Infinity>(), 1e-8 * size)
          << problem->name() << ", " << scheme.label();
      EXPECT_LT((a.stage_psi_p - b.stage_psi_p).lpNorm<Eigen::Infinity>(), 1e-8 * size)
          << problem->name() << ", " << scheme.label();
      EXPECT_LE((a.stage_psi_y - b.stage_psi_y).lpNorm<Eigen::Infinity>(), 1e-8 * size)
          << problem->name() << ", " << scheme.label();
    }
  }
  EXPECT_LE(other_minima, 1);
}

TEST(AdjointScheme, NeedsCostates) {
  const auto problem = make_problem("orbital_transfer");
  Trajectory trajectory = polished(*problem, {"dmoc", 1});
  trajectory.psi_q.resize(0, 0);
  tests::expect_error_naming({"costates"}, [&] { static_cast<void>(residual(*problem, trajectory)); });
}

}  // namespace
}  // namespace dmocbench
