#pragma once

#include <span>
#include <string>
#include <vector>

#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A problem in minimal coordinates θ, restated in more coordinates q = Φ(θ) with constraints g(q) = 0: the same
/// motions, controls, ends, cost and optimum. The minimal statement has the parameters.
template <class Minimal>
class RedundantStatement : public Problem {
 public:
  /// The minimal statement's.
  [[nodiscard]] std::vector<std::string> control_names() const override { return Minimal().control_names(); }
  /// The minimal statement's, lifted.
  [[nodiscard]] BoundaryState initial_state() const override { return lifted(minimal().initial_state()); }
  /// The minimal statement's, lifted.
  [[nodiscard]] BoundaryState final_state() const override { return lifted(minimal().final_state()); }
  /// The minimal statement's.
  [[nodiscard]] double horizon() const override { return parameter("horizon"); }
  /// The minimal statement's.
  [[nodiscard]] double cost_scale() const override { return minimal().cost_scale(); }
  /// The minimal statement's, lifted.
  [[nodiscard]] MotionPoint guess(double t) const override {
    const MotionPoint point = minimal().guess(t);
    const BoundaryState state = lifted({.q = point.q, .v = point.v});
    return {state.q, state.v, point.u};
  }

  /// (Φ(θ), Φ'(θ) θ̇).
  [[nodiscard]] BoundaryState lifted(const BoundaryState& state) const {
    InputCounter inputs;
    const ExpressionVector theta = inputs.take(state.q.size());
    const ExpressionVector rates = inputs.take(state.v.size());
    const ExpressionVector q = embedding(theta);
    const ExpressionVector v = jacobian(q, theta) * rates;
    std::vector<Expression> outputs;
    append(outputs, q);
    append(outputs, v);
    std::vector<double> numbers(state.q.begin(), state.q.end());
    numbers.insert(numbers.end(), state.v.begin(), state.v.end());
    const std::vector<double> values = replay<double>(Schedule(outputs), std::span<const double>(numbers));
    const Eigen::Map<const Eigen::VectorXd> all(values.data(), 2 * q.size());
    return {.q = all.head(q.size()), .v = all.tail(q.size())};
  }

  /// The minimal statement with these parameters.
  [[nodiscard]] Minimal minimal() const {
    Minimal problem;
    for (const Parameter& own : parameters()) problem.set_parameter(own.name, parameter(own.name));
    return problem;
  }

 protected:
  RedundantStatement() : Problem(Minimal().parameters()) {}
};

}  // namespace dmocbench
