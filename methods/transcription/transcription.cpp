#include "methods/transcription/transcription.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "methods/error.hpp"
#include "methods/mechanics/legendre_transform.hpp"

namespace dmocbench {

namespace {

/// Looks up the `first` of every place.
std::vector<std::size_t> pick(const std::vector<std::size_t>& firsts, const std::vector<std::size_t>& places) {
  std::vector<std::size_t> picked;
  picked.reserve(places.size());
  for (const std::size_t place : places) picked.push_back(firsts[place]);
  return picked;
}

AssembledPattern jacobian_pattern(const IntervalFunctions& functions, const Layout& layout) {
  return assemble_pattern(pick(layout.row_firsts(), functions.jacobian.rows),
                          pick(layout.unknown_firsts(), functions.jacobian.columns), layout.intervals());
}

AssembledPattern hessian_pattern(const IntervalFunctions& functions, const Layout& layout) {
  std::vector<std::size_t> rows = pick(layout.unknown_firsts(), functions.hessian.rows);
  std::vector<std::size_t> columns = pick(layout.unknown_firsts(), functions.hessian.columns);
  for (std::size_t e = 0; e < rows.size(); ++e) {
    if (rows[e] < columns[e]) std::swap(rows[e], columns[e]);
  }
  return assemble_pattern(rows, columns, layout.intervals());
}

/// max|q| and max|L_vv| over the ends and the guess.
double rounding_floor_of(const Problem& problem, const TracedProblem& traced, const Eigen::VectorXd& steps) {
  constexpr int samples = 16;
  constexpr double safety = 20.0;
  LegendreTransform legendre(traced);
  double largest_q = 0.0;
  double largest_mass = 0.0;
  const auto include = [&](const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t) {
    largest_q = std::max(largest_q, q.lpNorm<Eigen::Infinity>());
    largest_mass = std::max(largest_mass, legendre.mass(q, v, t).lpNorm<Eigen::Infinity>());
  };
  const double horizon = problem.horizon();
  include(problem.initial_state().q, problem.initial_state().v, 0.0);
  include(problem.final_state().q, problem.final_state().v, horizon);
  for (int i = 0; i <= samples; ++i) {
    const double t = horizon * i / samples;
    const MotionPoint point = problem.guess(t);
    include(point.q, point.v, t);
  }
  return safety * std::numeric_limits<double>::epsilon() * largest_q * largest_mass / steps.minCoeff();
}

void require_finite(const Eigen::VectorXd& values, const Problem& problem, const char* what) {
  if (!values.allFinite()) throw Error(problem.name() + ": " + what + " is not finite");
}

}  // namespace

Transcription::Transcription(const Problem& problem, const Element& element, Tableau tableau, const Grid& grid,
                             std::string_view derivatives)
    : tableau_(std::move(tableau)),
      cost_scale_(problem.cost_scale()),
      traced_(problem),
      functions_(trace_interval(traced_, element, tableau_, cost_scale_)),
      layout_(grid.intervals(), traced_.configuration_size(), traced_.control_size(), element.node_state(),
              tableau_.stages(), tableau_.shares_controls, functions_.node_rows, functions_.private_rows),
      node_times_(problem.horizon() * grid.relative_times()),
      steps_(problem.horizon() * grid.relative_widths()),
      inputs_(functions_.inputs.count()),
      jacobian_pattern_(jacobian_pattern(functions_, layout_)),
      hessian_pattern_(hessian_pattern(functions_, layout_)),
      cost_(functions_.cost, {0}, grid.intervals(), grid.intervals()),
      rows_(functions_.rows.schedule, pick(layout_.row_firsts(), functions_.rows.places), layout_.row_count(),
            grid.intervals()),
      derivatives_(
          make_derivative_back_end(derivatives, functions_,
                                   {.intervals = grid.intervals(),
                                    .gradient_firsts = pick(layout_.unknown_firsts(), functions_.gradient.places),
                                    .gradient_size = layout_.variable_count(),
                                    .jacobian_firsts = jacobian_pattern_.firsts,
                                    .jacobian_size = jacobian_pattern_.pattern.size(),
                                    .hessian_firsts = hessian_pattern_.firsts,
                                    .hessian_size = hessian_pattern_.pattern.size()})),
      costs_(static_cast<Eigen::Index>(grid.intervals())) {
  if (!(problem.horizon() > 0.0)) throw Error(problem.name() + ": the horizon must be positive");
  require_enough_intervals(problem, element);
  set_bounds(problem);
  rounding_floor_ = rounding_floor_of(problem, traced_, steps_);
}

void Transcription::require_enough_intervals(const Problem& problem, const Element& element) const {
  const auto n = static_cast<std::size_t>(traced_.configuration_size());
  const std::size_t fixed = (element.node_state() == NodeState::configuration ? 2 : 4) * n;
  const auto enough = [&](std::size_t intervals) {
    const Layout layout(intervals, traced_.configuration_size(), traced_.control_size(), element.node_state(),
                        tableau_.stages(), tableau_.shares_controls, functions_.node_rows, functions_.private_rows);
    return layout.variable_count() >= fixed + layout.row_count();
  };
  if (enough(layout_.intervals())) return;
  if (traced_.control_size() == 0) {
    throw Error(problem.name() + " has no control: no number of intervals lets it meet both ends");
  }
  std::size_t smallest = layout_.intervals();
  while (!enough(smallest)) ++smallest;  // every interval adds a control
  throw Error(problem.name() + " with " + element.name() + " has fewer free variables than rows on " +
              std::to_string(layout_.intervals()) + " intervals; it needs at least " + std::to_string(smallest));
}

void Transcription::set_bounds(const Problem& problem) {
  const auto n = traced_.configuration_size();
  const BoundaryState first = problem.initial_state();
  const BoundaryState last = problem.final_state();
  for (const Eigen::VectorXd* part : {&first.q, &first.v, &last.q, &last.v}) {
    if (part->size() != n) {
      throw Error(problem.name() + ": a boundary state has " + std::to_string(part->size()) + " entries, expected " +
                  std::to_string(n));
    }
    require_finite(*part, problem, "a boundary state");
  }
  LegendreTransform legendre(traced_);
  const Eigen::VectorXd first_momentum = legendre.momentum(first.q, first.v, 0.0);
  const Eigen::VectorXd last_momentum = legendre.momentum(last.q, last.v, problem.horizon());
  require_finite(first_momentum, problem, "the momentum at the start");
  require_finite(last_momentum, problem, "the momentum at the end");

  variable_lower_.setConstant(static_cast<Eigen::Index>(variable_count()), -unbounded);
  variable_upper_.setConstant(static_cast<Eigen::Index>(variable_count()), unbounded);
  constraint_bounds_.setZero(static_cast<Eigen::Index>(constraint_count()));
  const auto end = static_cast<Eigen::Index>(layout_.intervals());
  const auto fix = [&](std::size_t column, double at_first, double at_last) {
    const auto head = static_cast<Eigen::Index>(column);
    variable_lower_[head] = variable_upper_[head] = at_first;
    variable_lower_[head + end] = variable_upper_[head + end] = at_last;
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    fix(layout_.configuration_column(i), first.q[i], last.q[i]);
    switch (layout_.node_state()) {
      case NodeState::configuration: {
        const auto row = static_cast<Eigen::Index>(layout_.node_row_column(i));
        constraint_bounds_[row] = -first_momentum[i];
        constraint_bounds_[row + end] = last_momentum[i];
        break;
      }
      case NodeState::momentum:
        fix(layout_.second_column(i), first_momentum[i], last_momentum[i]);
        break;
      case NodeState::velocity:
        fix(layout_.second_column(i), first.v[i], last.v[i]);
        break;
    }
  }
}

std::span<const Tape::Input> Transcription::bind(const VectorIn& x, const VectorIn& multipliers,
                                                 double objective_factor) {
  const IntervalInputs& numbers = functions_.inputs;
  for (std::size_t a = 0; a < numbers.unknowns; ++a) inputs_[a] = {x.data() + layout_.unknown_firsts()[a], false};
  inputs_[numbers.step()] = {steps_.data(), false};
  inputs_[numbers.time()] = {node_times_.data(), false};
  objective_factor_ = objective_factor;
  inputs_[numbers.objective_factor()] = {&objective_factor_, true};
  for (std::size_t r = 0; r < numbers.rows && multipliers.size() > 0; ++r) {
    inputs_[numbers.multiplier(r)] = {multipliers.data() + layout_.row_firsts()[r], false};
  }
  return inputs_;
}

double Transcription::objective(const VectorIn& x) {
  cost_.evaluate(bind(x, no_multipliers_, 1.0), costs_);
  return costs_.sum();
}

void Transcription::gradient(const VectorIn& x, VectorOut result) {
  derivatives_->gradient(bind(x, no_multipliers_, 1.0), result);
}

void Transcription::constraints(const VectorIn& x, VectorOut result) {
  rows_.evaluate(bind(x, no_multipliers_, 1.0), result);
}

void Transcription::jacobian(const VectorIn& x, VectorOut values) {
  derivatives_->jacobian(bind(x, no_multipliers_, 1.0), values);
}

void Transcription::hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) {
  derivatives_->hessian(bind(x, multipliers, objective_factor), values);
}

}  // namespace dmocbench
