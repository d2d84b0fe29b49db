#include "methods/transcription/program_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/end_constraints.hpp"

namespace dmocbench {

namespace {

void require_inside(double value, double lower, double upper, const std::string& subject) {
  // Ends are computed numbers: a value may miss its own bound by rounding.
  const double slack = 1e-12 * std::max(1.0, std::abs(value));
  if (value >= lower - slack && value <= upper + slack) return;
  throw Error(fmt::format("{} is {:g}, outside its bounds {:g} and {:g}", subject, value, lower, upper));
}

void require_state(const BoundaryState& state, const Problem& problem, const char* name) {
  const std::string subject = problem.name() + ": the boundary state " + name;
  for (const Eigen::VectorXd* part : {&state.q, &state.v}) {
    if (part->size() != problem.configuration_size()) {
      throw Error(fmt::format("{} has {} entries, expected {}", subject, part->size(), problem.configuration_size()));
    }
    if (!part->allFinite()) throw Error(subject + " is not finite");
  }
}

void require_state_inside(const BoundaryState& state, const EndBounds& bounds, const Problem& problem,
                          const char* name) {
  const std::string subject = problem.name() + ": the boundary state " + name;
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    require_inside(state.q[i], bounds.q.lower[i], bounds.q.upper[i], fmt::format("{}: q[{}]", subject, i));
    require_inside(state.v[i], bounds.v.lower[i], bounds.v.upper[i], fmt::format("{}: v[{}]", subject, i));
  }
}

/// The bounds with `size` entries, none where `bounds` is empty. Errors begin with `subject`.
Bounds checked_bounds(const Bounds& bounds, Eigen::Index size, const std::string& subject) {
  if (bounds.empty()) return Bounds::none(size);
  for (const Eigen::VectorXd* side : {&bounds.lower, &bounds.upper}) {
    if (side->size() != size) {
      throw Error(fmt::format("{} has {} entries, expected {}", subject, side->size(), size));
    }
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::string entry = fmt::format("{}: entry {}", subject, i);
    if (std::isnan(bounds.lower[i]) || std::isnan(bounds.upper[i])) throw Error(entry + " is not a number");
    if (bounds.lower[i] > bounds.upper[i]) {
      throw Error(fmt::format("{} has the lower bound {:g} above the upper bound {:g}", entry, bounds.lower[i],
                              bounds.upper[i]));
    }
  }
  return bounds;
}

EndBounds checked_end(const EndBounds& end, const Bounds& everywhere, Eigen::Index n, const std::string& subject) {
  if (end.q.empty() || end.v.empty()) throw Error(fmt::format("{} needs {} entries each for q and v", subject, n));
  EndBounds checked{checked_bounds(end.q, n, subject + ".q"), checked_bounds(end.v, n, subject + ".v")};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double lower = std::max(checked.q.lower[i], everywhere.lower[i]);
    const double upper = std::min(checked.q.upper[i], everywhere.upper[i]);
    if (lower > upper) throw Error(fmt::format("{} and bounds().q leave no value for q[{}]", subject, i));
    checked.q.lower[i] = lower;
    checked.q.upper[i] = upper;
  }
  return checked;
}

/// By continuity the velocity of an end lies within the bounds that hold at the stages beside it.
void require_velocity_left(const EndBounds& end, const Bounds& everywhere, const std::string& subject) {
  for (Eigen::Index i = 0; i < end.v.lower.size(); ++i) {
    const double lower = std::max(end.v.lower[i], everywhere.lower[i]);
    const double upper = std::min(end.v.upper[i], everywhere.upper[i]);
    const double slack = 1e-12 * std::max(1.0, std::abs(upper));
    if (lower <= upper + slack) continue;
    throw Error(
        fmt::format("{} and bounds().v leave no value for v[{}]: {:g} lies above {:g}", subject, i, lower, upper));
  }
}

void require_horizon(const Problem& problem, const HorizonBounds& bounds) {
  if (!(bounds.lower > 0.0) || !(bounds.upper >= bounds.lower)) {
    const char* hint =
        bounds.upper == 0.0 ? "; begin with Problem::bounds(), which fixes the ends and the horizon" : "";
    throw Error(fmt::format("{}: bounds().horizon must be positive and ascend, got {:g} and {:g}{}", problem.name(),
                            bounds.lower, bounds.upper, hint));
  }
}

/// Bounds `count` entries from `first` on.
void set(Bounds& bounds, std::size_t first, std::size_t count, double lower, double upper) {
  const auto entries = Eigen::seqN(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count));
  bounds.lower(entries).setConstant(lower);
  bounds.upper(entries).setConstant(upper);
}

void bound_controls(Bounds& variables, const Bounds& u, const Layout& layout) {
  for (Eigen::Index stage = 0; stage < layout.stages(); ++stage) {
    for (Eigen::Index i = 0; i < u.lower.size(); ++i) {
      set(variables, layout.control_head(stage, i), layout.intervals(), u.lower[i], u.upper[i]);
    }
  }
}

/// Per stage the bounded velocities, then h >= 0.
void bound_path_rows(Bounds& rows, const ProblemBounds& bounds, Eigen::Index path_constraints, const Layout& layout) {
  Eigen::Index row = layout.shape().stage_equations;
  const auto bound_next = [&](double lower, double upper) {
    set(rows, layout.interval_row_head(row++), layout.intervals(), lower, upper);
  };
  for (Eigen::Index stage = 0; stage < layout.stages(); ++stage) {
    for (const Eigen::Index i : bounds.bounded_velocities()) bound_next(bounds.v.lower[i], bounds.v.upper[i]);
    for (Eigen::Index i = 0; i < path_constraints; ++i) bound_next(0.0, unbounded);
  }
}

/// The momentum of an end: fixed where the end is clamped, free otherwise.
Bounds end_momentum(bool clamped, const EndBounds& end, double t, const TracedProblem& traced, const Problem& problem,
                    const char* where) {
  const Eigen::Index n = traced.configuration_size();
  if (!clamped) return Bounds::none(n);
  const MotionPoint point{end.q.lower, end.v.lower, Eigen::VectorXd::Zero(traced.control_size())};
  const Eigen::VectorXd momentum = traced.table({&point, 1}, Eigen::VectorXd::Constant(1, t)).row(0).head(n);
  if (!momentum.allFinite()) throw Error(problem.name() + ": the momentum at the " + where + " is not finite");
  return Bounds::fixed(momentum);
}

}  // namespace

ProblemBounds problem_bounds(const Problem& problem) {
  require_state(problem.initial_state(), problem, "initial_state");
  require_state(problem.final_state(), problem, "final_state");
  ProblemBounds bounds = problem.bounds();
  if (!(problem.horizon() > 0.0)) {
    throw Error(fmt::format("{}: the horizon must be positive, got {:g}", problem.name(), problem.horizon()));
  }
  bounds = complete_bounds(problem, std::move(bounds));
  require_inside(problem.horizon(), bounds.horizon.lower, bounds.horizon.upper, problem.name() + ": horizon");
  require_state_inside(problem.initial_state(), bounds.first, problem, "initial_state");
  require_state_inside(problem.final_state(), bounds.last, problem, "final_state");
  return bounds;
}

ProblemBounds complete_bounds(const Problem& problem, ProblemBounds bounds) {
  const Eigen::Index n = problem.configuration_size();
  const std::string name = problem.name() + ": bounds()";
  require_horizon(problem, bounds.horizon);
  bounds.q = checked_bounds(bounds.q, n, name + ".q");
  bounds.v = checked_bounds(bounds.v, n, name + ".v");
  bounds.u = checked_bounds(bounds.u, problem.control_size(), name + ".u");
  bounds.first = checked_end(bounds.first, bounds.q, n, name + ".first");
  bounds.last = checked_end(bounds.last, bounds.q, n, name + ".last");
  require_velocity_left(bounds.first, bounds.v, name + ".first");
  require_velocity_left(bounds.last, bounds.v, name + ".last");
  return bounds;
}

void require_same_structure(const Problem& problem, const ProgramBounds& before, const ProgramBounds& now) {
  const auto same = [](const Bounds& a, const Bounds& b) {
    if (a.lower.size() != b.lower.size()) return false;
    for (Eigen::Index i = 0; i < a.lower.size(); ++i) {
      const bool keeps_lower = std::isfinite(a.lower[i]) == std::isfinite(b.lower[i]);
      const bool keeps_upper = std::isfinite(a.upper[i]) == std::isfinite(b.upper[i]);
      if (!keeps_lower || !keeps_upper || a.is_fixed(i) != b.is_fixed(i)) return false;
    }
    return true;
  };
  if (same(before.variables, now.variables) && same(before.constraints, now.constraints)) return;
  throw Error(problem.name() +
              ": with these values a bound appears, vanishes, or joins or leaves its opposite; that is another "
              "transcription");
}

ProgramBounds program_bounds(const Problem& problem, const TracedProblem& traced, const ProblemBounds& bounds,
                             double horizon, const EndRules& ends, const Layout& layout) {
  ProgramBounds result{Bounds::none(static_cast<Eigen::Index>(layout.variable_count())),
                       Bounds::fixed(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(layout.constraint_count())))};
  auto& [variables, rows] = result;
  require_path_constraints_at_ends(problem, traced, bounds, horizon);
  const std::size_t last_node = layout.intervals();
  const Bounds first_momentum = end_momentum(ends.first_clamped, bounds.first, 0.0, traced, problem, "start");
  const Bounds last_momentum = end_momentum(ends.last_clamped, bounds.last, horizon, traced, problem, "end");
  const auto set_entry = [](Bounds& all, std::size_t entry, const Bounds& of, Eigen::Index i) {
    set(all, entry, 1, of.lower[i], of.upper[i]);
  };
  for (Eigen::Index i = 0; i < traced.configuration_size(); ++i) {
    const auto set_ends = [&](std::size_t head, const Bounds& first, const Bounds& last) {
      set_entry(variables, head, first, i);
      set_entry(variables, head + last_node, last, i);
    };
    set(variables, layout.configuration_head(i), last_node + 1, bounds.q.lower[i], bounds.q.upper[i]);
    set_ends(layout.configuration_head(i), bounds.first.q, bounds.last.q);
    switch (layout.node_state()) {
      case NodeState::configuration: {
        const std::size_t row = layout.node_row_head(i);
        // (eq:gDLOCP3) and (rem:inifinalvel)
        if (ends.first_clamped) set(rows, row, 1, -first_momentum.lower[i], -first_momentum.lower[i]);
        if (ends.last_clamped) set_entry(rows, row + last_node, last_momentum, i);
        break;
      }
      case NodeState::momentum:
        set_ends(layout.second_head(i), first_momentum, last_momentum);
        break;
      case NodeState::velocity:
        set_ends(layout.second_head(i), bounds.first.v, bounds.last.v);
        break;
    }
    if (ends.first_has_velocity()) set_entry(variables, layout.first_velocity(i), bounds.first.v, i);
    if (ends.last_has_velocity()) set_entry(variables, layout.last_velocity(i), bounds.last.v, i);
  }
  bound_controls(variables, bounds.u, layout);
  if (layout.shape().mayer) set(variables, layout.cost_head(), 1, 0.0, 0.0);
  if (bounds.horizon.is_free()) set(variables, layout.horizon(), 1, bounds.horizon.lower, bounds.horizon.upper);
  bound_path_rows(rows, bounds, traced.path_constraint_count(), layout);
  return result;
}

}  // namespace dmocbench
