#include "methods/transcription/elements/dmoc_shooting_element.hpp"

#include <vector>

#include "methods/expression/derivatives.hpp"
#include "methods/expression/linear_solve.hpp"
#include "methods/expression/replay.hpp"
#include "methods/transcription/derivatives/local_functions.hpp"
#include "methods/transcription/elements/dmoc_element.hpp"

namespace dmocbench {

namespace {

/// The formulas of a step on inputs of its own, into which others are put.
class DmocStep {
 public:
  DmocStep(const TracedProblem& problem, const Tableau& tableau)
      : n_(problem.configuration_size()), inputs_(input_vector(0, std::ssize(problem.open_parameters()))) {
    InputCounter counter(problem.open_parameters().size());
    const DmocElement dmoc;
    IntervalUnknowns own = take_unknowns(counter, problem, dmoc, tableau);
    own.h = counter.take();
    own.t = counter.take();
    const ExpressionVector left_momentum = counter.take(n_);
    const IntervalTrace trace = dmoc.trace(problem, tableau, own);

    std::vector<ExpressionVector> roots = own.rates_q;
    roots.push_back(own.right_q);
    const ExpressionVector unknowns = stacked(roots);
    const ExpressionVector residual =
        stacked({trace.stage_equations, ExpressionVector(trace.left_rows + left_momentum)});
    std::vector<Expression> outputs(residual.begin(), residual.end());
    append(outputs, jacobian(residual, unknowns));
    equations_ = Schedule(outputs);

    std::vector<ExpressionVector> results{trace.right_momentum, ExpressionVector::Constant(1, trace.cost)};
    for (const ControlledState& stage : trace.stages) {
      results.push_back(stage.q);
      results.push_back(stage.v);
      results.emplace_back(ExpressionVector::Constant(1, stage.t));
    }
    results_ = Schedule(stacked(results));
  }

  /// The unknowns of a step after a Newton step from `roots` (interior stage rates, then q_{k+1}); `correction` is
  /// the change subtracted by the Newton step.
  [[nodiscard]] ExpressionVector improved(const IntervalUnknowns& interval, const ExpressionVector& roots,
                                          ExpressionVector& correction) const {
    const std::vector<Expression> values = replay<Expression>(equations_, inputs(interval, roots));
    const Eigen::Index size = roots.size();
    const ExpressionVector residual = Eigen::Map<const ExpressionVector>(values.data(), size);
    const ExpressionMatrix by_roots = Eigen::Map<const ExpressionMatrix>(values.data() + size, size, size);
    correction = solve_unsymmetric(by_roots, residual);
    return roots - correction;
  }

  /// p_{k+1}, the cost, and for every stage Q_i, Q̇_i and its time.
  [[nodiscard]] ExpressionVector results(const IntervalUnknowns& interval, const ExpressionVector& roots) const {
    const std::vector<Expression> values = replay<Expression>(results_, inputs(interval, roots));
    return Eigen::Map<const ExpressionVector>(values.data(), std::ssize(values));
  }

 private:
  /// The inputs of both schedules, in the order of `take_unknowns`, then h, t and p_k.
  [[nodiscard]] std::vector<Expression> inputs(const IntervalUnknowns& interval, const ExpressionVector& roots) const {
    std::vector<ExpressionVector> parts{inputs_, interval.left_q, roots.tail(n_), roots.head(roots.size() - n_)};
    parts.insert(parts.end(), interval.controls.begin(), interval.controls.end());
    const ExpressionVector step{{interval.h, interval.t}};
    parts.push_back(step);
    parts.push_back(interval.left_second);
    const ExpressionVector all = stacked(parts);
    return {all.begin(), all.end()};
  }

  Eigen::Index n_;
  ExpressionVector inputs_;  // the open parameters, which stay
  Schedule equations_;       // the residual, then its derivatives by the roots, column by column
  Schedule results_;
};

/// Where Newton's method begins: every stage rate is the velocity v of p_k, and q_{k+1} = q_k + h v.
ExpressionVector predicted(const TracedProblem& problem, const Tableau& tableau, const IntervalUnknowns& unknowns) {
  const State at_rest{unknowns.left_q, ExpressionVector(problem.configuration_size()), unknowns.t};
  const TracedProblem::Values values = problem.at(at_rest);
  const ExpressionVector v = solve_symmetric(values.mass, unknowns.left_second - values.momentum);
  std::vector<ExpressionVector> roots(static_cast<std::size_t>(tableau.stages() - 1), v);
  roots.emplace_back(unknowns.left_q + unknowns.h * v);
  return stacked(roots);
}

/// 1 where the last correction of q_{k+1} is rounding, not a number where it is not.
///
/// A formula cannot branch. A power with an exponent that is almost 0 is 1 to the last digit for every positive number,
/// with derivatives that are almost 0, and not a number for a negative one.
Expression one_if_solved(const ExpressionVector& right_q, const ExpressionVector& correction) {
  constexpr double tolerance = 1e-12;
  constexpr double almost_zero = 1e-20;
  Expression size(1.0);
  Expression rest;
  for (Eigen::Index i = 0; i < right_q.size(); ++i) {
    size += right_q[i] * right_q[i];
    rest += correction[i] * correction[i];
  }
  return pow(Expression(tolerance * tolerance) * size - rest, almost_zero);
}

}  // namespace

std::string DmocShootingElement::description() const {
  return std::string("direct ") + (shooting_ == Shooting::single ? "single" : "multiple") +
         " shooting on (q, p), one step of DMOC per interval";
}

IntervalTrace DmocShootingElement::trace(const TracedProblem& problem, const Tableau& tableau,
                                         const IntervalUnknowns& unknowns) const {
  const Eigen::Index n = problem.configuration_size();
  const DmocStep step(problem, tableau);
  ExpressionVector roots = predicted(problem, tableau, unknowns);
  ExpressionVector correction;
  for (int i = 0; i < newton_steps; ++i) roots = step.improved(unknowns, roots, correction);
  const Expression solved = one_if_solved(roots.tail(n), correction.tail(n));
  const ExpressionVector results = step.results(unknowns, roots);

  IntervalTrace trace;
  trace.stage_equations.resize(2 * n);
  trace.stage_equations << (unknowns.right_q - solved * roots.tail(n)) / unknowns.h,
      (unknowns.right_second - solved * results.head(n)) / unknowns.h;
  trace.cost = results[n];
  for (Eigen::Index i = 0; i < tableau.stages(); ++i) {
    const ExpressionVector stage = results.segment(n + 1 + i * (2 * n + 1), 2 * n + 1);
    trace.stages.push_back(
        {stage.head(n), stage.segment(n, n), unknowns.controls[static_cast<std::size_t>(i)], stage[2 * n]});
  }
  trace.left_momentum = unknowns.left_second;
  trace.right_momentum = unknowns.right_second;
  return trace;
}

}  // namespace dmocbench
