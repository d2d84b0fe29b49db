// The functions of `Transcription` that give a program other values.

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "methods/error.hpp"
#include "methods/transcription/program_floors.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

namespace {

void require_changeable(const Problem& problem, const TracedProblem& traced, const Eigen::VectorXd& before,
                        const Eigen::VectorXd& now) {
  for (Eigen::Index i = 0; i < now.size(); ++i) {
    const auto number = static_cast<std::size_t>(i);
    if (now[i] == before[i] || !traced.are_constants()[number]) continue;
    throw Error(
        fmt::format("{}: formulas of this transcription contain the parameter {} as {:g}; to change it, keep it "
                    "open when the transcription is made",
                    problem.name(), problem.parameters()[number].name, before[i]));
  }
}

void require_same_velocities(const Problem& problem, const ProblemBounds& before, const ProblemBounds& now) {
  if (before.bounded_velocities() == now.bounded_velocities()) return;
  throw Error(problem.name() + ": other velocities than before have bounds; make a new transcription");
}

void require_same_times(const Problem& problem, const ProblemBounds& before, const ProblemBounds& now) {
  const auto is_same = [](const InteriorBounds& a, const InteriorBounds& b) {
    return a.relative_time == b.relative_time && a.v.any() == b.v.any();
  };
  if (std::ranges::equal(before.interior, now.interior, is_same)) return;
  throw Error(problem.name() +
              ": bounds().interior has other times than before, or bounds on other velocities; that is another "
              "transcription");
}

}  // namespace

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
    throw Error(fmt::format("{}: {} needs {} numbers each for q and v", problem_->name(), name, n));
  }
  if (state.y.size() != traced_.first_order_size() || !state.y.allFinite()) {
    throw Error(fmt::format("{}: {} needs {} numbers y", problem_->name(), name, traced_.first_order_size()));
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
    throw Error(
        fmt::format("{}: a condition or a cost of the ends contains {}, which cannot change", problem_->name(), what));
  };
  if (!end_functions_) return;
  const bool gives_velocities = end_rules_.node_state != NodeState::velocity;
  const ProblemBounds& before = problem_bounds_;
  const ProblemBounds& now = values.bounds;
  if (gives_velocities && end_rules_.first_clamped && traced_.ends_read_first_velocity() &&
      now.first.v.lower != before.first.v.lower) {
    refuse("the velocity of the first end");
  }
  if (gives_velocities && end_rules_.last_clamped && traced_.ends_read_last_velocity() &&
      now.last.v.lower != before.last.v.lower) {
    refuse("the velocity of the last end");
  }
  const bool reads_horizon =
      traced_.ends_read_horizon() || (end_rules_.last_has_velocity() && traced_.momentum_depends_on_time());
  if (!end_rules_.free_horizon && reads_horizon && values.horizon != guessed_horizon_) refuse("the horizon");
}

void Transcription::use(Values values) {
  values.bounds = complete_bounds(*problem_, std::move(values.bounds));
  const HorizonBounds& horizon = values.bounds.horizon;
  if (!(values.horizon >= horizon.lower) || !(values.horizon <= horizon.upper)) {
    throw Error(fmt::format("{}: the horizon {:g} lies outside its bounds {:g} and {:g}", problem_->name(),
                            values.horizon, horizon.lower, horizon.upper));
  }
  if (horizon.is_free() != end_rules_.free_horizon) {
    throw Error(problem_->name() + ": whether the horizon is free cannot change; make a new transcription");
  }
  require_same_velocities(*problem_, problem_bounds_, values.bounds);
  require_same_times(*problem_, problem_bounds_, values.bounds);
  require_readable_ends(values);
  ProgramBounds bounds = program_bounds(*problem_, traced_, values.bounds, values.horizon, end_rules_, layout_, grid_);
  require_same_structure(*problem_, bounds_, bounds);
  // Nothing below throws, except std::bad_alloc.
  problem_bounds_ = std::move(values.bounds);
  bounds_ = std::move(bounds);
  if (values.horizon == guessed_horizon_) return;
  guessed_horizon_ = values.horizon;
  rounding_floors_ = rounding_floors_of(magnitudes_, guessed_horizon_ * grid_.relative_widths(), layout_);
  if (end_rules_.free_horizon) return;
  step_inputs_ = guessed_horizon_ * grid_.relative_widths();
  time_inputs_ = guessed_horizon_ * grid_.relative_times();
  set_tie_inputs();
}

}  // namespace dmocbench
