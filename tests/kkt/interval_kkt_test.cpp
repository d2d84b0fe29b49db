// Elimination by intervals against dense linear algebra, on the KKT systems of transcriptions at random points.

#include "methods/kkt/intervals/interval_kkt.hpp"

#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "methods/kkt/refined_kkt.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "problems/registry.hpp"
#include "tests/support/dense_kkt.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench::kkt {
namespace {

using tests::DenseKkt;
using tests::KktNumbers;

Eigen::VectorXd random_vector(std::size_t size, double scale, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-scale, scale);
  return Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(size), [&](auto) { return uniform(generator); });
}

KktNumbers numbers_at(NonlinearProgram& program, const Eigen::VectorXd& x, double multiplier_scale, double shift,
                      std::mt19937& generator) {
  KktNumbers numbers;
  const Eigen::VectorXd multipliers = random_vector(program.constraint_count(), multiplier_scale, generator);
  numbers.hessian.resize(static_cast<Eigen::Index>(program.hessian_structure().size()));
  numbers.jacobian.resize(static_cast<Eigen::Index>(program.jacobian_structure().size()));
  program.hessian(x, 1.0, multipliers, numbers.hessian);
  program.jacobian(x, numbers.jacobian);
  numbers.diagonal = random_vector(program.variable_count(), 0.5, generator).array() + 0.5 + shift;
  numbers.compliance = random_vector(program.constraint_count(), 0.4, generator).array() + 0.5;
  for (Eigen::Index i = 0; i < numbers.compliance.size(); ++i) {
    if (program.constraint_lower()[i] == program.constraint_upper()[i]) numbers.compliance[i] = 0.0;
  }
  numbers.gradient = random_vector(program.variable_count(), 1.0, generator);
  numbers.rows = random_vector(program.constraint_count(), 1.0, generator);
  return numbers;
}

/// Equal to eight digits, or to those that size and condition of the matrix leave.
void expect_equal(const Eigen::VectorXd& found, const Eigen::VectorXd& wanted, const DenseKkt& dense) {
  const double rounding = 10.0 * static_cast<double>(wanted.size()) * std::numeric_limits<double>::epsilon();
  const double error = (found - wanted).lpNorm<Eigen::Infinity>() / (1.0 + wanted.lpNorm<Eigen::Infinity>());
  if (error < 1e-8) return;
  EXPECT_LT(error, rounding * dense.condition());
}

/// One seed per case, so that every case can be looked at by itself. False if there is no step to compare.
bool expect_agreement(const Problem& problem, const tests::Scheme& scheme, int intervals, CostForm form) {
  const std::string label = problem.name() + " " + scheme.label() + ", N = " + std::to_string(intervals);
  SCOPED_TRACE(label);
  std::mt19937 generator(static_cast<unsigned>(std::hash<std::string>()(label)));
  Transcription program(problem, *make_element(scheme.method), scheme.tableau(), Grid::uniform(intervals), "tape",
                        form);
  auto made = IntervalKkt::make(program);
  const bool has_interior_equations = program.interval_structure()->has_interior_equations;
  if (!made) {
    EXPECT_TRUE(has_interior_equations) << made.error();  // the unknowns of such nodes differ from all others
    return false;
  }
  // Fixed unknowns between the ends leave an error, which refinement removes. With Euler angles the fixed order of
  // pivots leaves up to 2.4e-8 of Hamiltonian collocation's steps by Lobatto with two stages.
  const bool needs_refinement = has_interior_equations || problem.name() == "satellite_angles";
  std::unique_ptr<KktSystem> kkt = std::move(*made);
  if (needs_refinement) kkt = std::make_unique<RefinedKkt>(program, std::move(kkt), 1e-10);
  const Eigen::VectorXd x =
      sample(program, guessed_motion(problem)) + random_vector(program.variable_count(), 1e-2, generator);
  const KktNumbers numbers = numbers_at(program, x, 1e-2, 10.0, generator);
  const DenseKkt dense(program, numbers);
  const DenseKkt::Inertia inertia = dense.inertia();
  const bool is_minimum = inertia.smallest > 0.0 && inertia.rank > 1e-12;

  const auto n = static_cast<Eigen::Index>(program.variable_count());
  const auto m = static_cast<Eigen::Index>(program.constraint_count());
  Eigen::VectorXd primal(n);
  Eigen::VectorXd multipliers(m);
  const FactorisationStatus verdict =
      kkt->solve(numbers.matrix(), {numbers.gradient, numbers.rows}, {primal, multipliers});
  EXPECT_EQ(verdict == FactorisationStatus::solved, is_minimum) << static_cast<int>(verdict);
  if (verdict != FactorisationStatus::solved) return false;
  if (needs_refinement) {
    EXPECT_EQ(static_cast<const RefinedKkt&>(*kkt).fallbacks(), 0);
  }
  const Eigen::VectorXd wanted = dense.solution();
  expect_equal(primal, wanted.head(n), dense);
  expect_equal(multipliers, wanted.tail(m), dense);
  return true;
}

TEST(IntervalKkt, AgreesWithDenseLinearAlgebraOnEveryProblemAndScheme) {
  for (const std::string& name : problem_names()) {
    const auto problem = make_problem(name);
    for (const tests::Scheme& scheme : tests::all_schemes(2)) {
      if (!tests::takes_constraints(*problem, scheme)) continue;
      for (const int intervals : {8, 10}) expect_agreement(*problem, scheme, intervals, CostForm::bolza);
    }
  }
}

/// Sizes that the kernel works on in tiles and blocks, whole ones and what is left of them: of DMOC, of collocation,
/// and of two stages, whose equalities determine more than the next node.
TEST(IntervalKkt, AgreesWithDenseLinearAlgebraOnChainsOfManyLinks) {
  const auto chain = make_problem("link_chain");
  for (int links = 4; links <= 13; ++links) {
    chain->set_parameter("links", links);
    EXPECT_TRUE(expect_agreement(*chain, {"dmoc", 1}, 9, CostForm::bolza));
    if (links % 3 == 1) {
      EXPECT_TRUE(expect_agreement(*chain, {"hamiltonian", 1}, 8, CostForm::bolza));
    }
    if (links % 4 == 1) {
      EXPECT_TRUE(expect_agreement(*chain, {"dmoc", 2}, 8, CostForm::bolza));
    }
  }
}

TEST(IntervalKkt, AgreesWithDenseLinearAlgebraWhereNodesBetweenTheEndsAreGiven) {
  const auto waypoints = make_problem("waypoints");
  for (const char* method : {"dmoc", "hamiltonian", "tangent"}) {
    EXPECT_TRUE(expect_agreement(*waypoints, {method, 1}, 24, CostForm::bolza));
    EXPECT_TRUE(expect_agreement(*waypoints, {method, 2}, 36, CostForm::bolza));
  }
}

TEST(IntervalKkt, AgreesWithDenseLinearAlgebraWhereEverythingIsStated) {
  const tests::Everything everything;
  for (const tests::Scheme& scheme : tests::all_schemes(3)) {
    expect_agreement(everything.problem(), scheme, 11, CostForm::bolza);
    expect_agreement(everything.problem(), scheme, 11, CostForm::mayer);
  }
  for (const tests::Scheme& scheme : tests::schemes_with_shared_controls(3)) {
    expect_agreement(everything.problem(), scheme, 11, CostForm::bolza);
  }
}

}  // namespace
}  // namespace dmocbench::kkt
