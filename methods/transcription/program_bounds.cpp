#include "methods/transcription/program_bounds.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

namespace {

void require_inside(double value, double lower, double upper, const std::string& what) {
  // Ends are computed numbers: a value may miss its own bound by rounding.
  const double slack = 1e-12 * std::max(1.0, std::abs(value));
  if (value >= lower - slack && value <= upper + slack) return;
  throw Error(fmt::format("{} is {:g}, outside its bounds {:g} and {:g}", what, value, lower, upper));
}

void require_state(const BoundaryState& state, const Problem& problem, const char* name) {
  const std::string what = problem.name() + ": the boundary state " + name;
  for (const Eigen::VectorXd* part : {&state.q, &state.v}) {
    if (part->size() != problem.configuration_size()) {
      throw Error(fmt::format("{} has {} entries, expected {}", what, part->size(), problem.configuration_size()));
    }
    if (!part->allFinite()) throw Error(what + " is not finite");
  }
}

void require_state_inside(const BoundaryState& state, const EndBounds& bounds, const Problem& problem,
                          const char* name) {
  const std::string what = problem.name() + ": the boundary state " + name;
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    require_inside(state.q[i], bounds.q.lower[i], bounds.q.upper[i], fmt::format("{}: q[{}]", what, i));
    require_inside(state.v[i], bounds.v.lower[i], bounds.v.upper[i], fmt::format("{}: v[{}]", what, i));
  }
}

EndBounds checked_end(const EndBounds& end, const Bounds& everywhere, Eigen::Index n, const std::string& what) {
  if (end.q.empty() || end.v.empty()) throw Error(fmt::format("{} needs {} entries each for q and v", what, n));
  EndBounds checked{checked_bounds(end.q, n, what + ".q"), checked_bounds(end.v, n, what + ".v")};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double lower = std::max(checked.q.lower[i], everywhere.lower[i]);
    const double upper = std::min(checked.q.upper[i], everywhere.upper[i]);
    if (lower > upper) throw Error(fmt::format("{} and bounds().q leave no value for q[{}]", what, i));
    checked.q.lower[i] = lower;
    checked.q.upper[i] = upper;
  }
  return checked;
}

void require_horizon(const Problem& problem, const HorizonBounds& bounds) {
  if (!(problem.horizon() > 0.0)) throw Error(problem.name() + ": the horizon must be positive");
  if (!(bounds.lower > 0.0) || !(bounds.upper >= bounds.lower)) {
    throw Error(fmt::format("{}: bounds().horizon must be positive and ascend, got {:g} and {:g}", problem.name(),
                            bounds.lower, bounds.upper));
  }
  require_inside(problem.horizon(), bounds.lower, bounds.upper, problem.name() + ": horizon");
}

/// Writes bounds of unknowns, or of rows, series by series.
class BoundsWriter {
 public:
  BoundsWriter(Bounds& bounds, const Layout& layout) : bounds_(&bounds), layout_(&layout) {}

  void set(std::size_t entry, double lower, double upper) {
    bounds_->lower[static_cast<Eigen::Index>(entry)] = lower;
    bounds_->upper[static_cast<Eigen::Index>(entry)] = upper;
  }
  /// Of `length` entries, the first of them `head`.
  void set_series(std::size_t head, std::size_t length, double lower, double upper) {
    for (std::size_t k = 0; k < length; ++k) set(head + k, lower, upper);
  }
  /// At the first and the last node, in a series over the nodes.
  void set_ends(std::size_t head, const Bounds& first, const Bounds& last, Eigen::Index i) {
    set(head, first.lower[i], first.upper[i]);
    set(head + layout_->intervals(), last.lower[i], last.upper[i]);
  }

 private:
  Bounds* bounds_;
  const Layout* layout_;
};

void bound_controls(BoundsWriter& variables, const Bounds& u, const Layout& layout) {
  for (Eigen::Index stage = 0; stage < layout.stages(); ++stage) {
    for (Eigen::Index i = 0; i < layout.shape().control_size; ++i) {
      variables.set_series(layout.control_column(stage, i), layout.intervals(), u.lower[i], u.upper[i]);
    }
  }
}

/// Per stage the bounded velocities, then h >= 0.
void bound_path_rows(BoundsWriter& rows, const ProblemBounds& bounds, Eigen::Index path_constraints,
                     const Layout& layout) {
  const std::vector<Eigen::Index> velocities = bounds.bounded_velocities();
  Eigen::Index row = layout.shape().stage_equations;
  for (Eigen::Index stage = 0; stage < layout.stages(); ++stage) {
    for (const Eigen::Index i : velocities) {
      rows.set_series(layout.interval_row_column(row++), layout.intervals(), bounds.v.lower[i], bounds.v.upper[i]);
    }
    for (Eigen::Index i = 0; i < path_constraints; ++i) {
      rows.set_series(layout.interval_row_column(row++), layout.intervals(), 0.0, unbounded);
    }
  }
}

/// The momentum of an end: fixed where the end is clamped, free otherwise.
Bounds end_momentum(bool clamped, const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                    LegendreTransform& legendre, const Problem& problem, const char* where) {
  if (!clamped) return Bounds::none(q.size());
  const Eigen::VectorXd momentum = legendre.momentum(q, v, t);
  if (!momentum.allFinite()) throw Error(problem.name() + ": the momentum at the " + where + " is not finite");
  return Bounds::fixed(momentum);
}

}  // namespace

ProblemBounds problem_bounds(const Problem& problem) {
  const Eigen::Index n = problem.configuration_size();
  const std::string name = problem.name() + ": bounds()";
  require_state(problem.initial_state(), problem, "initial_state");
  require_state(problem.final_state(), problem, "final_state");
  ProblemBounds bounds = problem.bounds();
  require_horizon(problem, bounds.horizon);
  bounds.q = checked_bounds(bounds.q, n, name + ".q");
  bounds.v = checked_bounds(bounds.v, n, name + ".v");
  bounds.u = checked_bounds(bounds.u, problem.control_size(), name + ".u");
  bounds.first = checked_end(bounds.first, bounds.q, n, name + ".first");
  bounds.last = checked_end(bounds.last, bounds.q, n, name + ".last");
  require_state_inside(problem.initial_state(), bounds.first, problem, "initial_state");
  require_state_inside(problem.final_state(), bounds.last, problem, "final_state");
  return bounds;
}

ProgramBounds program_bounds(const Problem& problem, const TracedProblem& traced, const ProblemBounds& bounds,
                             const EndRules& ends, const Layout& layout) {
  const Eigen::Index n = traced.configuration_size();
  const std::size_t last_node = layout.intervals();
  ProgramBounds result{Bounds::none(static_cast<Eigen::Index>(layout.variable_count())),
                       Bounds::fixed(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(layout.row_count())))};
  BoundsWriter variables(result.variables, layout);
  BoundsWriter rows(result.rows, layout);
  LegendreTransform legendre(traced);
  const Bounds first_momentum =
      end_momentum(ends.first_clamped, bounds.first.q.lower, bounds.first.v.lower, 0.0, legendre, problem, "start");
  const Bounds last_momentum = end_momentum(ends.last_clamped, bounds.last.q.lower, bounds.last.v.lower,
                                            problem.horizon(), legendre, problem, "end");
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t head = layout.configuration_column(i);
    variables.set_series(head, last_node + 1, bounds.q.lower[i], bounds.q.upper[i]);
    variables.set_ends(head, bounds.first.q, bounds.last.q, i);
    switch (layout.node_state()) {
      case NodeState::configuration: {
        const std::size_t row = layout.node_row_column(i);
        // (eq:gDLOCP3) and (rem:inifinalvel)
        if (ends.first_clamped) rows.set(row, -first_momentum.lower[i], -first_momentum.lower[i]);
        if (ends.last_clamped) rows.set(row + last_node, last_momentum.lower[i], last_momentum.lower[i]);
        break;
      }
      case NodeState::momentum:
        variables.set_ends(layout.second_column(i), first_momentum, last_momentum, i);
        break;
      case NodeState::velocity:
        variables.set_ends(layout.second_column(i), bounds.first.v, bounds.last.v, i);
        break;
    }
    if (ends.first_has_velocity()) {
      variables.set(layout.first_velocity(i), bounds.first.v.lower[i], bounds.first.v.upper[i]);
    }
    if (ends.last_has_velocity()) {
      variables.set(layout.last_velocity(i), bounds.last.v.lower[i], bounds.last.v.upper[i]);
    }
  }
  bound_controls(variables, bounds.u, layout);
  if (layout.shape().mayer) variables.set(layout.cost_column(), 0.0, 0.0);
  if (bounds.horizon.is_free()) variables.set(layout.horizon(), bounds.horizon.lower, bounds.horizon.upper);
  bound_path_rows(rows, bounds, traced.path_constraint_count(), layout);
  return result;
}

}  // namespace dmocbench
