#include "methods/diagnostics/one_step_map.hpp"

#include <gtest/gtest.h>

#include "methods/diagnostics/discrete_lagrangian.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using Map = OneStepMap<double>;

struct Point {
  Eigen::VectorXd q, v, p;
  Eigen::MatrixXd controls;
};

Point some_point(const Problem& problem, Eigen::Index stages) {
  tests::RandomPoints random;
  const BoundaryState first = problem.initial_state();
  Point point;
  point.q = first.q + random.vector(first.q.size(), -0.1, 0.1);
  point.v = first.v + random.vector(first.v.size(), -0.1, 0.1);
  point.p = LegendreTransform(TracedProblem(problem)).momentum(point.q, point.v, 0.1);
  point.controls = random.vector(stages * problem.control_size()).reshaped(stages, problem.control_size());
  return point;
}

class OneStepMapTest : public testing::TestWithParam<std::tuple<std::string, int>> {
 protected:
  [[nodiscard]] static std::string method() { return std::get<0>(GetParam()); }
  [[nodiscard]] static Tableau tableau() { return gauss_tableau(std::get<1>(GetParam())); }
};

TEST_P(OneStepMapTest, JacobianIsThatOfCentralDifferences) {
  const tests::MovingFrame problem;
  const Map map(TracedProblem(problem), *make_element(method()), tableau());
  const Point at = some_point(problem, tableau().stages());
  const Map::Matrix jacobian = map.jacobian(map.advance(at.q, at.p, at.v, at.controls, 0.2, 0.1));
  constexpr double step = 1e-5;
  for (Eigen::Index j = 0; j < 4; ++j) {
    const auto moved = [&](double offset) {
      Point other = at;
      (j < 2 ? other.q[j] : other.p[j - 2]) += offset;
      const Map::Step result = map.advance(other.q, other.p, at.v, at.controls, 0.2, 0.1);
      Eigen::VectorXd end(4);
      end << result.q, result.p;
      return end;
    };
    const Eigen::VectorXd difference = (moved(step) - moved(-step)) / (2.0 * step);
    EXPECT_LT((difference - jacobian.col(j)).norm(), 1e-8) << "column " << j;
  }
}

TEST_P(OneStepMapTest, ImpulseOfAConstantForceIsForceTimesStep) {
  const tests::DoubleIntegrator problem;
  const Map map(TracedProblem(problem), *make_element(method()), tableau());
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(1);
  const Map::Step step = map.advance(rest, rest, rest, Eigen::MatrixXd::Constant(tableau().stages(), 1, 3.0), 0.5, 0.0);
  EXPECT_NEAR(step.impulse[0], 1.5, 1e-14);
  EXPECT_NEAR(step.p[0], 1.5, 1e-14);
  EXPECT_NEAR(step.q[0], 0.375, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Elements, OneStepMapTest,
                         testing::Combine(testing::ValuesIn(paper_families()), testing::Values(1, 2, 3)));

TEST(OneStepMap, OfDmocIsThatOfHamiltonianCollocation) {
  const tests::MovingFrame problem;
  for (const int stages : {1, 2, 3}) {
    const Point at = some_point(problem, stages);
    const auto end = [&](const std::string& method) {
      return Map(TracedProblem(problem), *make_element(method), gauss_tableau(stages))
          .advance(at.q, at.p, at.v, at.controls, 0.2, 0.1);
    };
    const Map::Step dmoc = end("dmoc");
    const Map::Step hamiltonian = end("hamiltonian");
    EXPECT_LT((dmoc.q - hamiltonian.q).norm(), 1e-13);
    EXPECT_LT((dmoc.p - hamiltonian.p).norm(), 1e-13);
  }
}

TEST(OneStepMap, OfDmocIsGeneratedByTheDiscreteLagrangianAndForces) {
  const auto problem = make_problem("two_link_manipulator");
  const Point at = some_point(*problem, 2);
  const OneStepMap<long double> map(TracedProblem(*problem), *make_element("dmoc"), gauss_tableau(2));
  const LongVector q_0 = at.q.cast<long double>();
  const LongMatrix controls = at.controls.cast<long double>();
  const auto step = map.advance(q_0, at.p.cast<long double>(), at.v.cast<long double>(), controls, 0.1L, 0.0L);
  const DiscreteObjects objects = DiscreteLagrangian(*problem, gauss_tableau(2)).at(q_0, step.q, controls, 0.1L, 0.0L);
  EXPECT_LT((objects.left_momentum - at.p.cast<long double>()).norm(), 1e-15L);
  EXPECT_LT((objects.right_momentum - step.p).norm(), 1e-15L);
}

TEST(OneStepMap, SaysThatTheStepIsTooLargeWhereThereIsNoRoot) {
  const tests::RelativisticSpring problem;
  const Map map(TracedProblem(problem), *make_element("dmoc"), gauss_tableau(1));
  const auto one = [](double entry) { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, entry)); };
  tests::expect_error_naming({"does not converge", "step"}, [&] {
    static_cast<void>(map.advance(one(0.0), one(1e9), one(2.0), Eigen::MatrixXd::Zero(1, 1), 1.0, 0.0));
  });
}

}  // namespace
}  // namespace dmocbench
