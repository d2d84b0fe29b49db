#include "methods/transcription/transcription.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/problem_check.hpp"
#include "methods/transcription/derivatives/part_places.hpp"
#include "methods/transcription/motions/guess_check.hpp"
#include "methods/transcription/program_bounds.hpp"

namespace dmocbench {

namespace {

std::vector<double> interior_times(const ProblemBounds& bounds) {
  std::vector<double> times;
  for (const InteriorBounds& at : bounds.interior) times.push_back(at.relative_time);
  return times;
}

/// Equalities along the motion take a control each, at every stage. Intervals with stages at their nodes have one of a
/// node both, which only controls of their own distinguish.
void require_equalities_fit(const Problem& problem, const TracedProblem& traced, const Tableau& tableau,
                            const Tableau& controls, const ProblemBounds& bounds) {
  const Bounds path = bounds.of_path(traced.path_constraint_count());
  const bool has_stages_at_nodes = tableau.c.minCoeff() == 0.0 && tableau.c.maxCoeff() == 1.0;
  Eigen::Index equalities = 0;
  for (Eigen::Index i = 0; i < path.lower.size(); ++i) {
    if (!path.is_fixed(i)) continue;
    ++equalities;
    if (controls.stages() < tableau.stages()) {
      throw Error(
          "{}: {} makes path_constraints[{}] an equality at {} points of an interval, more than its {} "
          "control nodes; use at least as many --control-nodes",
          problem.name(), member_name("bounds().path"), i, tableau.stages(), controls.stages());
    }
    const bool is_same = controls.shares_controls || !traced.constraints_read_controls()[static_cast<std::size_t>(i)];
    if (!has_stages_at_nodes || !is_same) continue;
    throw Error(
        "{}: {} makes path_constraints[{}] an equality, which two intervals would impose on the same node; "
        "use --tableau gauss",
        problem.name(), member_name("bounds().path"), i);
  }
  if (equalities <= traced.control_size()) return;
  throw Error("{}: {} makes {} path constraints equalities; at most {}, one per control, are possible", problem.name(),
              member_name("bounds().path"), equalities, traced.control_size());
}

/// A path constraint that vanishes at an end by a boundary condition is not imposed a second time by a stage at that
/// end: there its bounds become ones that 0 does not reach.
void release_conditions_of_ends(const TracedProblem& traced, double horizon, const Tableau& tableau,
                                const ProgramBlocks& blocks, Bounds& rows) {
  const Eigen::Index last_stage = tableau.stages() - 1;
  const bool has_first = tableau.c[0] == 0.0;
  const bool has_last = tableau.c[last_stage] == 1.0;
  if (!(has_first || has_last) || traced.path_constraint_count() * traced.boundary_condition_count() == 0) return;
  InputCounter inputs(static_cast<std::size_t>(traced.unknown_count()) + traced.open_parameters().size());
  const auto state = [&](const Expression& t) {
    State x{inputs.take(traced.configuration_size()), inputs.take(traced.configuration_size()), t};
    x.y = inputs.take(traced.first_order_size());
    return x;
  };
  const State first = state(0.0);
  const State last = state(horizon);
  const ExpressionVector conditions = traced.at_ends(first, last).conditions;
  const auto release = [&](const State& end, Eigen::Index stage, std::size_t interval) {
    const ExpressionVector constraints = traced.at(end).path_constraints;
    for (Eigen::Index i = 0; i < constraints.size(); ++i) {
      const auto is_same = [&h = constraints[i]](const Expression& r) { return r.is_same(h) || r.is_same(-h); };
      if (traced.constraints_read_controls()[static_cast<std::size_t>(i)] || std::ranges::none_of(conditions, is_same))
        continue;
      const Eigen::Index row = blocks.row(Equation::path, stage).later(interval).index(i);
      rows.lower[row] = std::min(rows.lower[row], -1.0);
      rows.upper[row] = std::max(rows.upper[row], 1.0);
    }
  };
  if (has_first) release(first, 0, 0);
  if (has_last) release(last, last_stage, blocks.intervals() - 1);
}

constexpr std::array cost_forms{Named<CostForm>{"bolza", CostForm::bolza}, Named<CostForm>{"mayer", CostForm::mayer}};

void require_changeable(const Problem& problem, const TracedProblem& traced, const Eigen::VectorXd& before,
                        const Eigen::VectorXd& now) {
  for (Eigen::Index i = 0; i < now.size(); ++i) {
    const auto number = static_cast<std::size_t>(i);
    if (now[i] == before[i] || !traced.are_constants()[number]) continue;
    throw Error(
        "{}: formulas of this transcription contain the parameter {} with the value {:g}; to change it, "
        "keep it open when the transcription is created",
        problem.name(), problem.parameters()[number].name, before[i]);
  }
}

void require_same_velocities(const Problem& problem, const ProblemBounds& before, const ProblemBounds& now) {
  if (before.bounded_velocities() == now.bounded_velocities()) return;
  throw Error(problem.name() + ": the velocities with bounds have changed; create a new transcription");
}

void require_same_times(const Problem& problem, const ProblemBounds& before, const ProblemBounds& now) {
  const auto is_same = [](const InteriorBounds& a, const InteriorBounds& b) {
    return a.relative_time == b.relative_time && a.v.any() == b.v.any();
  };
  if (std::ranges::equal(before.interior, now.interior, is_same)) return;
  throw Error(problem.name() + ": " + member_name("bounds().interior") +
              " has changed its times or its velocities with bounds; create a new transcription");
}

}  // namespace

CostForm cost_form_named(std::string_view name) {
  return value_named(cost_forms, name, "there is no form of the cost");
}

Transcription::Transcription(const Problem& problem, const Element& element, Tableau tableau, const Grid& grid,
                             std::string_view derivatives, CostForm form)
    : Transcription(problem, element, std::move(tableau), grid, OpenParameters{}, derivatives, form) {}

Transcription::Transcription(const Problem& problem, const Element& element, Tableau tableau, const Grid& grid,
                             const OpenParameters& open, std::string_view derivatives, CostForm form)
    : problem_(&problem),
      parameters_(dmocbench::parameter_values(problem)),
      tableau_(std::move(tableau)),
      cost_scale_(positive_cost_scale(problem)),
      guessed_horizon_(problem.horizon()),
      traced_(problem, open.names),
      problem_bounds_(problem_bounds(problem)),
      grid_(grid.with_nodes_at(interior_times(problem_bounds_))),
      end_rules_(end_rules(problem, traced_, element.node_state(), form == CostForm::mayer)),
      functions_(trace_interval(traced_, element, tableau_, interval_rules())),
      end_functions_(trace_ends(problem, traced_, end_rules_)),
      blocks_(grid_, traced_, tableau_, end_rules_, functions_, problem_bounds_),
      horizon_place_(blocks_.unknown(Quantity::horizon).index()),
      bounds_(program_bounds(problem, traced_, problem_bounds_, guessed_horizon_, end_rules_, blocks_, grid_)),
      magnitudes_(check_guess(problem, traced_, grid_,
                              element.node_state() != NodeState::configuration || tableau_.stages() > 1)),
      rounding_floors_(
          rounding_floors_of(magnitudes_, guessed_horizon_ * grid_.relative_widths(), blocks_.structure())),
      step_inputs_((end_rules_.free_horizon ? 1.0 : guessed_horizon_) * grid_.relative_widths()),
      time_inputs_((end_rules_.free_horizon ? 1.0 : guessed_horizon_) * grid_.relative_times()),
      jacobian_pattern_(assemble_pattern(
          jacobian_entries(functions_, blocks_.row_places(), blocks_.unknown_places(), grid.intervals()))),
      hessian_pattern_(assemble_pattern(hessian_entries(functions_, blocks_.unknown_places(), grid.intervals()))) {
  require_equalities_fit(problem, traced_, tableau_, functions_.controls, problem_bounds_);
  release_conditions_of_ends(traced_, guessed_horizon_, tableau_, blocks_, bounds_.constraints);
  require_enough_intervals(problem, element);
  if (!problem_bounds_.interior.empty()) traced_.require_no_constraints("a program with bounds between the ends");
  check_constraint_windows(problem, traced_, tableau_, grid_);
  std::vector<AddedPart> added;
  if (end_functions_) {
    added.push_back(
        {&*end_functions_, blocks_.end_unknown_places(), blocks_.end_row_places(), &step_inputs_, &time_inputs_});
  }
  std::vector<const UnknownBlock*> velocities;
  for (const UnknownBlock& block : blocks_.unknowns()) {
    const bool is_between = block.node > 0 && block.node < blocks_.intervals();
    if (block.kind == Quantity::velocity && is_between) velocities.push_back(&block);
  }
  LocalFunctions tie;
  if (!velocities.empty()) tie = trace_velocity_tie(traced_, element, tableau_, interval_rules());
  tie_inputs_.reserve(velocities.size());
  for (const UnknownBlock* velocity : velocities) {
    TieInputs& inputs = tie_inputs_.emplace_back(TieInputs{.interval = static_cast<Eigen::Index>(velocity->node) - 1});
    added.push_back(tie_of(tie, *velocity, inputs));
  }
  set_tie_inputs();
  // Added parts extend the patterns, which must be complete before the arrays of the intervals are allocated.
  for (AddedPart& part : added) {
    part.jacobian =
        extend_pattern(jacobian_pattern_.pattern, jacobian_entries(*part.functions, part.rows, part.unknowns, 1));
    part.hessian = extend_pattern(hessian_pattern_.pattern, hessian_entries(*part.functions, part.unknowns, 1));
  }
  add_part({&functions_, blocks_.unknown_places(), blocks_.row_places(), &step_inputs_, &time_inputs_,
            jacobian_pattern_.places, hessian_pattern_.places},
           derivatives);
  for (const AddedPart& part : added) add_part(part, derivatives);
}

IntervalRules Transcription::interval_rules() const {
  return {.cost_scale = cost_scale_,
          .mayer = end_rules_.mayer,
          .free_horizon = end_rules_.free_horizon,
          .bounded_velocities = problem_bounds_.bounded_velocities()};
}

Transcription::AddedPart Transcription::tie_of(const LocalFunctions& functions, const UnknownBlock& velocity,
                                               const TieInputs& inputs) const {
  const RowBlock& rows = blocks_.row_at(Equation::momentum, velocity.node);
  AddedPart part{&functions, {}, {}, &inputs.step, &inputs.time};
  for (const SeriesPlace& place : blocks_.unknown_places()) part.unknowns.emplace_back(place.at(velocity.node - 1));
  for (Eigen::Index i = 0; i < velocity.width; ++i) {
    part.unknowns.emplace_back(velocity.at(i));
    part.rows.emplace_back(rows.at(i));
  }
  return part;
}

void Transcription::set_tie_inputs() {
  for (TieInputs& tie : tie_inputs_) {
    tie.step[0] = step_inputs_[tie.interval];
    tie.time[0] = time_inputs_[tie.interval];
  }
}

void Transcription::add_part(const AddedPart& part, std::string_view derivatives) {
  const bool is_added = !parts_.empty();
  const ProgramArrays arrays{.variables = blocks_.variable_count(),
                             .constraints = blocks_.constraint_count(),
                             .jacobian = jacobian_pattern_.pattern.size(),
                             .hessian = hessian_pattern_.pattern.size()};
  PartPlaces places =
      part_places(*part.functions, part.unknowns, part.rows, part.jacobian, part.hessian, arrays,
                  is_added ? 1 : blocks_.intervals(), is_added ? AssemblyMode::part : AssemblyMode::whole);
  parts_.push_back(std::make_unique<ProgramPart>(*part.functions, std::move(places), *part.steps, *part.times,
                                                 traced_.open_values(), derivatives));
}

void Transcription::require_enough_intervals(const Problem& problem, const Element& element) const {
  // The number of free variables minus the number of equations on a given number of intervals.
  const auto fixed = static_cast<long long>(variable_count()) - static_cast<long long>(free_variable_count(*this));
  const long long fixed_in_interval = fixed_variables_of_an_interval();
  const std::size_t intervals = blocks_.intervals();
  const long long inequalities = inequalities_of_an_interval();
  const long long gain =
      blocks_.unknowns_per_interval() - fixed_in_interval - (blocks_.rows_per_interval() - inequalities);
  const long long surplus =
      static_cast<long long>(variable_count()) - fixed -
      (static_cast<long long>(constraint_count()) - static_cast<long long>(intervals) * inequalities);
  if (surplus >= 0) return;
  if (gain <= 0) {
    throw Error("{} has no free control, so no number of intervals can satisfy both end states", problem.name());
  }
  const auto smallest = static_cast<long long>(intervals) + (-surplus + gain - 1) / gain;
  throw Error("{} with {} has fewer free variables than equations on {} intervals; use at least {}", problem.name(),
              element.name(), intervals, smallest);
}

long long Transcription::inequalities_of_an_interval() const {
  long long count = 0;
  for (const RowBlock& block : blocks_.rows()) {
    if (block.support != Support::intervals) continue;
    for (Eigen::Index i = 0; i < block.width; ++i) count += bounds_.constraints.is_fixed(block.index(i)) ? 0 : 1;
  }
  return count;
}

long long Transcription::fixed_variables_of_an_interval() const {
  return std::ranges::count_if(blocks_.structure().unknowns.runs(), [&](const PlaceRun& run) {
    return run.kind == Place::Kind::interval && is_fixed(*this, static_cast<Eigen::Index>(run.first));
  });
}

Eigen::VectorXd Transcription::unknown_parameters(const VectorIn& x) const {
  const UnknownBlock& block = blocks_.unknown(Quantity::parameter);
  return x.segment(block.index(), block.width);
}

double Transcription::horizon(const VectorIn& x) const {
  return has_free_horizon() ? x[horizon_place_] : guessed_horizon_;
}

std::span<const Tape::Input> Transcription::bind(const VectorIn& x, const VectorIn& multipliers,
                                                 double objective_factor) {
  return parts_.front()->bind(x, multipliers, objective_factor);
}

Eigen::MatrixXd Transcription::tabulate(const Schedule& schedule, const VectorIn& x, const VectorIn& multipliers) {
  return Tape(schedule).table(grid_.relative_widths().size(), bind(x, multipliers, 1.0));
}

double Transcription::objective(const VectorIn& x) {
  double cost = 0.0;
  for (const auto& part : parts_) cost += part->cost(x);
  return cost;
}

void Transcription::gradient(const VectorIn& x, VectorOut result) {
  for (const auto& part : parts_) part->gradient(x, result);
}

void Transcription::constraints(const VectorIn& x, VectorOut result) {
  for (const auto& part : parts_) part->rows(x, result);
}

void Transcription::jacobian(const VectorIn& x, VectorOut values) {
  for (const auto& part : parts_) part->jacobian(x, values);
}

void Transcription::hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) {
  for (const auto& part : parts_) part->hessian(x, objective_factor, multipliers, values);
}

void Transcription::set_parameters(const Eigen::VectorXd& values) {
  const ParameterScope scope(*problem_, values);
  require_changeable(*problem_, traced_, parameters_, values);
  traced_.set_parameters(values);
  try {
    use({problem_bounds(*problem_), problem_->horizon()});
  } catch (...) {
    traced_.set_parameters(parameters_);
    throw;
  }
  parameters_ = values;
}

void Transcription::set_parameter(std::string_view name, double value) {
  Eigen::VectorXd values = parameters_;
  values[static_cast<Eigen::Index>(parameter_number(*problem_, name))] = value;
  set_parameters(values);
}

void Transcription::set_initial_state(const BoundaryState& state) {
  set_end(state, &ProblemBounds::first, "initial_state");
}

void Transcription::set_final_state(const BoundaryState& state) { set_end(state, &ProblemBounds::last, "final_state"); }

void Transcription::set_end(const BoundaryState& state, EndBounds ProblemBounds::*end, const char* name) {
  const Eigen::Index n = traced_.configuration_size();
  if (state.q.size() != n || state.v.size() != n || !state.q.allFinite() || !state.v.allFinite()) {
    throw Error("{}: {} needs {} numbers each for q and v", problem_->name(), member_name(name), n);
  }
  if (state.y.size() != traced_.first_order_size() || !state.y.allFinite()) {
    throw Error("{}: {} needs {} numbers y", problem_->name(), member_name(name), traced_.first_order_size());
  }
  Values values = present_values();
  const auto fix = [](const Eigen::VectorXd& at, Bounds& bounds) {
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      if (bounds.is_fixed(i)) bounds.lower[i] = bounds.upper[i] = at[i];
    }
  };
  EndBounds& bounds = values.bounds.*end;
  fix(state.q, bounds.q);
  fix(state.v, bounds.v);
  fix(state.y, bounds.y);
  use(std::move(values));
}

void Transcription::set_bounds(const ProblemBounds& bounds) {
  use({bounds, bounds.horizon.is_free() ? guessed_horizon_ : bounds.horizon.lower});
}

void Transcription::set_horizon(double horizon) {
  Values values = present_values();
  values.horizon = horizon;
  if (!values.bounds.horizon.is_free()) values.bounds.horizon = {horizon, horizon};
  use(std::move(values));
}

/// Where the velocity of an end, or T, is not an unknown, the formulas of the ends contain its value.
void Transcription::require_readable_ends(const Values& values) const {
  const auto refuse = [&](const char* what) {
    throw Error("{}: the boundary conditions or the final cost contain {}, which cannot be changed", problem_->name(),
                what);
  };
  if (!end_functions_) return;
  const bool gives_velocities = end_rules_.node_state != NodeState::velocity;
  const ProblemBounds& before = problem_bounds_;
  const ProblemBounds& now = values.bounds;
  if (gives_velocities && end_rules_.first_clamped && traced_.ends_read_first_velocity() &&
      now.first.v.lower != before.first.v.lower) {
    refuse("the velocity at the first end");
  }
  if (gives_velocities && end_rules_.last_clamped && traced_.ends_read_last_velocity() &&
      now.last.v.lower != before.last.v.lower) {
    refuse("the velocity at the last end");
  }
  const bool reads_horizon =
      traced_.ends_read_horizon() || (end_rules_.last_has_velocity() && traced_.momentum_depends_on_time());
  if (!end_rules_.free_horizon && reads_horizon && values.horizon != guessed_horizon_) refuse("the horizon");
}

void Transcription::use(Values values) {
  values.bounds = complete_bounds(*problem_, std::move(values.bounds));
  const HorizonBounds& horizon = values.bounds.horizon;
  if (!(values.horizon >= horizon.lower) || !(values.horizon <= horizon.upper)) {
    throw Error("{}: the horizon {:g} lies outside its bounds {:g} and {:g}", problem_->name(), values.horizon,
                horizon.lower, horizon.upper);
  }
  if (horizon.is_free() != end_rules_.free_horizon) {
    throw Error(problem_->name() +
                ": a fixed horizon cannot become free, nor a free horizon fixed; create a new transcription");
  }
  require_same_velocities(*problem_, problem_bounds_, values.bounds);
  require_same_times(*problem_, problem_bounds_, values.bounds);
  require_readable_ends(values);
  ProgramBounds bounds = program_bounds(*problem_, traced_, values.bounds, values.horizon, end_rules_, blocks_, grid_);
  release_conditions_of_ends(traced_, values.horizon, tableau_, blocks_, bounds.constraints);
  require_same_structure(*problem_, bounds_, bounds);
  // Nothing below throws, except std::bad_alloc.
  problem_bounds_ = std::move(values.bounds);
  bounds_ = std::move(bounds);
  if (values.horizon == guessed_horizon_) return;
  guessed_horizon_ = values.horizon;
  rounding_floors_ = rounding_floors_of(magnitudes_, guessed_horizon_ * grid_.relative_widths(), blocks_.structure());
  if (end_rules_.free_horizon) return;
  step_inputs_ = guessed_horizon_ * grid_.relative_widths();
  time_inputs_ = guessed_horizon_ * grid_.relative_times();
  set_tie_inputs();
}

}  // namespace dmocbench
