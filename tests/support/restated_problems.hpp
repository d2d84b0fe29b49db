#pragma once

#include <functional>
#include <limits>

#include "methods/mechanics/forwarding_problem.hpp"
#include "tests/support/problems_for_tests.hpp"

namespace dmocbench::tests {

/// Another problem with some of what it prescribes said in another way; `state` changes what is to be changed.
class Restated final : public ForwardingProblem {
 public:
  struct Statement : ProblemBounds {
    std::function<ExpressionVector(const ControlledState&)> path_constraints;
    std::function<ExpressionVector(const State&, const State&)> conditions;
    std::function<Expression(const State&)> final_cost;
    std::function<Expression(const ControlledState&)> running_cost;
    std::function<ExpressionVector(const ControlledState&)> integrands;
  };

  explicit Restated(const Problem& base, const std::function<void(Statement&)>& state) : ForwardingProblem(base) {
    const ProblemBounds bounds = base.bounds();
    statement_.first = bounds.first;
    statement_.last = bounds.last;
    statement_.horizon = bounds.horizon;
    state(statement_);
  }
  /// Without the names of other constraints.
  [[nodiscard]] ProblemCard card() const override { return Problem::card(); }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return statement_.running_cost ? statement_.running_cost(x) : original().running_cost(x);
  }
  [[nodiscard]] ProblemBounds bounds() const override { return static_cast<const ProblemBounds&>(statement_); }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& x) const override {
    return statement_.path_constraints ? statement_.path_constraints(x) : ExpressionVector();
  }
  [[nodiscard]] ExpressionVector integrands(const ControlledState& x) const override {
    return statement_.integrands ? statement_.integrands(x) : ExpressionVector();
  }
  [[nodiscard]] ExpressionVector boundary_conditions(const State& first, const State& last) const override {
    return statement_.conditions ? statement_.conditions(first, last) : ExpressionVector();
  }
  [[nodiscard]] Expression final_cost(const State& last) const override {
    return statement_.final_cost ? statement_.final_cost(last) : Expression(0.0);
  }
  [[nodiscard]] MotionPoint guess(double t) const override { return Problem::guess(t); }

 private:
  Statement statement_;
};

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bounds with the same numbers for each of `size` entries.
inline Bounds all_between(Eigen::Index size, double lower, double upper) {
  return {Eigen::VectorXd::Constant(size, lower), Eigen::VectorXd::Constant(size, upper)};
}

/// Nothing prescribed at an end of n degrees of freedom.
inline EndBounds free_end(Eigen::Index n) { return {Bounds::none(n), Bounds::none(n)}; }

/// Everything that a problem may state, at once: the moving frame with ends that are free, bounded and tied to each
/// other, a free horizon, bounds on q, v and u, path constraints and a final cost that depends on q, v and T.
class Everything {
 public:
  Everything()
      : problem_(base_, [](Restated::Statement& s) {
          s.first.free_velocity(1);
          s.last.free_configuration(0).free_velocity(0).free_velocity(1);
          s.last.v.upper[1] = 2.0;
          s.horizon = {0.5, 2.5};
          s.q = all_between(2, -3.0, 3.0);
          s.v = Bounds{Eigen::Vector2d(-infinity, -2.0), Eigen::Vector2d(infinity, 2.0)};
          s.u = all_between(2, -4.0, 4.0);
          s.path_constraints = [](const ControlledState& x) {
            ExpressionVector h(2);
            h << 9.0 - x.q[0] * x.v[1] - x.u[0] * x.u[0] * x.t, 5.0 + x.q[1] - sin(x.v[0]);
            return h;
          };
          s.conditions = [](const State& first, const State& last) {
            return ExpressionVector::Constant(1, last.v[0] * last.q[0] - first.v[1] * first.q[0] * last.t);
          };
          s.final_cost = [](const State& last) {
            return last.t * last.t + 0.5 * last.v[0] * last.v[0] * last.q[0] + last.v[1] * last.t;
          };
        }) {}
  [[nodiscard]] const Problem& problem() const { return problem_; }

 private:
  MovingFrame base_;
  Restated problem_;
};

}  // namespace dmocbench::tests
