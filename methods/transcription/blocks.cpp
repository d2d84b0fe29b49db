#include "methods/transcription/blocks.hpp"

#include <initializer_list>
#include <utility>

namespace dmocbench {

namespace {

constexpr std::string_view euler_lagrange_of = "lagrangian and force: the Euler-Lagrange equation of {}";
constexpr std::string_view momentum_of = "lagrangian: the momentum p = L_v of {}";
constexpr std::string_view holonomic_condition = "constraints[{}]: g(q) = 0 or its rate";
constexpr std::string_view other_bounds = "the bounds on a velocity, momentum or cost";
constexpr std::string_view velocity_condition = "velocity_constraints[{}]: A(q) v = 0 or its rate";
constexpr std::string_view equation_number = "equation_{1}";

bool gives_any(const Bounds& bounds) { return (bounds.lower.array() == bounds.upper.array()).any(); }

/// The nodes between the ends whose velocity is an unknown of its own, tied to their momentum.
std::vector<std::size_t> nodes_with_velocities(const Grid& grid, const EndRules& ends, const ProblemBounds& bounds) {
  std::vector<std::size_t> nodes;
  for (const InteriorBounds& at : bounds.interior) {
    if (!at.v.any() || ends.node_state == NodeState::velocity) continue;
    nodes.push_back(static_cast<std::size_t>(grid.node_at(at.relative_time)));
  }
  return nodes;
}

bool follows_from_controls(Quantity kind) { return kind == Quantity::control || kind == Quantity::first_order_rate; }
bool follows_from_controls(Equation /*kind*/) { return false; }

/// Numbers blocks in the order in which they are declared. A block without components is none.
template <class Kind>
class Declarations {
 public:
  Declarations(std::size_t intervals, Places& places) : intervals_(intervals), places_(places) {}

  void at_nodes(Kind kind, Eigen::Index width, const BlockWords& words, Eigen::Index stage = no_stage) {
    add({.kind = kind, .support = Support::nodes, .width = width, .words = words, .stage = stage});
  }
  void in_intervals(Kind kind, Eigen::Index width, const BlockWords& words, Eigen::Index stage = no_stage,
                    Eigen::Index component = 0) {
    add({.kind = kind,
         .support = Support::intervals,
         .width = width,
         .words = words,
         .stage = stage,
         .component = component});
  }
  void at_node(Kind kind, std::size_t node, Eigen::Index width, const BlockWords& words,
               Eigen::Index stage = no_stage) {
    add({.kind = kind, .support = Support::one_node, .width = width, .words = words, .stage = stage, .node = node});
  }
  /// Of the whole horizon; they come last.
  void of_all(Kind kind, Eigen::Index width, const BlockWords& words) {
    add({.kind = kind, .support = Support::border, .width = width, .words = words});
  }

  /// All of them. Those of the whole horizon are one run of places.
  [[nodiscard]] std::vector<Block<Kind>> finished() {
    if (next_ > places_.size()) places_.append(Place::Kind::border, 0, next_ - places_.size());
    return std::move(blocks_);
  }

 private:
  void add(Block<Kind> block) {
    if (block.width == 0) return;
    if (block.support == Support::nodes) block.length = intervals_ + 1;
    if (block.support == Support::intervals) block.length = intervals_;
    block.head = next_;
    next_ += static_cast<std::size_t>(block.width) * block.length;
    const auto kind = block.support == Support::intervals ? Place::Kind::interval : Place::Kind::node;
    for (Eigen::Index i = 0; i < block.width && block.support != Support::border; ++i) {
      places_.append(kind, block.node, block.length, follows_from_controls(block.kind));
    }
    blocks_.push_back(block);
  }

  std::size_t intervals_;
  Places& places_;
  std::size_t next_ = 0;
  std::vector<Block<Kind>> blocks_;
};

/// What the lines of both tables read.
struct Sizes {
  Sizes(const Grid& grid, const TracedProblem& traced, const Tableau& tableau, const EndRules& ends,
        const IntervalFunctions& functions, const ProblemBounds& bounds)
      : n(traced.configuration_size()),
        l(traced.first_order_size()),
        m(traced.control_size()),
        holonomic(traced.holonomic_count()),
        velocity(traced.velocity_constraint_count()),
        stages(tableau.stages()),
        conditions(functions.conditions),
        last_node(grid.intervals()),
        velocities(nodes_with_velocities(grid, ends, bounds)) {}

  Eigen::Index n;
  Eigen::Index l;
  Eigen::Index m;
  Eigen::Index holonomic;                // constraints g(q) = 0
  Eigen::Index velocity;                 // constraints A(q) q̇ = 0
  Eigen::Index stages;                   // s
  std::vector<Eigen::Index> conditions;  // of constraints, per interval
  std::size_t last_node;                 // N
  std::vector<std::size_t> velocities;   // nodes between the ends
};

/// Those of the nodes and of the intervals; `add_unknowns_of_ends` follows.
void add_unknowns(const Sizes& of, const TracedProblem& traced, const EndRules& ends,
                  const IntervalFunctions& functions, Declarations<Quantity>& declare) {
  using enum Quantity;
  constexpr auto by_q = ComponentNames::configuration;
  constexpr auto by_u = ComponentNames::control;
  constexpr auto number = ComponentNames::number;
  const Eigen::Index second_size = ends.node_state == NodeState::configuration ? 0 : of.n;
  const bool has_momenta = ends.node_state == NodeState::momentum;
  const Eigen::Index interior = functions.has_stage_unknowns ? functions.rates.stages() - 1 : 0;
  const Eigen::Index first_order_interior = functions.has_stage_unknowns ? of.stages - 1 : 0;
  const Eigen::Index control_stages = functions.controls.stages();
  const Eigen::Index shared = functions.controls.shares_controls ? 1 : 0;

  declare.at_nodes(configuration, of.n, {by_q, "bounds().q: {}", "{0}"});
  declare.at_nodes(second, second_size, {by_q, other_bounds, has_momenta ? "p_{0}" : "v_{0}"});
  declare.at_nodes(first_order, of.l, {ComponentNames::first_order, "bounds().y: {}", "y_{1}"});
  for (Eigen::Index i = 0; i < interior; ++i) {
    declare.in_intervals(rate, of.n, {by_q, other_bounds, "rate_{2}_{0}"}, i);
  }
  for (Eigen::Index i = 0; i < interior; ++i) {
    declare.in_intervals(second_rate, second_size,
                         {by_q, other_bounds, has_momenta ? "rate_{2}_p_{0}" : "rate_{2}_v_{0}"}, i);
  }
  for (Eigen::Index i = 0; i < first_order_interior; ++i) {
    declare.in_intervals(first_order_rate, of.l, {ComponentNames::first_order, other_bounds, "rate_{2}_y_{1}"}, i);
  }
  if (shared > 0) declare.at_nodes(control, of.m, {by_u, "bounds().u: {}", "{0}"}, 0);
  for (Eigen::Index i = shared; i < control_stages - shared; ++i) {
    declare.in_intervals(control, of.m, {by_u, "bounds().u: {}", control_stages > 1 ? "{0}_{2}" : "{0}"}, i);
  }
  for (Eigen::Index i = 0; i < std::ssize(of.conditions); ++i) {
    const Eigen::Index size = of.conditions[static_cast<std::size_t>(i)];
    declare.in_intervals(multiplier, size, {number, other_bounds, "lambda_{1}"}, i);
  }
  declare.at_nodes(cost, ends.mayer ? 1 : 0, {number, other_bounds, "cost_so_far"});
  declare.at_nodes(integral, traced.integral_count(), {number, other_bounds, "integral_{1}"});
}

void add_unknowns_of_ends(const Sizes& of, const TracedProblem& traced, const EndRules& ends,
                          Declarations<Quantity>& declare) {
  using enum Quantity;
  constexpr auto by_q = ComponentNames::configuration;
  constexpr auto number = ComponentNames::number;
  if (ends.first_has_velocity()) declare.at_node(velocity, 0, of.n, {by_q, other_bounds, "v_{0}_first"});
  if (ends.last_has_velocity()) declare.at_node(velocity, of.last_node, of.n, {by_q, other_bounds, "v_{0}_last"});
  declare.at_node(multiplier, of.last_node, ends.last_multipliers(), {number, other_bounds, "lambda_last_{1}"});
  for (const std::size_t node : of.velocities) {
    declare.at_node(velocity, node, of.n, {by_q, "bounds().interior: the velocity of {}", "v_{0}[{3}]"});
  }
  declare.of_all(parameter, traced.unknown_count(),
                 {ComponentNames::parameter, "the bounds on the unknown {}", "parameter_{1}"});
  declare.of_all(horizon, ends.free_horizon ? 1 : 0, {number, "the bounds on the horizon", "T"});
}

/// The equations of an element.
void add_element_equations(const Sizes& of, const EndRules& ends, const IntervalFunctions& functions,
                           Declarations<Equation>& declare) {
  using enum Equation;
  const bool has_momenta = ends.node_state == NodeState::momentum;
  const Eigen::Index count = functions.stage_equations - functions.multipliers - of.stages * of.l;
  const auto add = [&](Equation kind, std::string_view sentence, Eigen::Index stage) {
    declare.in_intervals(kind, of.n, {ComponentNames::configuration, sentence, equation_number}, stage);
  };
  if (!functions.has_stage_unknowns) {
    add(motion, "the trajectory from node to node: {}", no_stage);
    add(second_motion,
        has_momenta ? "the trajectory from node to node: the momentum of {}"
                    : "the trajectory from node to node: the velocity of {}",
        no_stage);
  } else if (ends.carries_q_alone() && count == (functions.rates.stages() - 1) * of.n) {
    for (Eigen::Index i = 0; i + 1 < functions.rates.stages(); ++i) add(euler_lagrange, euler_lagrange_of, i);
  } else if (!ends.carries_q_alone() && count == 2 * of.stages * of.n) {
    for (Eigen::Index i = 0; i < of.stages; ++i) {
      has_momenta ? add(momentum, momentum_of, i) : add(velocity, "the velocity equal to the stage rate of {}", i);
      add(euler_lagrange, euler_lagrange_of, i);
    }
  } else {
    declare.in_intervals(of_method, count, {ComponentNames::number, "equation {} of the method", equation_number});
  }
}

void add_rows(const Sizes& of, const TracedProblem& traced, const EndRules& ends, const IntervalFunctions& functions,
              const std::vector<Eigen::Index>& bounded_velocities, Declarations<Equation>& declare) {
  using enum Equation;
  constexpr auto by_q = ComponentNames::configuration;
  constexpr auto number = ComponentNames::number;
  declare.at_nodes(euler_lagrange, functions.node_rows, {by_q, euler_lagrange_of, "node_{0}"});
  add_element_equations(of, ends, functions, declare);
  for (Eigen::Index i = 0; i < std::ssize(of.conditions); ++i) {
    const Eigen::Index of_velocity = of.conditions[static_cast<std::size_t>(i)] - of.holonomic;
    declare.in_intervals(constraint, of.holonomic, {number, holonomic_condition, equation_number}, i);
    declare.in_intervals(constraint, of_velocity, {number, velocity_condition, equation_number}, i);
  }
  for (Eigen::Index i = 0; i < of.stages; ++i) {
    declare.in_intervals(first_order, of.l,
                         {ComponentNames::first_order, "first_order_rates: the rate of {}", equation_number}, i);
  }
  for (Eigen::Index i = 0; i < of.stages; ++i) {
    for (const Eigen::Index component : bounded_velocities) {
      declare.in_intervals(bounded_velocity, 1, {by_q, "bounds().v: the velocity of {}", "path_{1}"}, i, component);
    }
    declare.in_intervals(path, traced.path_constraint_count(),
                         {ComponentNames::path_constraint, "path_constraints{}", "path_{1}"}, i);
  }
  declare.in_intervals(cost, ends.mayer ? 1 : 0, {number, "running_cost: the cost so far", "cost_row"});
  declare.in_intervals(integral, traced.integral_count(),
                       {number, "integrands[{}]: the integral so far", "integral_row_{1}"});
}

void add_rows_of_ends(const Sizes& of, const TracedProblem& traced, const EndRules& ends,
                      Declarations<Equation>& declare) {
  using enum Equation;
  constexpr auto by_q = ComponentNames::configuration;
  constexpr auto number = ComponentNames::number;
  const Eigen::Index tied = ends.node_state == NodeState::momentum ? of.n : 0;
  if (ends.first_has_velocity()) declare.at_node(momentum, 0, tied, {by_q, momentum_of, "momentum_{0}_first"});
  if (ends.last_has_velocity()) {
    declare.at_node(momentum, of.last_node, tied, {by_q, momentum_of, "momentum_{0}_last"});
  }
  if (ends.has_first_constraints()) {
    for (int i = 0; i < 2; ++i) {
      declare.at_node(constraint, 0, of.holonomic, {number, holonomic_condition, "constraint_first_{1}"});
    }
    declare.at_node(constraint, 0, of.velocity, {number, velocity_condition, "velocity_constraint_first_{1}"});
  }
  if (ends.has_last_constraints()) {
    const auto at_last = [&](Eigen::Index count, std::string_view sentence, std::string_view name) {
      declare.at_node(constraint, of.last_node, count, {number, sentence, name});
    };
    at_last(of.holonomic, holonomic_condition, "constraint_last_{1}");
    at_last(of.velocity, velocity_condition, "velocity_constraint_last_{1}");
  }
  for (const std::size_t node : of.velocities) {
    declare.at_node(momentum, node, of.n, {by_q, momentum_of, "momentum_{0}[{3}]"});
  }
  declare.of_all(boundary_condition, traced.boundary_condition_count(),
                 {ComponentNames::boundary_condition, "boundary_conditions{}", "condition_{1}"});
}

template <class Kind>
void append_places(const Block<Kind>& block, bool is_global, std::vector<SeriesPlace>& places) {
  for (Eigen::Index i = 0; i < block.width; ++i) places.emplace_back(block.at(i), is_global);
}

template <class Kind>
const Block<Kind>& found(const std::vector<Block<Kind>>& blocks, Kind kind, Eigen::Index stage) {
  static const Block<Kind> none;
  const auto is_it = [&](const Block<Kind>& block) { return block.kind == kind && block.stage == stage; };
  const auto place = std::ranges::find_if(blocks, is_it);
  return place == blocks.end() ? none : *place;
}

template <class Kind>
const Block<Kind>& found_at(const std::vector<Block<Kind>>& blocks, Kind kind, std::size_t node) {
  static const Block<Kind> none;
  const auto place = std::ranges::find_if(blocks, [&](const Block<Kind>& block) {
    return block.kind == kind && block.support == Support::one_node && block.node == node;
  });
  return place == blocks.end() ? none : *place;
}

template <class Kind>
const Block<Kind>& with_number(const std::vector<Block<Kind>>& blocks, std::size_t number) {
  return *(std::ranges::upper_bound(blocks, number, {}, &Block<Kind>::head) - 1);
}

template <class Kind>
Eigen::Index added_per_interval(const std::vector<Block<Kind>>& blocks) {
  Eigen::Index count = 0;
  for (const Block<Kind>& block : blocks) {
    if (block.support == Support::nodes || block.support == Support::intervals) count += block.width;
  }
  return count;
}

}  // namespace

ProgramBlocks::ProgramBlocks(const Grid& grid, const TracedProblem& traced, const Tableau& tableau,
                             const EndRules& ends, const IntervalFunctions& functions, const ProblemBounds& bounds) {
  const Sizes sizes(grid, traced, tableau, ends, functions, bounds);
  structure_.intervals = grid.intervals();
  structure_.has_interior_equations =
      !sizes.velocities.empty() || std::ranges::any_of(bounds.interior, [](const InteriorBounds& at) {
        return gives_any(at.q) || gives_any(at.v) || gives_any(at.y);
      });
  Declarations<Quantity> unknowns(intervals(), structure_.unknowns);
  add_unknowns(sizes, traced, ends, functions, unknowns);
  add_unknowns_of_ends(sizes, traced, ends, unknowns);
  unknowns_ = unknowns.finished();
  Declarations<Equation> rows(intervals(), structure_.rows);
  add_rows(sizes, traced, ends, functions, bounds.bounded_velocities(), rows);
  add_rows_of_ends(sizes, traced, ends, rows);
  rows_ = rows.finished();
  place_interval(functions.controls.stages());
  place_ends();
}

void ProgramBlocks::place_interval(Eigen::Index control_stages) {
  using enum Quantity;
  const auto see = [&](Support support, std::initializer_list<Quantity> kinds, std::size_t right = 0) {
    for (const Quantity kind : kinds) {
      for (const UnknownBlock& block : unknowns_) {
        if (block.kind == kind && block.support == support) interval_unknowns_.push_back(block.later(right));
      }
    }
  };
  for (const std::size_t right : {0U, 1U}) see(Support::nodes, {configuration, second, first_order}, right);
  see(Support::intervals, {rate, second_rate, first_order_rate});
  const std::size_t controls = interval_unknowns_.size();
  see(Support::nodes, {control});
  const bool are_shared = interval_unknowns_.size() > controls;
  see(Support::intervals, {control});
  see(Support::nodes, {control}, 1);
  if (are_shared) interval_unknowns_.back().stage = control_stages - 1;
  see(Support::intervals, {multiplier});
  for (const std::size_t right : {0U, 1U}) see(Support::nodes, {cost, integral}, right);
  see(Support::border, {horizon, parameter});
  for (const UnknownBlock& block : interval_unknowns_) {
    append_places(block, block.support == Support::border, unknown_places_);
  }
  for (const std::size_t right : {0U, 1U}) {
    for (const RowBlock& block : rows_) {
      if (block.support == Support::nodes) append_places(block.later(right), false, row_places_);
    }
  }
  for (const RowBlock& block : rows_) {
    if (block.support == Support::intervals) append_places(block, false, row_places_);
  }
}

void ProgramBlocks::place_ends() {
  using enum Quantity;
  const auto place = [&](const UnknownBlock& block) { append_places(block, false, end_unknown_places_); };
  for (const std::size_t node : {std::size_t{0}, intervals()}) {
    for (const Quantity kind : {configuration, second, first_order}) place(unknown(kind).later(node));
    place(unknown_at(velocity, node));
  }
  place(unknown_at(multiplier, intervals()));
  place(unknown(cost).later(intervals()));
  place(unknown(horizon));
  place(unknown(parameter));

  for (const std::size_t node : {std::size_t{0}, intervals()}) {
    append_places(row_at(Equation::momentum, node), false, end_row_places_);
    const bool adds_to_node = unknown_at(velocity, node).width > 0 || unknown_at(multiplier, node).width > 0;
    if (adds_to_node) append_places(row(Equation::euler_lagrange).later(node), false, end_row_places_);
  }
  for (const RowBlock& block : rows_) {
    if (block.kind == Equation::constraint && block.support == Support::one_node) {
      append_places(block, false, end_row_places_);
    }
  }
  append_places(row(Equation::boundary_condition), false, end_row_places_);
}

const UnknownBlock& ProgramBlocks::unknown(Quantity kind, Eigen::Index stage) const {
  return found(interval_unknowns_, kind, stage);
}

const UnknownBlock& ProgramBlocks::unknown_at(Quantity kind, std::size_t node) const {
  return found_at(unknowns_, kind, node);
}

const RowBlock& ProgramBlocks::row(Equation kind, Eigen::Index stage) const { return found(rows_, kind, stage); }

const RowBlock& ProgramBlocks::row_at(Equation kind, std::size_t node) const { return found_at(rows_, kind, node); }

const UnknownBlock& ProgramBlocks::block_of_unknown(std::size_t number) const { return with_number(unknowns_, number); }

const RowBlock& ProgramBlocks::block_of_row(std::size_t number) const { return with_number(rows_, number); }

Eigen::Index ProgramBlocks::unknowns_per_interval() const { return added_per_interval(unknowns_); }

Eigen::Index ProgramBlocks::rows_per_interval() const { return added_per_interval(rows_); }

}  // namespace dmocbench
