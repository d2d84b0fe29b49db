// Elimination by intervals against dense linear algebra, on the KKT systems of transcriptions at random points.

#include "methods/solvers/interior_point/intervals/interval_kkt.hpp"

#include <memory>
#include <random>
#include <string>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/registry.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench::interior_point {
namespace {

/// A KKT matrix of a program at a point, with random multipliers and diagonals.
struct System {
  Eigen::VectorXd hessian;
  Eigen::VectorXd jacobian;
  Eigen::VectorXd diagonal;
  Eigen::VectorXd softness;
  Eigen::VectorXd slope;
  Eigen::VectorXd rows;

  [[nodiscard]] KktMatrix matrix() const { return {hessian, jacobian, diagonal, softness}; }
};

Eigen::VectorXd random_vector(std::size_t size, double scale, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-scale, scale);
  return Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(size), [&](auto) { return uniform(generator); });
}

System system_at(NonlinearProgram& program, const Eigen::VectorXd& x, double multiplier_scale, double shift,
                 std::mt19937& generator) {
  System system;
  const Eigen::VectorXd multipliers = random_vector(program.constraint_count(), multiplier_scale, generator);
  system.hessian.resize(static_cast<Eigen::Index>(program.hessian_structure().size()));
  system.jacobian.resize(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  program.hessian(x, 1.0, multipliers, system.hessian);
  program.jacobian(x, system.jacobian);
  system.diagonal = random_vector(program.variable_count(), 0.5, generator).array() + 0.5 + shift;
  system.softness = random_vector(program.constraint_count(), 0.4, generator).array() + 0.5;
  for (Eigen::Index i = 0; i < system.softness.size(); ++i) {
    if (program.constraint_lower()[i] == program.constraint_upper()[i]) system.softness[i] = 0.0;
  }
  system.slope = random_vector(program.variable_count(), 1.0, generator);
  system.rows = random_vector(program.constraint_count(), 1.0, generator);
  return system;
}

/// The whole matrix, with unit rows for fixed variables.
Eigen::MatrixXd dense(const NonlinearProgram& program, const System& system) {
  const auto n = static_cast<Eigen::Index>(program.variable_count());
  const auto m = static_cast<Eigen::Index>(program.constraint_count());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + m, n + m);
  const SparsityPattern& hessian = program.hessian_structure();
  for (std::size_t e = 0; e < hessian.size(); ++e) {
    const double value = system.hessian[static_cast<Eigen::Index>(e)];
    matrix(hessian.rows[e], hessian.columns[e]) = value;
    matrix(hessian.columns[e], hessian.rows[e]) = value;
  }
  const SparsityPattern& jacobian = program.jacobian_structure();
  for (std::size_t e = 0; e < jacobian.size(); ++e) {
    const double value = system.jacobian[static_cast<Eigen::Index>(e)];
    matrix(n + jacobian.rows[e], jacobian.columns[e]) = value;
    matrix(jacobian.columns[e], n + jacobian.rows[e]) = value;
  }
  matrix.diagonal().head(n) += system.diagonal;
  matrix.diagonal().tail(m) -= system.softness;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (program.variable_lower()[i] != program.variable_upper()[i]) continue;
    matrix.row(i).setZero();
    matrix.col(i).setZero();
    matrix(i, i) = 1.0;
  }
  return matrix;
}

/// One seed per case, so that every case can be looked at by itself.
void expect_agreement(const Problem& problem, const tests::Scheme& scheme, int intervals, CostForm form) {
  const std::string label = problem.name() + " " + scheme.label() + ", N = " + std::to_string(intervals);
  SCOPED_TRACE(label);
  std::mt19937 generator(static_cast<unsigned>(std::hash<std::string>()(label)));
  Transcription program(problem, *make_element(scheme.method), scheme.tableau(), Grid::uniform(intervals), "tape",
                        form);
  std::string why;
  const auto kkt = IntervalKkt::make(program, why);
  ASSERT_NE(kkt, nullptr) << why;
  const Eigen::VectorXd x =
      sample(program, guessed_motion(problem)) + random_vector(program.variable_count(), 1e-2, generator);
  const System system = system_at(program, x, 1e-2, 10.0, generator);
  const auto n = static_cast<Eigen::Index>(program.variable_count());
  const auto m = static_cast<Eigen::Index>(program.constraint_count());
  const Eigen::MatrixXd matrix = dense(program, system);
  Eigen::VectorXd right_hand_side(n + m);
  right_hand_side << -system.slope, -system.rows;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (program.variable_lower()[i] == program.variable_upper()[i]) right_hand_side[i] = 0.0;
  }
  const Eigen::VectorXd wanted = matrix.fullPivLu().solve(right_hand_side);
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
  const bool is_minimum = (eigenvalues.array() < 0.0).count() == m;

  Eigen::VectorXd primal(n);
  Eigen::VectorXd multipliers(m);
  const Verdict verdict = kkt->solve(system.matrix(), system.slope, system.rows, primal, multipliers);
  EXPECT_EQ(verdict == Verdict::solved, is_minimum) << static_cast<int>(verdict);
  if (verdict != Verdict::solved) return;
  EXPECT_LT((primal - wanted.head(n)).lpNorm<Eigen::Infinity>(),
            1e-8 * (1.0 + wanted.head(n).lpNorm<Eigen::Infinity>()));
  EXPECT_LT((multipliers - wanted.tail(m)).lpNorm<Eigen::Infinity>(),
            1e-8 * (1.0 + wanted.tail(m).lpNorm<Eigen::Infinity>()));
}

TEST(IntervalKkt, AgreesWithDenseLinearAlgebraOnEveryProblemAndScheme) {
  for (const std::string& name : problem_names()) {
    const auto problem = make_problem(name);
    for (const tests::Scheme& scheme : tests::all_schemes(2)) {
      for (const int intervals : {16, 21}) expect_agreement(*problem, scheme, intervals, CostForm::bolza);
    }
  }
}

TEST(IntervalKkt, AgreesWithDenseLinearAlgebraWhereEverythingIsStated) {
  const tests::Everything everything;
  for (const tests::Scheme& scheme : tests::all_schemes(3)) {
    expect_agreement(everything.problem(), scheme, 17, CostForm::bolza);
    expect_agreement(everything.problem(), scheme, 17, CostForm::mayer);
  }
  for (const tests::Scheme& scheme : tests::schemes_with_shared_controls(3)) {
    expect_agreement(everything.problem(), scheme, 17, CostForm::bolza);
  }
}

}  // namespace
}  // namespace dmocbench::interior_point
