#include "methods/mechanics/traced_problem.hpp"

#include <functional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "methods/expression/replay.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using Long = long double;
using LongVector = Eigen::Matrix<Long, Eigen::Dynamic, 1>;

ControlledState inputs(Eigen::Index n, Eigen::Index m) {
  const auto first = static_cast<std::size_t>(n);
  return {input_vector(0, n), input_vector(first, n), input_vector(2 * first, m),
          Expression::input(2 * first + static_cast<std::size_t>(m))};
}

/// Formulas of the inputs evaluated in long double.
LongVector evaluate(const ExpressionVector& formulas, const LongVector& point) {
  const std::vector<Long> values =
      replay<Long>(Schedule(formulas), std::span<const Long>(point.data(), static_cast<std::size_t>(point.size())));
  return Eigen::Map<const LongVector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// Richardson's extrapolation of central differences in entry `i` of the point, in long double: error about 1e-14.
LongVector difference(const std::function<LongVector(const LongVector&)>& f, const LongVector& point, Eigen::Index i) {
  const auto central = [&](Long e) -> LongVector {
    LongVector forward = point;
    LongVector backward = point;
    forward[i] += e;
    backward[i] -= e;
    return (f(forward) - f(backward)) / (2.0L * e);
  };
  constexpr Long e = 1e-3L;
  return (64.0L * central(e / 4.0L) - 20.0L * central(e / 2.0L) + central(e)) / 45.0L;
}

double distance(const LongVector& a, const LongVector& b) {
  return static_cast<double>((a - b).lpNorm<Eigen::Infinity>() / (1.0L + b.lpNorm<Eigen::Infinity>()));
}

TEST(TracedProblem, DerivativesAgreeWithDifferencesOfTheLagrangian) {
  constexpr double tolerance = 1e-12;
  tests::RandomPoints random;
  for (const auto& problem : tests::problems()) {
    SCOPED_TRACE(problem->name());
    const TracedProblem traced(*problem);
    const Eigen::Index n = traced.configuration_size();
    const Eigen::Index m = traced.control_size();
    const ControlledState x = inputs(n, m);
    const TracedProblem::Values values = traced.at(x);
    const auto lagrangian = [&](const LongVector& at) {
      return evaluate(ExpressionVector::Constant(1, problem->lagrangian(x.state())), at);
    };
    const auto momentum = [&](const LongVector& at) { return evaluate(values.momentum, at); };
    LongVector point = random.vector(2 * n + m + 1, 0.4, 0.7).cast<Long>();
    const LongVector p = momentum(point);
    const LongVector l_q = evaluate(values.configuration_force, point);
    const LongVector mass = evaluate(values.mass.reshaped(), point);
    const LongVector l_vq = evaluate(values.momentum_by_configuration.reshaped(), point);
    for (Eigen::Index i = 0; i < n; ++i) {
      EXPECT_LT(distance(p.segment(i, 1), difference(lagrangian, point, n + i)), tolerance);
      EXPECT_LT(distance(l_q.segment(i, 1), difference(lagrangian, point, i)), tolerance);
      EXPECT_LT(distance(mass.segment(i * n, n), difference(momentum, point, n + i)), tolerance);
      EXPECT_LT(distance(l_vq.segment(i * n, n), difference(momentum, point, i)), tolerance);
    }
    EXPECT_LT(distance(evaluate(values.momentum_by_time, point), difference(momentum, point, 2 * n + m)), tolerance);
  }
}

TEST(TracedProblem, ForcesAndCostAreTheProblemsOwn) {
  for (const auto& problem : tests::problems()) {
    const TracedProblem traced(*problem);
    const ControlledState x = inputs(traced.configuration_size(), traced.control_size());
    const TracedProblem::Values values = traced.at(x);
    const ExpressionVector force = problem->force(x);
    // The same node means the same formula: equal nodes are shared.
    EXPECT_TRUE(values.running_cost.is_same(problem->running_cost(x))) << problem->name();
    for (Eigen::Index i = 0; i < force.size(); ++i) {
      EXPECT_TRUE(values.control_force[i].is_same(force[i])) << problem->name();
      EXPECT_TRUE(values.generalised_force[i].is_same(values.configuration_force[i] + force[i]));
    }
  }
}

TEST(TracedProblem, TheTableHoldsTheFormulasAtEveryPoint) {
  constexpr double tolerance = 1e-14;
  tests::RandomPoints random;
  for (const auto& problem : tests::problems()) {
    SCOPED_TRACE(problem->name());
    const TracedProblem traced(*problem);
    const Eigen::Index n = traced.configuration_size();
    const Eigen::Index m = traced.control_size();
    const TracedProblem::Values values = traced.at(inputs(n, m));
    ExpressionVector formulas(3 * n + 1 + traced.path_constraint_count() + n * n);
    formulas << values.momentum, values.configuration_force, values.control_force,
        ExpressionVector::Constant(1, values.running_cost), values.path_constraints, values.mass.reshaped();
    std::vector<MotionPoint> points;
    points.reserve(3);
    for (int i = 0; i < 3; ++i) {
      points.push_back({random.vector(n, 0.4, 0.7), random.vector(n, 0.4, 0.7), random.vector(m, 0.4, 0.7)});
    }
    const Eigen::VectorXd times = random.vector(3, 0.4, 0.7);
    const Eigen::MatrixXd table = traced.table(points, times);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const MotionPoint& point = points[static_cast<std::size_t>(i)];
      LongVector numbers(2 * n + m + 1);
      numbers << point.q.cast<Long>(), point.v.cast<Long>(), point.u.cast<Long>(), static_cast<Long>(times[i]);
      const LongVector row = table.row(i).head(formulas.size()).transpose().cast<Long>();
      EXPECT_LT(distance(row, evaluate(formulas, numbers)), tolerance);
    }
  }
}

TEST(TracedProblem, AtSubstitutesThePointIntoEveryFormula) {
  const tests::MovingFrame problem;
  const TracedProblem traced(problem);
  const ControlledState x = inputs(2, 2);
  ControlledState moved = x;
  moved.q = x.q + Expression(0.25) * x.v;
  moved.t = x.t + 0.125;
  const LongVector point = tests::RandomPoints().vector(7).cast<Long>();
  LongVector moved_point = point;
  moved_point.head(2) += 0.25L * point.segment(2, 2);
  moved_point[6] += 0.125L;
  EXPECT_LT(distance(evaluate(traced.at(moved).momentum, point), evaluate(traced.at(x).momentum, moved_point)), 1e-17);
  EXPECT_LT(distance(evaluate(traced.at(moved).generalised_force, point),
                     evaluate(traced.at(x).generalised_force, moved_point)),
            1e-17);
}

TEST(TracedProblem, CarriesTheSymmetryAndItsJacobian) {
  const TracedProblem traced{tests::CentralForce()};
  ASSERT_TRUE(traced.has_symmetry());
  const TracedProblem::Values values = traced.at(inputs(2, 2));
  EXPECT_EQ(values.symmetry_jacobian(0, 1).constant_value(), -1.0);
  EXPECT_EQ(values.symmetry_jacobian(1, 0).constant_value(), 1.0);
  EXPECT_TRUE(values.symmetry_jacobian(0, 0).is_zero());
  EXPECT_FALSE(TracedProblem(tests::Pendulum()).has_symmetry());
}

/// Two degrees of freedom with one wrong answer.
class Wrong final : public tests::SmallProblem {
 public:
  enum class Kind { none, force, symmetry, lagrangian };
  explicit Wrong(Kind kind)
      : SmallProblem("wrong", {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()},
                     {Eigen::Vector2d::Ones(), Eigen::Vector2d::Zero()}, 1.0, 2),
        kind_(kind) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression first = 0.5 * x.v[0] * x.v[0];
    return kind_ == Kind::lagrangian ? first + x.v[1] * x.q[0] : first + 0.5 * x.v[1] * x.v[1];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return kind_ == Kind::force ? ExpressionVector(x.u.head(1)) : ExpressionVector(x.u);
  }
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector&) const override {
    return ExpressionVector(kind_ == Kind::symmetry ? 3 : 2);
  }

 private:
  Kind kind_;
};

TEST(TracedProblem, RefusesWrongDimensionsNamingTheFunction) {
  const auto trace = [](Wrong::Kind kind) { return [kind] { TracedProblem{Wrong(kind)}; }; };
  EXPECT_NO_THROW(trace(Wrong::Kind::none)());
  tests::expect_error_naming({"wrong", "force", "1", "2"}, trace(Wrong::Kind::force));
  tests::expect_error_naming({"wrong", "symmetry", "3", "2"}, trace(Wrong::Kind::symmetry));
}

TEST(TracedProblem, RefusesALagrangianThatIsNotRegularNamingTheCoordinate) {
  tests::expect_error_naming({"wrong", "L_vv", "q2"}, [] { TracedProblem{Wrong(Wrong::Kind::lagrangian)}; });
}

}  // namespace
}  // namespace dmocbench
