#include "methods/mechanics/embedded_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

constexpr int tries = 40;  // θ at which the embedding is tested, and from which an end is sought

/// Even in [-π, π], the same on every call.
class SpreadPoints {
 public:
  Eigen::VectorXd next(Eigen::Index size) {
    return Eigen::VectorXd::NullaryExpr(size, [&] { return even_(engine_); });
  }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<double> even_{-3.14, 3.14};
};

Eigen::VectorXd numbers_of(const Schedule& schedule, const Eigen::VectorXd& theta, double t) {
  std::vector<double> inputs(theta.begin(), theta.end());
  inputs.push_back(t);
  const std::vector<double> values = replay<double>(schedule, std::span<const double>(inputs));
  return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
}

ExpressionVector formulas_of(const Schedule& schedule, const ExpressionVector& theta, const Expression& t,
                             const ExpressionVector& rates = {}) {
  const ExpressionVector inputs = stacked({theta, ExpressionVector::Constant(1, t), rates});
  const std::vector<Expression> formulas =
      replay<Expression>(schedule, std::span<const Expression>(entries_of(inputs)));
  return Eigen::Map<const ExpressionVector>(formulas.data(), std::ssize(formulas));
}

/// The x of least |A x - b|; not a number where the columns of A are dependent.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(a.cols(), std::numeric_limits<double>::quiet_NaN());
  return solve_if_invertible(a.transpose() * a, a.transpose() * b).value_or(none);
}

}  // namespace

EmbeddedProblem::EmbeddedProblem(std::shared_ptr<const Problem> redundant) : redundant_(std::move(redundant)) {
  if (!redundant_->unknowns().empty()) {
    throw Error(redundant_->name() + ": an embedding does not support unknown parameters");
  }
  trace_embedding();
  require_on_manifold();
  const ProblemBounds bounds = redundant_->bounds();
  static_cast<void>(bounds_on_theta(bounds));
  const BoundaryState given = redundant_->initial_state();
  first_ = end_of(given, nearest_of_all(given.q), 0.0, bounds.first, "initial_state");
  constexpr Eigen::Index points = 129;
  guessed_.resize(points, freedoms_);
  Eigen::VectorXd theta = first_.q;
  for (Eigen::Index i = 0; i < points; ++i) {
    const double t = horizon() * static_cast<double>(i) / (points - 1);
    theta = nearest(redundant_->guess(t).q, theta, t);
    guessed_.row(i) = theta.transpose();
  }
  const BoundaryState wanted = redundant_->final_state();
  last_ = end_of(wanted, nearest(wanted.q, theta, horizon()), horizon(), bounds.last, "final_state");
}

void EmbeddedProblem::trace_embedding() {
  const Eigen::Index n = redundant_->configuration_size();
  const Eigen::Index c =
      call_formula(*redundant_, "constraints", [&] { return redundant_->constraints(input_vector(0, n)).size(); });
  if (c == 0) throw Error(redundant_->name() + " has no constraints g(q) = 0 and needs no embedding");
  if (redundant_->velocity_constraints(input_vector(0, n), input_vector(0, n)).size() > 0) {
    throw Error(redundant_->name() + ": an embedding does not support velocity_constraints; use multipliers");
  }
  freedoms_ = n - c;
  InputCounter inputs;
  const ExpressionVector theta = inputs.take(freedoms_);
  const ExpressionVector t = inputs.take(1);
  const ExpressionVector q =
      call_formula(*redundant_, "embedding", [&] { return redundant_->moving_embedding(theta, t[0]); });
  if (q.size() == 0)
    throw Error(redundant_->name() + " does not define embedding(theta); define it or use multipliers");
  if (q.size() != n) {
    throw Error("{}: embedding has {}, expected {}", redundant_->name(), counted(q.size(), "entry", "entries"), n);
  }
  embedding_ = Schedule(q);
  const ExpressionMatrix by_theta = jacobian(q, theta);
  const ExpressionVector by_time = jacobian(q, t);
  chart_ = Schedule(stacked({q, by_theta.reshaped(), by_time}));
  velocity_ = Schedule(ExpressionVector(by_theta * inputs.take(freedoms_) + by_time));
}

void EmbeddedProblem::require_on_manifold() const {
  InputCounter inputs;
  const ExpressionVector of_theta = inputs.take(freedoms_);
  const Schedule residual(redundant_->constraints(formulas_of(embedding_, of_theta, inputs.take())));
  SpreadPoints points;
  for (int i = 0; i < tries; ++i) {
    const Eigen::VectorXd theta = points.next(freedoms_);
    const double t = horizon() * i / (tries - 1);
    const Eigen::VectorXd g = numbers_of(residual, theta, t);
    const double size = 1.0 + chart_at(theta, t).q.squaredNorm();
    for (Eigen::Index a = 0; a < g.size(); ++a) {
      if (!(std::abs(g[a]) > 1e-10 * size)) continue;  // where Φ is not defined, it is not wrong
      throw Error("{}: embedding(theta) violates constraints[{}]: g = {:.3g} at theta = ({:.3g}), but must be 0",
                  redundant_->name(), a, g[a], fmt::join(theta, ", "));
    }
  }
}

Bounds EmbeddedProblem::bounds_on_theta(const ProblemBounds& bounds) const {
  Bounds result = Bounds::none(freedoms_);
  bool is_possible = bounds.interior.empty() && (bounds.v.empty() || !bounds.v.any());
  for (Eigen::Index i = 0; i < bounds.q.lower.size(); ++i) {
    if (!bounds.q.is_bounded(i)) continue;
    const Schedule::Step& entry = embedding_.steps()[embedding_.outputs()[static_cast<std::size_t>(i)]];
    is_possible = is_possible && entry.operation == Operation::input;
    if (!is_possible) break;
    const auto j = static_cast<Eigen::Index>(entry.input_index);
    result.lower[j] = std::max(result.lower[j], bounds.q.lower[i]);
    result.upper[j] = std::min(result.upper[j], bounds.q.upper[i]);
  }
  if (is_possible) return result;
  throw Error(
      redundant_->name() +
      ": an embedding supports bounds between the ends only on coordinates that are entries of theta; use multipliers");
}

EmbeddedProblem::Chart EmbeddedProblem::chart_at(const Eigen::VectorXd& theta, double t) const {
  const Eigen::VectorXd values = numbers_of(chart_, theta, t);
  const Eigen::Index n = values.size() / (2 + freedoms_);
  return {values.head(n), values.segment(n, n * freedoms_).reshaped(n, freedoms_), values.tail(n)};
}

Eigen::VectorXd EmbeddedProblem::nearest(const Eigen::VectorXd& q, Eigen::VectorXd theta, double t) const {
  constexpr int most_steps = 100;
  constexpr double longest = 0.5;  // of an angle, so that a far start leads somewhere near
  for (int i = 0; i < most_steps; ++i) {
    const Chart at = chart_at(theta, t);
    Eigen::VectorXd step = least_squares(at.jacobian, q - at.q);
    if (!step.allFinite()) break;
    step *= std::min(1.0, longest * (1.0 + theta.norm()) / step.norm());
    theta += step;
    if (step.norm() <= 1e-15 * (1.0 + theta.norm())) break;
  }
  return theta;
}

Eigen::VectorXd EmbeddedProblem::nearest_of_all(const Eigen::VectorXd& q) const {
  SpreadPoints points;
  Eigen::VectorXd best = points.next(freedoms_);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < tries && !(least < 1e-12 * (1.0 + q.norm())); ++i) {
    const Eigen::VectorXd theta = nearest(q, points.next(freedoms_), 0.0);
    const double distance = (chart_at(theta, 0.0).q - q).norm();
    if (!(distance < least)) continue;
    best = theta;
    least = distance;
  }
  return best;
}

Eigen::VectorXd EmbeddedProblem::rate_of(const Eigen::VectorXd& v, const Eigen::VectorXd& theta, double t) const {
  const Chart at = chart_at(theta, t);
  return least_squares(at.jacobian, v - at.rate);
}

BoundaryState EmbeddedProblem::end_of(const BoundaryState& state, const Eigen::VectorXd& theta, double t,
                                      const EndBounds& bounds, const char* end) const {
  const auto require_whole = [&](const Bounds& of, const char* what) {
    if (of.all_fixed() || !of.any()) return;
    throw Error("{}: {} fixes or bounds a part of {}, which an embedding does not support; use multipliers",
                redundant_->name(), member_name(end), what);
  };
  require_whole(bounds.q, "q");
  require_whole(bounds.v, "v");
  if (bounds.v.all_fixed() && !bounds.q.all_fixed()) {
    throw Error("{}: {} fixes v but not q, which an embedding does not support; use multipliers", redundant_->name(),
                member_name(end));
  }
  BoundaryState result{.q = theta, .v = rate_of(state.v, theta, t), .y = state.y};
  const BoundaryState reached = lifted(result, t);
  const auto require_near = [&](const Eigen::VectorXd& from, const Eigen::VectorXd& to, const char* what) {
    const double distance = (from - to).norm();
    if (distance <= 1e-9 * (1.0 + to.norm())) return;  // not where it is not a number
    throw Error("{}: embedding(theta) does not reach {}: the distance in {} is {:.3g}", redundant_->name(),
                member_name(end), what, distance);
  };
  if (bounds.q.all_fixed()) require_near(reached.q, state.q, "q");
  if (bounds.v.all_fixed()) require_near(reached.v, state.v, "v");
  return result;
}

BoundaryState EmbeddedProblem::lifted(const BoundaryState& state, double t) const {
  const Chart at = chart_at(state.q, t);
  return {.q = at.q, .v = at.jacobian * state.v + at.rate, .y = state.y};
}

State EmbeddedProblem::lifted(const State& x) const {
  return {formulas_of(embedding_, x.q, x.t), formulas_of(velocity_, x.q, x.t, x.v), x.t, x.y};
}

ControlledState EmbeddedProblem::lifted(const ControlledState& x) const {
  const State state = lifted(x.state());
  return {state.q, state.v, x.u, x.t, x.y};
}

std::string EmbeddedProblem::name() const { return redundant_->name() + "_embedded"; }

ProblemCard EmbeddedProblem::card() const {
  ProblemCard card = redundant_->card();
  card.description += ", in the coordinates of its embedding";
  if (card.picture) {
    card.picture = [this, of_redundant = card.picture](const ControlledState& x) { return of_redundant(lifted(x)); };
  }
  return card;
}

std::vector<std::string> EmbeddedProblem::configuration_names() const {
  std::vector<std::string> names;
  for (Eigen::Index i = 1; i <= freedoms_; ++i) names.push_back(fmt::format("theta_{}", i));
  return names;
}

ExpressionVector EmbeddedProblem::first_order_rates(const ControlledState& x) const {
  return redundant_->first_order_rates(lifted(x));
}

Expression EmbeddedProblem::lagrangian(const State& x) const { return redundant_->lagrangian(lifted(x)); }

ExpressionVector EmbeddedProblem::force(const ControlledState& x) const {
  const ExpressionVector of_redundant = redundant_->force(lifted(x));
  const ExpressionVector chart = formulas_of(chart_, x.q, x.t);
  const Eigen::Index n = of_redundant.size();
  return chart.segment(n, n * freedoms_).reshaped(n, freedoms_).transpose() * of_redundant;
}

Expression EmbeddedProblem::running_cost(const ControlledState& x) const { return redundant_->running_cost(lifted(x)); }

ProblemBounds EmbeddedProblem::bounds() const {
  ProblemBounds bounds = redundant_->bounds();
  const auto in_theta = [&](EndBounds& end, const BoundaryState& state) {
    end.q = end.q.all_fixed() ? Bounds::fixed(state.q) : Bounds::none(freedoms_);
    end.v = end.v.all_fixed() ? Bounds::fixed(state.v) : Bounds::none(freedoms_);
  };
  in_theta(bounds.first, first_);
  in_theta(bounds.last, last_);
  bounds.q = bounds_on_theta(bounds);
  bounds.v = {};
  return bounds;
}

ExpressionVector EmbeddedProblem::path_constraints(const ControlledState& x) const {
  return redundant_->path_constraints(lifted(x));
}

ExpressionVector EmbeddedProblem::integrands(const ControlledState& x) const {
  return redundant_->integrands(lifted(x));
}

ExpressionVector EmbeddedProblem::boundary_conditions(const State& first, const State& last) const {
  return redundant_->boundary_conditions(lifted(first), lifted(last));
}

Expression EmbeddedProblem::final_cost(const State& last) const { return redundant_->final_cost(lifted(last)); }

MotionPoint EmbeddedProblem::guess(double t) const {
  const MotionPoint point = redundant_->guess(t);
  const Eigen::Index last = guessed_.rows() - 1;
  const double place = std::round(t / horizon() * static_cast<double>(last));
  const auto row = static_cast<Eigen::Index>(std::clamp(place, 0.0, static_cast<double>(last)));
  const Eigen::VectorXd theta = nearest(point.q, guessed_.row(row).transpose(), t);
  return {theta, rate_of(point.v, theta, t), point.u, point.y};
}

}  // namespace dmocbench
