#include "methods/transcription/elements/galerkin_element.hpp"

#include <gtest/gtest.h>

#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

/// Spaces and quadratures of every kind: fewer, as many and more control nodes than the degree.
std::vector<Scheme> schemes() {
  return {{"galerkin_1_1", 1},
          {"galerkin_1_2", 2},
          {"galerkin_2_1", 3},
          {"galerkin_2_2", 3, "lobatto"},
          {"galerkin_3_1", 3},
          {"galerkin_3_4", 4},
          {"galerkin_1_2_shared", 2},
          {"galerkin_3_3_shared", 3},
          {"galerkin_2_3_shared", 4, "lobatto"}};
}

/// A point of a program off every solution.
Eigen::VectorXd moved_start(Transcription& program, const Problem& problem) {
  Eigen::VectorXd x = sample(program, tests::common_start(problem));
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] += 0.05 * std::sin(static_cast<double>(i * i + 1));
  return x;
}

double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / std::max(1.0, b.lpNorm<Eigen::Infinity>());
}

TEST(GalerkinElement, WithAsManyGaussPointsAndControlsAsItsDegreeIsDmoc) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    for (const int s : {1, 2, 3, 4}) {
      SCOPED_TRACE(name + ", s = " + std::to_string(s));
      const auto dmoc = tests::transcribe(*problem, {"dmoc", s}, tests::graded_grid(6));
      const auto galerkin = tests::transcribe(*problem, {galerkin_name(s, s, false), s}, tests::graded_grid(6));
      ASSERT_EQ(galerkin->variable_count(), dmoc->variable_count());
      ASSERT_EQ(galerkin->constraint_count(), dmoc->constraint_count());
      const Eigen::VectorXd x = moved_start(*dmoc, *problem);
      EXPECT_EQ(moved_start(*galerkin, *problem), x);
      const auto values = [&x](Transcription& program) {
        Eigen::VectorXd rows(static_cast<Eigen::Index>(program.constraint_count()));
        Eigen::VectorXd gradient(x.size());
        program.constraints(x, rows);
        program.gradient(x, gradient);
        Eigen::VectorXd all(rows.size() + gradient.size() + 1);
        all << rows, gradient, program.objective(x);
        return all;
      };
      EXPECT_LT(distance(values(*galerkin), values(*dmoc)), 1e-13);
    }
  }
}

TEST(GalerkinElement, IsDmocWithTheSameLobattoQuadratureInOtherUnknowns) {
  const auto problem = make_problem("two_link_manipulator");
  for (const int s : {2, 3}) {
    SCOPED_TRACE(s);
    const Grid grid = Grid::uniform(48);
    const Motion& start = tests::common_start(*problem);
    const Trajectory dmoc = tests::solve(*problem, {"dmoc", s, "lobatto"}, grid, start, 1e-11).trajectory;
    const Trajectory galerkin =
        tests::solve(*problem, {galerkin_name(s, s, false), s, "lobatto"}, grid, start, 1e-11).trajectory;
    EXPECT_LT((galerkin.q - dmoc.q).lpNorm<Eigen::Infinity>(), 1e-9);
    EXPECT_LT((galerkin.psi_p - dmoc.psi_p).lpNorm<Eigen::Infinity>(), 1e-7 * dmoc.psi_p.lpNorm<Eigen::Infinity>());
    EXPECT_NEAR(galerkin.cost, dmoc.cost, 1e-10 * dmoc.cost);
  }
}

TEST(GalerkinElement, TrajectoriesOfItStandForTheUnknownsThatTheyWereReadFrom) {
  const auto problem = make_problem("two_link_manipulator");
  for (const Scheme& scheme : schemes()) {
    const auto program = tests::transcribe(*problem, scheme, tests::graded_grid(5));
    const Eigen::VectorXd x = moved_start(*program, *problem);
    const Trajectory trajectory = read_trajectory(*program, x, Eigen::VectorXd());
    EXPECT_LT(distance(embed(*problem, *program, trajectory), x), 1e-12) << scheme.label();
  }
}

TEST(GalerkinElement, ControlsAreTheirPolynomialAtTheQuadraturePoints) {
  const auto problem = make_problem("two_link_manipulator");
  constexpr Eigen::Index intervals = 5;
  for (const Scheme& scheme : schemes()) {
    SCOPED_TRACE(scheme.label());
    const auto program = tests::transcribe(*problem, scheme, Grid::uniform(intervals));
    const Tableau& controls = program->functions().controls;
    // Controls u = t^(m - 1) at the nodes of the controls.
    Eigen::VectorXd x = sample(*program, tests::common_start(*problem));
    const auto power = [&](double t) { return std::pow(t, static_cast<double>(controls.stages() - 1)); };
    const Eigen::VectorXd times = program->node_times(x);
    for (Eigen::Index k = 0; k < intervals; ++k) {
      for (Eigen::Index i = 0; i < controls.stages(); ++i) {
        const double t = times[k] + controls.c[i] * (times[k + 1] - times[k]);
        for (const Eigen::Index c : {0, 1}) {
          x[program->blocks().unknown(Quantity::control, i).index(c) + k] = power(t);
        }
      }
    }
    const Trajectory trajectory = read_trajectory(*program, x, Eigen::VectorXd());
    for (Eigen::Index row = 0; row < trajectory.stage_u.rows(); ++row) {
      EXPECT_NEAR(trajectory.stage_u(row, 1), power(trajectory.stage_times[row]), 1e-12);
    }
  }
}

TEST(GalerkinElement, OneControlNodeIsAConstantControlOnEachInterval) {
  const auto problem = make_problem("two_link_manipulator");
  const Trajectory motion =
      tests::solve(*problem, {"galerkin_2_1", 3}, Grid::uniform(48), tests::common_start(*problem)).trajectory;
  for (Eigen::Index row = 0; row < motion.stage_u.rows(); ++row) {
    EXPECT_NEAR(motion.stage_u(row, 0), motion.stage_u(row - row % 3, 0), 1e-12);
  }
}

TEST(GalerkinElement, RefusesSpacesThatItsQuadratureCannotTellApart) {
  const auto refuses = [](const std::string& method, const Tableau& quadrature, const std::string& because) {
    const auto problem = make_problem("two_link_manipulator");
    tests::expect_error_naming({because},
                               [&] { Transcription(*problem, *make_element(method), quadrature, Grid::uniform(8)); });
  };
  refuses("galerkin_3_1", gauss_tableau(2), "degree 3 needs at least 3 quadrature points, got 2");
  refuses("galerkin_1_3", gauss_tableau(2), "3 control nodes needs at least 3 quadrature points, got 2");
  refuses("galerkin_5_1", gauss_tableau(2), "1, 2, 3, 4, not 5");
  refuses("galerkin_1_0", gauss_tableau(2), "1, 2, 3, 4, not 0");
  refuses("galerkin_2_1_shared", gauss_tableau(2), "2, 3, 4, not 1");
  refuses("galerkin_2", gauss_tableau(2), "galerkin_2_1");
  refuses("galerkin_a_b", gauss_tableau(2), "galerkin_2_1");
}

}  // namespace
}  // namespace dmocbench
