#pragma once

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench::tests {

/// The numbers that a problem's formulas have at a point.
inline Eigen::VectorXd formulas_at(const Problem& problem, const MotionPoint& point, double t,
                                   const std::function<ExpressionVector(const ControlledState&)>& formulas) {
  PointFunction function(problem.configuration_size(), problem.control_size(), formulas);
  Eigen::VectorXd values(function.output_count());
  function.evaluate(point.q, point.v, point.u, t, values);
  return values;
}

inline double lagrangian_at(const Problem& problem, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                            double t = 0.0) {
  return formulas_at(problem, {q, v, {}}, t, [&](const ControlledState& x) {
    return ExpressionVector::Constant(1, problem.lagrangian(x.state()));
  })[0];
}

inline Eigen::VectorXd force_at(const Problem& problem, const MotionPoint& point, double t = 0.0) {
  return formulas_at(problem, point, t, [&](const ControlledState& x) { return problem.force(x); });
}

inline double running_cost_at(const Problem& problem, const MotionPoint& point, double t = 0.0) {
  return formulas_at(problem, point, t, [&](const ControlledState& x) {
    return ExpressionVector::Constant(1, problem.running_cost(x));
  })[0];
}

inline Eigen::VectorXd generator_at(const Problem& problem, const Eigen::VectorXd& q) {
  return formulas_at(problem, {q, Eigen::VectorXd::Zero(q.size()), {}}, 0.0,
                     [&](const ControlledState& x) { return tests::value_of(problem.symmetry(x.q)); });
}

/// L is the same formula where the configuration is moved along the generator of the symmetry, which is constant.
inline void expect_translation(const Problem& problem) {
  const Eigen::Index n = problem.configuration_size();
  const auto free = static_cast<std::size_t>(2 * n);
  const State x{input_vector(0, n), input_vector(n, n), Expression::input(free)};
  State moved = x;
  moved.q = x.q + Expression::input(free + 1) * value_of(problem.symmetry(x.q));
  EXPECT_TRUE(problem.lagrangian(moved).is_same(problem.lagrangian(x)));
}

/// Both ends are equilibria at rest.
inline void expect_equilibrium_at_ends(const Problem& problem, double rounding) {
  EquationsOfMotion motion{TracedProblem(problem)};
  for (const BoundaryState& state : {problem.initial_state(), problem.final_state()}) {
    EXPECT_EQ(state.v.norm(), 0.0);
    EXPECT_LT(motion.acceleration(state.q, state.v, Eigen::VectorXd::Zero(problem.control_size()), 0.0).norm(),
              rounding);
  }
}

/// What a picture shows at a point, by name.
inline std::map<std::string, double> picture_at(const Problem& problem, const MotionPoint& point, double t = 0.0) {
  std::vector<std::string> names;
  const Eigen::VectorXd values = formulas_at(problem, point, t, [&](const ControlledState& x) {
    names.clear();
    const Picture quantities = pictured_quantities(problem, x);
    ExpressionVector formulas(static_cast<Eigen::Index>(quantities.size()));
    for (std::size_t i = 0; i < quantities.size(); ++i) {
      formulas[static_cast<Eigen::Index>(i)] = quantities[i].value;
      names.push_back(quantities[i].name);
    }
    return formulas;
  });
  std::map<std::string, double> named;
  for (std::size_t i = 0; i < names.size(); ++i) named[names[i]] = values[static_cast<Eigen::Index>(i)];
  return named;
}

}  // namespace dmocbench::tests
