#include "methods/diagnostics/element_identities.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "methods/diagnostics/one_step_map.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

namespace {

using Number = long double;
using IdentityMap = OneStepMap<Number>;
using NumberVector = IdentityMap::Vector;
using NumberMatrix = IdentityMap::Matrix;

constexpr Eigen::Index degrees = 2;  // of freedom; as many controls

/// Two coupled pendulums, one of them in a field that oscillates: every term of the equations of motion occurs.
class IdentitySystem final : public Problem {
 public:
  [[nodiscard]] std::string name() const override { return "identity_system"; }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"q1", "q2"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u1", "u2"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression coupling = cos(x.q[0] - x.q[1]) * x.v[0] * x.v[1] + sin(x.t) * x.q[0] * x.v[1];
    return x.v[0] * x.v[0] + 0.5 * x.v[1] * x.v[1] + coupling + cos(x.q[0]) + 0.5 * cos(x.q[1]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u - 0.2 * x.v; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return 0.5 * (x.u[0] * x.u[0] + x.u[1] * x.u[1]) + x.q[0] * x.v[1];
  }
  [[nodiscard]] BoundaryState initial_state() const override {
    return BoundaryState::at_rest(Eigen::VectorXd::Zero(degrees));
  }
  [[nodiscard]] BoundaryState final_state() const override { return initial_state(); }
  [[nodiscard]] double horizon() const override { return 1.0; }
};

/// A motion of the system that is given in formulas of t, and the controls that cause it.
class ExactMotion {
 public:
  struct Point {
    NumberVector q, v, p, u;
    Number running_cost = 0;
  };

  explicit ExactMotion(const TracedProblem& problem) {
    const Expression t = Expression::input(0);
    const ExpressionVector time = ExpressionVector::Constant(1, t);
    const ExpressionVector q{{0.8 * sin(2.0 * t), 0.5 * cos(3.0 * t)}};
    const ExpressionVector v = jacobian(q, time).col(0);
    const ExpressionVector acceleration = jacobian(v, time).col(0);
    const TracedProblem::Values values = problem.at(State{q, v, t});
    ExpressionVector u = values.mass * acceleration + values.momentum_by_time - values.generalised_force;
    u += values.momentum_by_configuration * v;
    std::vector<Expression> outputs;
    for (const ExpressionVector& part : {q, v, values.momentum, u}) append(outputs, part);
    outputs.push_back(problem.at(ControlledState{q, v, u, t}).running_cost);
    formulas_ = Schedule(outputs);
  }

  [[nodiscard]] Point at(Number t) const {
    OutputBlocks<Number> blocks(formulas_, {t});
    Point point;
    for (NumberVector* part : {&point.q, &point.v, &point.p, &point.u}) *part = blocks.take(degrees);
    point.running_cost = blocks.take(1)(0);
    return point;
  }

  /// Row i is the control at stage i of a tableau on the interval.
  [[nodiscard]] NumberMatrix controls(const Tableau& tableau, Number t, Number h) const {
    NumberMatrix rows(tableau.stages(), degrees);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) = at(t + Number(tableau.c[i]) * h).u;
    return rows;
  }

  /// The cost of an interval, by a quadrature of order 20.
  [[nodiscard]] Number cost(Number t, Number h) const {
    static const Tableau fine = collocation_tableau("", gauss_nodes(10), 20);
    Number sum = 0;
    for (Eigen::Index i = 0; i < fine.stages(); ++i) {
      sum += Number(fine.b[i]) * at(t + Number(fine.c[i]) * h).running_cost;
    }
    return h * sum;
  }

 private:
  Schedule formulas_;
};

/// The element's formulas on the system. Their inputs are `OneStepMap::Step::inputs`.
struct TracedInterval {
  TracedInterval(const TracedProblem& problem, const Element& element, const Tableau& tableau) {
    InputCounter counter;
    unknowns = take_unknowns(counter, problem, element, tableau);
    solved_for = static_cast<Eigen::Index>(counter.taken()) - degrees - element.controls(tableau).stages() * degrees;
    unknowns.h = counter.take();
    unknowns.t = counter.take();
    start_momentum = counter.take(degrees);
    inputs = counter.taken();
    trace = element.trace(problem, tableau, unknowns);
  }

  IntervalUnknowns unknowns;
  ExpressionVector start_momentum;  // p
  Eigen::Index solved_for;          // unknowns besides q_k and the controls
  std::size_t inputs;
  IntervalTrace trace;
};

/// Numbers of order 1 in no order, to insert for inputs; positive at the place of h.
std::vector<Number> arbitrary_inputs(const TracedInterval& interval) {
  std::vector<Number> inputs(interval.inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) inputs[i] = std::sin(Number(1 + i * i));
  inputs[inputs.size() - 4] = Number(0.2);
  return inputs;
}

Number largest_value(const ExpressionVector& formulas, const TracedInterval& interval) {
  if (formulas.size() == 0) return 0;
  const NumberMatrix values =
      OutputBlocks<Number>(Schedule(formulas), arbitrary_inputs(interval)).take(formulas.size());
  return values.allFinite() ? values.lpNorm<Eigen::Infinity>() : std::numeric_limits<Number>::infinity();
}

std::vector<std::string> broken_counts(const TracedInterval& interval, const Element& element, const Tableau& tableau) {
  const IntervalTrace& trace = interval.trace;
  std::vector<std::string> broken;
  const auto expect = [&](Eigen::Index size, Eigen::Index expected, const char* what) {
    if (size != expected) broken.push_back(fmt::format("counts: {} {}, expected {}", size, what, expected));
  };
  const Eigen::Index of_node = element.node_state() == NodeState::configuration ? degrees : 0;
  expect(trace.left_rows.size(), of_node, "entries of left_rows");
  expect(trace.right_rows.size(), of_node, "entries of right_rows");
  // The unknowns without the left node's second part, for which the momentum at the start stands.
  expect(trace.stage_equations.size() + degrees, interval.solved_for, "equations of an interval and its start");
  expect(trace.left_momentum.size(), degrees, "entries of left_momentum");
  expect(trace.right_momentum.size(), degrees, "entries of right_momentum");
  expect(std::ssize(trace.stages), tableau.stages(), "stages");
  if (!broken.empty()) return broken;
  const Tableau controls = element.controls(tableau);
  for (Eigen::Index i = 0; i < tableau.stages(); ++i) {
    const ControlledState& stage = trace.stages[static_cast<std::size_t>(i)];
    ExpressionVector misses(degrees + 1);
    misses << stage.u - polynomial_at(controls.c, interval.unknowns.controls, tableau.c[i]),
        stage.t - interval.unknowns.t - Expression(tableau.c[i]) * interval.unknowns.h;
    if (largest_value(misses, interval) > Number(1e-14)) {
      broken.push_back(fmt::format("counts: stage {} is not at t_k + c_i h, or its control is not U_i", i + 1));
    }
  }
  return broken;
}

/// The largest error of q, p and cost after a step of length h; not a number if the step is too long to be solved.
Number error_of_step(const IdentityMap& map, const Schedule& cost, const ExactMotion& motion, const Tableau& tableau,
                     Number h) {
  NumberVector largest = NumberVector::Zero(2 * degrees + 1);
  for (const Number t : {Number(0.1), Number(0.9), Number(1.7)}) {
    const ExactMotion::Point left = motion.at(t);
    const ExactMotion::Point right = motion.at(t + h);
    NumberVector misses(largest.size());
    try {
      const auto step = map.advance(left.q, left.p, left.v, motion.controls(tableau, t, h), h, t);
      misses << step.q - right.q, step.p - right.p,
          OutputBlocks<Number>(cost, step.inputs).take(1)(0) - motion.cost(t, h);
    } catch (const Error&) {
      return std::numeric_limits<Number>::quiet_NaN();
    }
    if (!misses.allFinite()) return std::numeric_limits<Number>::quiet_NaN();
    largest = largest.cwiseMax(misses.cwiseAbs());
  }
  return largest.maxCoeff();
}

std::vector<std::string> broken_consistency(const IdentityMap& map, const Schedule& cost, const ExactMotion& motion,
                                            const Tableau& tableau, int order) {
  constexpr Number rounding = 1e-14;
  constexpr Number margin = 0.35;  // of a measured order
  Number error = std::numeric_limits<Number>::quiet_NaN();
  Number measured = error;  // by the last two steps
  Number h = 0.4;
  for (int halvings = 0; halvings <= 5; ++halvings, h /= 2) {
    const Number finer = error_of_step(map, cost, motion, tableau, h);
    if (finer < rounding) return {};
    measured = std::log2(error / finer);
    error = finer;
  }
  if (std::isnan(measured)) return {"consistency: the equations of an interval cannot be solved for its right node"};
  if (measured > Number(order + 1) - margin) return {};
  return {fmt::format(
      "consistency: the error of one step of length h decreases as h^{:.2f}, not as h^{}; it is {:.1e} for h = 0.0125",
      static_cast<double>(measured), order + 1, static_cast<double>(error))};
}

std::vector<std::string> broken_momenta(const TracedInterval& interval, const TracedProblem& problem, NodeState state) {
  const IntervalTrace& trace = interval.trace;
  const IntervalUnknowns& unknowns = interval.unknowns;
  const auto expected = [&](const ExpressionVector& rows, const ExpressionVector& q, const ExpressionVector& second,
                            const Expression& t) -> ExpressionVector {
    if (state == NodeState::configuration) return rows;
    return state == NodeState::momentum ? second : problem.at(State{q, second, t}).momentum;
  };
  const ExpressionVector left = expected(-trace.left_rows, unknowns.left_q, unknowns.left_second, unknowns.t);
  const ExpressionVector right =
      expected(trace.right_rows, unknowns.right_q, unknowns.right_second, unknowns.t + unknowns.h);
  std::vector<std::string> broken;
  const auto expect = [&](const ExpressionVector& difference, const char* what, const char* from) {
    const Number largest = largest_value(difference, interval);
    if (largest < Number(1e-13)) return;
    broken.push_back(fmt::format("momenta: {} differs from {} by {:.1e}", what, from, static_cast<double>(largest)));
  };
  const bool has_rows = state == NodeState::configuration;
  expect(trace.left_momentum - left, "left_momentum", has_rows ? "-left_rows" : "the momentum of the left node");
  expect(trace.right_momentum - right, "right_momentum", has_rows ? "right_rows" : "the momentum of the right node");
  return broken;
}

/// The cost to go c + w·(q_{k+1}, p_{k+1}⁺) and its gradient by (q_k, p_k), by multipliers.
class CostToGo {
 public:
  explicit CostToGo(const TracedInterval& interval) : size_(interval.solved_for) {
    const IntervalTrace& trace = interval.trace;
    const Expression value = trace.cost + Expression(0.7) * interval.unknowns.right_q[0] -
                             Expression(0.4) * interval.unknowns.right_q[1] +
                             Expression(1.1) * trace.right_momentum[0] + Expression(0.3) * trace.right_momentum[1];
    ExpressionVector equations(size_);
    equations << trace.left_momentum - interval.start_momentum, trace.stage_equations;
    const ExpressionVector solved = input_vector(degrees, size_);
    const ExpressionVector values = ExpressionVector::Constant(1, value);
    std::vector<Expression> outputs{value};
    for (const ExpressionVector& x : {solved, interval.unknowns.left_q}) {
      append(outputs, jacobian(equations, x));
      append(outputs, jacobian(values, x));
    }
    formulas_ = Schedule(outputs);
  }

  [[nodiscard]] Number value(const IdentityMap::Step& step) const {
    return OutputBlocks<Number>(formulas_, step.inputs).take(1)(0);
  }

  [[nodiscard]] NumberVector gradient(const IdentityMap::Step& step) const {
    OutputBlocks<Number> blocks(formulas_, step.inputs);
    static_cast<void>(blocks.take(1));
    const NumberMatrix equations_by_solved = blocks.take(size_, size_).transpose();
    const NumberVector value_by_solved = blocks.take(1, size_).transpose();
    const NumberMatrix equations_by_q = blocks.take(size_, degrees);
    const NumberVector value_by_q = blocks.take(1, degrees).transpose();
    const NumberVector multipliers = -solve_square(equations_by_solved, value_by_solved);
    NumberVector gradient(2 * degrees);
    gradient << value_by_q + equations_by_q.transpose().lazyProduct(multipliers), -multipliers.head(degrees);
    return gradient;
  }

 private:
  Eigen::Index size_;
  Schedule formulas_;
};

std::vector<std::string> broken_costates(const IdentityMap& map, const CostToGo& cost_to_go, const ExactMotion& motion,
                                         const Tableau& tableau) {
  constexpr Number t = 0.3;
  constexpr Number h = 0.05;
  constexpr Number offset = 1e-5;
  const ExactMotion::Point start = motion.at(t);
  const NumberMatrix controls = motion.controls(tableau, t, h);
  const auto step_from = [&](Eigen::Index moved, Number by) {
    NumberVector q = start.q;
    NumberVector p = start.p;
    (moved < degrees ? q[moved] : p[moved - degrees]) += by;
    return map.advance(q, p, start.v, controls, h, t);
  };
  const NumberVector gradient = cost_to_go.gradient(step_from(0, 0));
  NumberVector differences(2 * degrees);
  for (Eigen::Index i = 0; i < 2 * degrees; ++i) {
    const Number change = cost_to_go.value(step_from(i, offset)) - cost_to_go.value(step_from(i, -offset));
    differences[i] = change / (2 * offset);
  }
  const Number miss = (gradient - differences).lpNorm<Eigen::Infinity>();
  if (miss < Number(1e-7)) return {};
  return {
      fmt::format("costates: the derivative of an interval's Lagrangian with respect to its left node differs by "
                  "{:.1e} from finite differences of the cost-to-go",
                  static_cast<double>(miss))};
}

}  // namespace

std::vector<std::string> broken_identities(const Element& element, const Tableau& tableau, int order) {
  const TracedProblem problem{IdentitySystem()};
  const TracedInterval interval(problem, element, tableau);
  std::vector<std::string> broken = broken_counts(interval, element, tableau);
  if (!broken.empty()) return broken;
  const ExactMotion motion(problem);
  const IdentityMap map(problem, element, tableau);
  const Tableau controls = element.controls(tableau);
  const Schedule cost(ExpressionVector::Constant(1, interval.trace.cost));
  const auto add = [&broken](const std::vector<std::string>& sentences) {
    broken.insert(broken.end(), sentences.begin(), sentences.end());
  };
  add(broken_momenta(interval, problem, element.node_state()));
  const std::vector<std::string> inconsistent = broken_consistency(map, cost, motion, controls, order);
  add(inconsistent);
  if (inconsistent.empty()) add(broken_costates(map, CostToGo(interval), motion, controls));
  return broken;
}

}  // namespace dmocbench
