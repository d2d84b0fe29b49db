#include "methods/transcription/program_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "methods/error.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/end_functions.hpp"

namespace dmocbench {

namespace {

/// Bounds of all members of a block by the bounds of its components.
template <class Kind>
void bound(Bounds& all, const Block<Kind>& block, const Bounds& of) {
  for (Eigen::Index i = 0; i < block.width; ++i) {
    const auto members = Eigen::seqN(block.index(i), static_cast<Eigen::Index>(block.length));
    all.lower(members).setConstant(of.lower[block.component + i]);
    all.upper(members).setConstant(of.upper[block.component + i]);
  }
}

/// Bounds of a block at one node.
template <class Kind>
void bound_at(Bounds& all, const Block<Kind>& block, std::size_t node, const Bounds& of) {
  Block<Kind> at_node = block.later(node);
  for (Eigen::Index i = 0; i < block.width; ++i) {
    all.lower[at_node.index(i)] = of.lower[block.component + i];
    all.upper[at_node.index(i)] = of.upper[block.component + i];
  }
}

/// Nothing is asked of some components of a block at a node.
void release(Bounds& variables, const UnknownBlock& block, std::size_t node,
             const std::vector<Eigen::Index>& components) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (block.width == 0) return;
  const UnknownBlock at_node = block.later(node);
  for (const Eigen::Index i : components) {
    variables.lower[at_node.index(i)] = -infinite;
    variables.upper[at_node.index(i)] = infinite;
  }
}

/// The unknown velocity of a node: its own, or the one in its state.
UnknownBlock velocity_at(const ProgramBlocks& blocks, std::size_t node, NodeState node_state) {
  return node_state == NodeState::velocity ? blocks.unknown(Quantity::second).later(node)
                                           : blocks.unknown_at(Quantity::velocity, node);
}

/// At the nodes between the ends that have bounds of their own.
void bound_interior(Bounds& variables, const ProblemBounds& bounds, const ProgramBlocks& blocks, NodeState node_state,
                    const Grid& grid) {
  for (const InteriorBounds& at : bounds.interior) {
    const auto node = static_cast<std::size_t>(grid.node_at(at.relative_time));
    bound_at(variables, blocks.unknown(Quantity::configuration), node, at.q);
    bound_at(variables, blocks.unknown(Quantity::first_order), node, at.y);
    if (at.v.any()) bound_at(variables, velocity_at(blocks, node, node_state), 0, at.v);
  }
}

/// The ranges of the unknown parameters.
Bounds ranges_of(const Problem& problem) {
  const std::vector<std::size_t> unknowns = problem.unknowns();
  Bounds ranges = Bounds::none(std::ssize(unknowns));
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const Parameter& parameter = problem.parameters()[unknowns[i]];
    ranges.lower[static_cast<Eigen::Index>(i)] = parameter.lower;
    ranges.upper[static_cast<Eigen::Index>(i)] = parameter.upper;
  }
  return ranges;
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
  throw Error(problem.name() +
              ": these values change whether a bound is finite, or whether it equals the opposite bound; create a new "
              "transcription");
}

ProgramBounds program_bounds(const Problem& problem, const TracedProblem& traced, const ProblemBounds& bounds,
                             double horizon, const EndRules& ends, const ProgramBlocks& blocks, const Grid& grid) {
  ProgramBounds result{Bounds::none(static_cast<Eigen::Index>(blocks.variable_count())),
                       Bounds::fixed(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(blocks.constraint_count())))};
  auto& [variables, rows] = result;
  require_bounds_of_formulas(problem, bounds, traced.path_constraint_count(), traced.integral_count());
  const Bounds path = bounds.of_path(traced.path_constraint_count());
  require_path_constraints_at_ends(problem, traced, bounds, horizon);
  require_motion_constraints_at_ends(problem, traced, bounds);
  const std::size_t last_node = blocks.intervals();
  const Bounds first_momentum = end_momentum(ends.first_clamped, bounds.first, 0.0, traced, problem, "start");
  const Bounds last_momentum = end_momentum(ends.last_clamped, bounds.last, horizon, traced, problem, "end");
  const bool has_velocities = ends.node_state == NodeState::velocity;
  for (const UnknownBlock& block : blocks.unknowns()) {
    const auto bound_ends = [&](const Bounds& first, const Bounds& last) {
      bound_at(variables, block, 0, first);
      bound_at(variables, block, last_node, last);
    };
    switch (block.kind) {
      case Quantity::configuration:
        bound(variables, block, bounds.q);
        bound_ends(bounds.first.q, bounds.last.q);
        break;
      case Quantity::second:
        bound_ends(has_velocities ? bounds.first.v : first_momentum, has_velocities ? bounds.last.v : last_momentum);
        break;
      case Quantity::first_order:
        bound(variables, block, bounds.y);
        bound_ends(bounds.first.y, bounds.last.y);
        break;
      case Quantity::control:
        bound(variables, block, bounds.u);
        break;
      case Quantity::integral:
        bound_ends(Bounds::fixed(Eigen::VectorXd::Zero(block.width)), bounds.integrals);
        break;
      case Quantity::cost:
        bound_at(variables, block, 0, Bounds::fixed(Eigen::VectorXd::Zero(1)));
        break;
      case Quantity::velocity:  // between the ends: below
        if (block.node == 0) bound(variables, block, bounds.first.v);
        if (block.node == last_node) bound(variables, block, bounds.last.v);
        break;
      case Quantity::parameter:
        bound(variables, block, ranges_of(problem));
        break;
      case Quantity::horizon:
        bound(variables, block, Bounds::all(1, bounds.horizon.lower, bounds.horizon.upper));
        break;
      case Quantity::rate:
      case Quantity::second_rate:
      case Quantity::first_order_rate:
      case Quantity::multiplier:
        break;
    }
  }
  for (const auto& [node, released] :
       {std::pair(std::size_t{0}, &ends.released_at_first), std::pair(last_node, &ends.released_at_last)}) {
    release(variables, blocks.unknown(Quantity::configuration), node, released->q);
    const UnknownBlock& velocity = blocks.unknown_at(Quantity::velocity, node);
    const bool is_own = velocity.width > 0;
    release(variables, is_own ? velocity : blocks.unknown(Quantity::second), is_own ? 0 : node, released->second);
  }
  bound_interior(variables, bounds, blocks, ends.node_state, grid);
  for (const RowBlock& block : blocks.rows()) {
    if (block.kind == Equation::bounded_velocity) bound(rows, block, bounds.v);
    if (block.kind == Equation::path) bound(rows, block, path);
  }
  const RowBlock& momenta = blocks.row(Equation::euler_lagrange);  // of the nodes: (eq:gDLOCP3) and (rem:inifinalvel)
  if (ends.first_clamped) bound_at(rows, momenta, 0, Bounds::fixed(-first_momentum.lower));
  if (ends.last_clamped) bound_at(rows, momenta, last_node, last_momentum);
  return result;
}

namespace {

/// The floor of every place, with `of_interval` for an interval.
Eigen::VectorXd floors_at(const Places& places, const Eigen::VectorXd& of_interval, double of_border) {
  Eigen::VectorXd floors(static_cast<Eigen::Index>(places.size()));
  const Eigen::Index last = of_interval.size() - 1;
  Eigen::Index i = 0;
  places.for_each([&](const Place& place) {
    const auto k = static_cast<Eigen::Index>(place.index);
    double floor = of_border;
    if (place.kind == Place::Kind::interval) floor = of_interval[k];
    if (place.kind == Place::Kind::node) {
      floor = std::max(of_interval[std::max<Eigen::Index>(k - 1, 0)], of_interval[std::min(k, last)]);
    }
    floors[i++] = floor;
  });
  return floors;
}

}  // namespace

RoundingFloors rounding_floors_of(const GuessMagnitudes& survey, const Eigen::VectorXd& steps,
                                  const IntervalStructure& structure) {
  constexpr double safety = 20.0;
  const double of_entries = safety * std::numeric_limits<double>::epsilon() * survey.largest_mass;
  const double terms = of_entries * survey.largest_configuration;
  // λ is multiplied by L_vv/h, which does not vanish with q; where L_vv depends on q, it grows with it.
  const double products = std::max(of_entries, terms);
  RoundingFloors floors{.smallest = terms / steps.maxCoeff(), .largest = products / steps.minCoeff()};
  if (floors.smallest == floors.largest) return floors;
  floors.constraints = floors_at(structure.rows, terms * steps.cwiseInverse(), floors.smallest);
  floors.variables = floors_at(structure.unknowns, products * steps.cwiseInverse(), floors.largest);
  return floors;
}

}  // namespace dmocbench
