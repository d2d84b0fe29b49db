#include "methods/transcription/program_bounds.hpp"

#include <cmath>
#include <limits>

#include "methods/error.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/end_constraints.hpp"

namespace dmocbench {

namespace {

/// Bounds `count` entries from `first` on.
void set(Bounds& bounds, std::size_t first, std::size_t count, double lower, double upper) {
  const auto entries = Eigen::seqN(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count));
  bounds.lower(entries).setConstant(lower);
  bounds.upper(entries).setConstant(upper);
}

void bound_controls(Bounds& variables, const Bounds& u, const Layout& layout) {
  for (Eigen::Index stage = 0; stage < layout.shape().control_stages; ++stage) {
    for (Eigen::Index i = 0; i < u.lower.size(); ++i) {
      set(variables, layout.control_head(stage, i), layout.intervals(), u.lower[i], u.upper[i]);
    }
  }
}

/// Per stage the bounded velocities, then h.
void bound_path_rows(Bounds& rows, const ProblemBounds& bounds, const Bounds& path, const Layout& layout) {
  Eigen::Index row = layout.shape().stage_equations;
  const auto bound_next = [&](double lower, double upper) {
    set(rows, layout.interval_row_head(row++), layout.intervals(), lower, upper);
  };
  for (Eigen::Index stage = 0; stage < layout.stages(); ++stage) {
    for (const Eigen::Index i : bounds.bounded_velocities()) bound_next(bounds.v.lower[i], bounds.v.upper[i]);
    for (Eigen::Index i = 0; i < path.lower.size(); ++i) bound_next(path.lower[i], path.upper[i]);
  }
}

/// What holonomic constraints determine at an end.
void release(Bounds& variables, const ReleasedComponents& released, std::size_t node, bool has_velocity,
             const Layout& layout) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const Eigen::Index i : released.q) set(variables, layout.configuration_head(i) + node, 1, -infinite, infinite);
  if (!has_velocity && layout.node_state() == NodeState::configuration) return;  // no unknown
  for (const Eigen::Index i : released.second) {
    const std::size_t velocity = node == 0 ? layout.first_velocity(i) : layout.last_velocity(i);
    set(variables, has_velocity ? velocity : layout.second_head(i) + node, 1, -infinite, infinite);
  }
}

/// At the nodes between the ends that have bounds of their own.
void bound_interior(Bounds& variables, const ProblemBounds& bounds, const Layout& layout, const Grid& grid) {
  Eigen::Index own = 0;  // among those whose velocity is an unknown of its own
  for (const InteriorBounds& at : bounds.interior) {
    const auto node = static_cast<std::size_t>(grid.node_at(at.relative_time));
    const auto set_entry = [&](std::size_t entry, const Bounds& of, Eigen::Index i) {
      set(variables, entry, 1, of.lower[i], of.upper[i]);
    };
    for (Eigen::Index i = 0; i < at.q.lower.size(); ++i) set_entry(layout.configuration_head(i) + node, at.q, i);
    for (Eigen::Index i = 0; i < at.y.lower.size(); ++i) set_entry(layout.first_order_head(i) + node, at.y, i);
    if (!at.v.any()) continue;
    const bool is_of_node = layout.node_state() == NodeState::velocity;
    for (Eigen::Index i = 0; i < at.v.lower.size(); ++i) {
      set_entry(is_of_node ? layout.second_head(i) + node : layout.interior_velocity(own, i), at.v, i);
    }
    ++own;
  }
}

/// The momentum of an end: fixed where the end is clamped, free otherwise.
Bounds end_momentum(bool clamped, const EndBounds& end, double t, const TracedProblem& traced, const Problem& problem,
                    const char* where) {
  const Eigen::Index n = traced.configuration_size();
  if (!clamped) return Bounds::none(n);
  const MotionPoint point{end.q.lower, end.v.lower, Eigen::VectorXd::Zero(traced.control_size()),
                          // Where it is not given, no momentum depends on it.
                          end.y.lower.array().isFinite().select(end.y.lower, 0.0)};
  const Eigen::VectorXd momentum = traced.table({&point, 1}, Eigen::VectorXd::Constant(1, t)).row(0).head(n);
  if (!momentum.allFinite()) throw Error(problem.name() + ": the momentum at the " + where + " is not finite");
  return Bounds::fixed(momentum);
}

}  // namespace

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
  throw Error(
      problem.name() +
      ": with these values a bound appears, vanishes, or joins or leaves its opposite; make a new transcription");
}

ProgramBounds program_bounds(const Problem& problem, const TracedProblem& traced, const ProblemBounds& bounds,
                             double horizon, const EndRules& ends, const Layout& layout, const Grid& grid) {
  ProgramBounds result{Bounds::none(static_cast<Eigen::Index>(layout.variable_count())),
                       Bounds::fixed(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(layout.constraint_count())))};
  auto& [variables, rows] = result;
  require_bounds_of_formulas(problem, bounds, traced.path_constraint_count(), traced.integral_count());
  const Bounds path = bounds.of_path(traced.path_constraint_count());
  require_path_constraints_at_ends(problem, traced, bounds, horizon);
  require_holonomic_constraints_at_ends(problem, traced, bounds);
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
  release(variables, ends.released_at_first, 0, ends.first_has_velocity(), layout);
  release(variables, ends.released_at_last, last_node, ends.last_has_velocity(), layout);
  for (Eigen::Index i = 0; i < traced.first_order_size(); ++i) {
    const std::size_t head = layout.first_order_head(i);
    set(variables, head, last_node + 1, bounds.y.lower[i], bounds.y.upper[i]);
    set_entry(variables, head, bounds.first.y, i);
    set_entry(variables, head + last_node, bounds.last.y, i);
  }
  bound_interior(variables, bounds, layout, grid);
  bound_controls(variables, bounds.u, layout);
  for (Eigen::Index i = 0; i < layout.shape().sums(); ++i) set(variables, layout.sum_head(i), 1, 0.0, 0.0);
  for (Eigen::Index i = 0; i < layout.shape().integrals; ++i) {
    set_entry(variables, layout.integral_head(i) + last_node, bounds.integrals, i);
  }
  const std::vector<std::size_t> unknowns = problem.unknowns();
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const Parameter& parameter = problem.parameters()[unknowns[i]];
    set(variables, layout.unknown_parameter(static_cast<Eigen::Index>(i)), 1, parameter.lower, parameter.upper);
  }
  if (bounds.horizon.is_free()) set(variables, layout.horizon(), 1, bounds.horizon.lower, bounds.horizon.upper);
  bound_path_rows(rows, bounds, path, layout);
  return result;
}

}  // namespace dmocbench
