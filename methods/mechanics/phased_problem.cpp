#include "methods/mechanics/phased_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/error.hpp"
#include "methods/mechanics/first_order_problem.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/point_of_inputs.hpp"
#include "methods/mechanics/problem_bounds.hpp"
#include "methods/runtime/numbers_in_text.hpp"

namespace dmocbench {

namespace {

/// A bound that scaling with a positive number does not change.
bool is_kept_by_scaling(double bound) { return bound == 0.0 || std::abs(bound) > std::numeric_limits<double>::max(); }

bool is_kept_by_scaling(const Bounds& bounds, Eigen::Index i) {
  return is_kept_by_scaling(bounds.lower[i]) && is_kept_by_scaling(bounds.upper[i]);
}

Eigen::VectorXd joined(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd all(a.size() + b.size());
  all << a, b;
  return all;
}

void append(Bounds& to, const Bounds& more) {
  to = {.lower = joined(to.lower, more.lower), .upper = joined(to.upper, more.upper)};
}

void put(Bounds& into, Eigen::Index first, const Bounds& part) {
  into.lower.segment(first, part.lower.size()) = part.lower;
  into.upper.segment(first, part.upper.size()) = part.upper;
}

Bounds scaled(const Bounds& bounds, double factor) {
  return {.lower = factor * bounds.lower, .upper = factor * bounds.upper};
}

/// The bounds that are the same for q̇ = s v whatever s > 0 is; none in the place of others.
Bounds kept_by_scaling(Bounds bounds) {
  for (Eigen::Index i = 0; i < bounds.lower.size(); ++i) {
    if (!is_kept_by_scaling(bounds, i)) put(bounds, i, Bounds::none(1));
  }
  return bounds;
}

Eigen::Index open_entries(const EndBounds& end) {
  Eigen::Index open = 0;
  for (const Bounds* part : {&end.q, &end.v, &end.y}) open += (part->lower.array() != part->upper.array()).count();
  return open;
}

/// A velocity at an end, between bounds, as an unknown of its own.
std::string name_of_end_velocity(const std::string& phase, const std::string& coordinate, bool is_last) {
  return fmt::format("v_{}_{}_at_{}", phase, coordinate, is_last ? "end" : "start");
}

void add_shared(std::vector<Parameter>& parameters, const Parameter& added, const std::string& phase) {
  const auto same = std::ranges::find(parameters, added.name, &Parameter::name);
  if (same == parameters.end()) {
    parameters.push_back(added);
  } else if (same->value != added.value || same->lower != added.lower || same->upper != added.upper ||
             same->whole != added.whole || same->is_unknown != added.is_unknown) {
    throw Error(
        "phase {}: the parameter {} has another value, range or kind in an earlier phase; phases share "
        "parameters of the same name, so make them equal or rename one",
        phase, added.name);
  }
}

void add_end_velocities(std::vector<Parameter>& parameters, const PhasedProblem::Phase& phase, const Bounds& bounds,
                        const Eigen::VectorXd& guess, bool is_last) {
  const std::vector<std::string> names = phase.problem->configuration_names();
  for (Eigen::Index i = 0; i < guess.size(); ++i) {
    if (is_kept_by_scaling(bounds, i) || bounds.is_fixed(i)) continue;
    const std::string& coordinate = names[static_cast<std::size_t>(i)];
    parameters.push_back(
        {.name = name_of_end_velocity(phase.name, coordinate, is_last),
         .value = std::clamp(guess[i], bounds.lower[i], bounds.upper[i]),
         .unit = "",
         .meaning = fmt::format("velocity of {} at the {} of {}", coordinate, is_last ? "end" : "start", phase.name),
         .lower = bounds.lower[i],
         .upper = bounds.upper[i],
         .is_unknown = true});
  }
}

ProblemBounds bounds_of_phase(const PhasedProblem::Phase& phase) {
  const HorizonBounds horizon = phase.problem->bounds().horizon;
  if (!(horizon.lower > 0.0)) {
    throw Error("phase {}: the lower bound of its duration is {:g}; it must be positive", phase.name, horizon.lower);
  }
  return problem_bounds(*phase.problem);
}

std::string name_of_duration(const PhasedProblem::Phase& phase) { return "duration_" + phase.name; }

std::vector<Parameter> parameters_of(const std::vector<PhasedProblem::Phase>& phases,
                                     std::vector<Parameter> parameters) {
  if (phases.empty()) throw Error("a problem of phases needs at least one phase");
  for (const PhasedProblem::Phase& phase : phases) {
    for (const Parameter& parameter : phase.problem->parameters()) add_shared(parameters, parameter, phase.name);
  }
  for (const PhasedProblem::Phase& phase : phases) {
    const ProblemBounds bounds = bounds_of_phase(phase);
    if (!bounds.horizon.is_free()) continue;
    const Unit unit = phase.problem->card().time_unit;
    parameters.push_back({.name = name_of_duration(phase),
                          .value = phase.problem->horizon(),
                          .unit = unit.factor == 1.0 ? unit.name : "",
                          .meaning = "duration of the phase " + phase.name,
                          .lower = bounds.horizon.lower,
                          .upper = bounds.horizon.upper,
                          .is_unknown = true});
    add_end_velocities(parameters, phase, bounds.first.v, phase.problem->initial_state().v, false);
    add_end_velocities(parameters, phase, bounds.last.v, phase.problem->final_state().v, true);
  }
  return parameters;
}

/// How many numbers of an end its constraints determine: g = 0, its rate and A q̇ = 0.
Eigen::Index held_numbers(const Problem& problem) {
  const ExpressionVector x = input_vector(0, problem.configuration_size());
  return 2 * problem.constraints(x).size() + problem.velocity_constraints(x, x).size();
}

Eigen::Index path_constraint_count(const Problem& problem) {
  return problem.path_constraints(point_of_inputs(problem)).size();
}

}  // namespace

PhasedProblem::PhasedProblem(std::vector<Phase> phases, std::vector<Parameter> parameters)
    : Problem(parameters_of(phases, std::move(parameters))) {
  for (Phase& phase : phases) add_phase(std::move(phase));
}

void PhasedProblem::add_phase(Phase phase) {
  if (std::ranges::count(phases_, phase.name, &Phase::name) > 0) {
    throw Error("two phases are named {}; rename one", phase.name);
  }
  if (phase.follows.value_or(0) >= std::max(phases_.size(), std::size_t{1})) {
    throw Error("phase {} follows phase {}, but must follow one of the {} phases before it", phase.name, *phase.follows,
                phases_.size());
  }
  const std::vector<std::string> coordinates = phase.problem->configuration_names();
  if (std::ranges::count(coordinates, "phase") > 0) {
    throw Error("phase {} has a coordinate named phase, like the column of the phases; rename the coordinate",
                phase.name);
  }
  const Part before = parts_.empty() ? Part{} : parts_.back();
  const Problem& problem = *phase.problem;
  const ProblemBounds bounds = problem_bounds(problem);
  const bool is_free = bounds.horizon.is_free();
  using Index = Eigen::Index;
  const auto slice = [](Index first, Index size) { return Slice{first, size}; };
  const Slice path = slice(before.bounded_velocities.end(), path_constraint_count(problem));
  parts_.push_back({.q = slice(before.q.end(), problem.configuration_size()),
                    .u = slice(before.u.end(), problem.control_size()),
                    .y = slice(before.y.end(), problem.first_order_size()),
                    .path = path,
                    .bounded_velocities = slice(path.end(), is_free ? std::ssize(bounds.bounded_velocities()) : 0),
                    .is_free = is_free});
  phases_.push_back(std::move(phase));
}

ExpressionVector PhasedProblem::link(std::size_t /*i*/, const PhaseEnd& before, const PhaseEnd& after) const {
  return continuous(before, after);
}

ExpressionVector PhasedProblem::conditions(const std::vector<PhaseEnd>& /*first*/,
                                           const std::vector<PhaseEnd>& /*last*/) const {
  return {};
}

std::string PhasedProblem::name_of_duration(std::size_t i) const { return dmocbench::name_of_duration(phases_[i]); }

Expression PhasedProblem::duration(std::size_t i) const {
  if (parts_[i].is_free) return varying(name_of_duration(i));
  return {in_phase(i, [](const Problem& phase) { return phase.horizon(); })};
}

Expression PhasedProblem::start_time(std::size_t i) const {
  return i == 0 ? Expression(0.0) : start_time(preceding(i)) + duration(preceding(i));
}

double PhasedProblem::horizon() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    sum += in_phase(i, [](const Problem& phase) { return phase.horizon(); });
  }
  return sum / static_cast<double>(phases_.size());
}

Expression PhasedProblem::share(std::size_t i) const { return duration(i) / horizon(); }

double PhasedProblem::guessed_share(std::size_t i) const {
  return in_phase(i, [](const Problem& phase) { return phase.horizon(); }) / horizon();
}

State PhasedProblem::in_own_velocities(std::size_t i, const State& x) const {
  const Part& part = parts_[i];
  const Expression s = share(i);
  return {part.q.of(x.q), part.q.of(x.v) / s, s * x.t, part.y.of(x.y)};
}

ControlledState PhasedProblem::in_own_velocities(std::size_t i, const ControlledState& x) const {
  const State own = in_own_velocities(i, x.state());
  return {own.q, own.v, parts_[i].u.of(x.u), own.t, own.y};
}

template <class Formula>
ExpressionVector PhasedProblem::of_all(const Formula& formula) const {
  std::vector<ExpressionVector> parts;
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    parts.push_back(in_phase(i, [&](const Problem& phase) -> ExpressionVector { return formula(i, phase); }));
  }
  return stacked(parts);
}

template <class Names>
std::vector<std::string> PhasedProblem::names_of(const Names& names) const {
  std::vector<std::string> all;
  for (const Phase& phase : phases_) {
    for (const std::string& name : names(*phase.problem)) all.push_back(phase.name + "_" + name);
  }
  return all;
}

std::vector<std::string> PhasedProblem::configuration_names() const {
  return names_of([](const Problem& phase) { return phase.configuration_names(); });
}

std::vector<std::string> PhasedProblem::control_names() const {
  return names_of([](const Problem& phase) { return phase.control_names(); });
}

std::vector<std::string> PhasedProblem::first_order_names() const {
  return names_of([](const Problem& phase) { return phase.first_order_names(); });
}

ExpressionVector PhasedProblem::first_order_rates(const ControlledState& x) const {
  return of_all([&](std::size_t i, const Problem& phase) -> ExpressionVector {
    return share(i) * phase.first_order_rates(in_own_velocities(i, x));
  });
}

Expression PhasedProblem::lagrangian(const State& x) const {
  return of_all([&](std::size_t i, const Problem& phase) -> ExpressionVector {
           return ExpressionVector::Constant(1, share(i) * phase.lagrangian(in_own_velocities(i, x)));
         })
      .sum();
}

ExpressionVector PhasedProblem::force(const ControlledState& x) const {
  return of_all([&](std::size_t i, const Problem& phase) -> ExpressionVector {
    const ExpressionVector force = phase.force(in_own_velocities(i, x));
    if (force.size() == parts_[i].q.size) return share(i) * force;
    throw Error("force of phase {} has {}, expected {}", phases_[i].name, counted(force.size(), "entry", "entries"),
                parts_[i].q.size);
  });
}

Expression PhasedProblem::running_cost(const ControlledState& x) const {
  return of_all([&](std::size_t i, const Problem& phase) -> ExpressionVector {
           return ExpressionVector::Constant(1, share(i) * phase.running_cost(in_own_velocities(i, x)));
         })
      .sum();
}

ExpressionVector PhasedProblem::integrands(const ControlledState& x) const {
  return of_all([&](std::size_t i, const Problem& phase) -> ExpressionVector {
    return share(i) * phase.integrands(in_own_velocities(i, x));
  });
}

ExpressionVector PhasedProblem::constraints(const ExpressionVector& q) const {
  return of_all(
      [&](std::size_t i, const Problem& phase) -> ExpressionVector { return phase.constraints(parts_[i].q.of(q)); });
}

ExpressionVector PhasedProblem::velocity_constraints(const ExpressionVector& q, const ExpressionVector& v) const {
  return of_all([&](std::size_t i, const Problem& phase) -> ExpressionVector {
    return phase.velocity_constraints(parts_[i].q.of(q), parts_[i].q.of(v));
  });
}

ExpressionVector PhasedProblem::path_constraints(const ControlledState& x) const {
  return of_all([&](std::size_t i, const Problem& phase) -> ExpressionVector {
    const ControlledState own = in_own_velocities(i, x);
    std::vector<ExpressionVector> parts{phase.path_constraints(own)};
    if (parts_[i].is_free) {
      for (const Eigen::Index j : phase_bounds(i).bounded_velocities()) parts.emplace_back(own.v.segment(j, 1));
    }
    return stacked(parts);
  });
}

std::optional<ExpressionVector> PhasedProblem::symmetry(const ExpressionVector& q) const {
  bool has_any = false;
  const ExpressionVector generator = of_all([&](std::size_t i, const Problem& phase) -> ExpressionVector {
    const auto own = phase.symmetry(parts_[i].q.of(q));
    has_any = has_any || own;
    return own.value_or(ExpressionVector::Constant(parts_[i].q.size, Expression(0.0)));
  });
  if (!has_any) return std::nullopt;
  return generator;
}

Expression PhasedProblem::final_cost(const State& last) const {
  return of_all([&](std::size_t i, const Problem& phase) -> ExpressionVector {
           State own = in_own_velocities(i, last);
           own.t = duration(i);
           return ExpressionVector::Constant(1, phase.final_cost(own));
         })
      .sum();
}

PhaseEnd PhasedProblem::end_of(std::size_t i, const State& own) const {
  const VectorFormula lagrangian = [&](const ExpressionVector& v) {
    return ExpressionVector::Constant(1, in_phase(i, [&](const Problem& phase) {
                                        return phase.lagrangian({own.q, v, own.t, own.y});
                                      }));
  };
  PhaseEnd end;
  static_cast<State&>(end) = own;
  end.t = start_time(i) + own.t;
  end.p = ExpressionVector(jacobian_at(lagrangian, own.v).transpose());
  if (has_no_configuration(*phases_[i].problem)) end.q = end.v = end.p = ExpressionVector();
  return end;
}

ExpressionVector PhasedProblem::end_velocities(std::size_t i, const State& own, bool is_last) const {
  const ProblemBounds bounds = phase_bounds(i);
  const Bounds& v = is_last ? bounds.last.v : bounds.first.v;
  const std::vector<std::string> names = phases_[i].problem->configuration_names();
  std::vector<Expression> rows;
  for (Eigen::Index j = 0; j < parts_[i].q.size; ++j) {
    if (!parts_[i].is_free || is_kept_by_scaling(v, j)) continue;
    const auto bounded = [&] {
      return varying(name_of_end_velocity(phases_[i].name, names[static_cast<std::size_t>(j)], is_last));
    };
    rows.push_back(own.v[j] - (v.is_fixed(j) ? Expression(v.lower[j]) : bounded()));
  }
  return Eigen::Map<const ExpressionVector>(rows.data(), std::ssize(rows));
}

ExpressionVector PhasedProblem::link_of(std::size_t i, const State& before, const State& after) const {
  return link(i, end_of(preceding(i + 1), before), end_of(i + 1, after));
}

ExpressionVector PhasedProblem::checked_link(std::size_t i, const PhaseEnd& before, const PhaseEnd& after) const {
  const ExpressionVector entries = call_formula(*this, "link", [&] { return link(i, before, after); });
  const std::size_t next = i + 1;
  const Eigen::Index open = open_entries(phase_bounds(next).first);
  const Eigen::Index held = in_phase(next, held_numbers);
  const auto unknown_count = static_cast<Eigen::Index>(unknowns().size());
  const Eigen::Index most = open + open_entries(phase_bounds(preceding(next)).last) + unknown_count;
  const std::string subject = name_of_link(i) + " has " + counted(entries.size(), "entry", "entries");
  if (entries.size() < open - held) {
    throw Error("{}, but {} not given at the start of {}; state an entry for each number", subject,
                counted(open - held, "number is", "numbers are"), phases_[next].name);
  }
  if (entries.size() > most) {
    throw Error(
        "{}, but only {} not given at its two ends; leave the entries that the switch determines open in both phases",
        subject, counted(most, "number is", "numbers are"));
  }
  return entries;
}

std::vector<PhasedProblem::NamedConditions> PhasedProblem::named_conditions(const State& first,
                                                                            const State& last) const {
  std::vector<PhaseEnd> starts;
  std::vector<PhaseEnd> ends;
  std::vector<NamedConditions> all;
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    const State start = in_own_velocities(i, first);
    State end = in_own_velocities(i, last);
    end.t = duration(i);
    const std::string& name = phases_[i].name;
    all.push_back({"boundary_conditions of " + name,
                   in_phase(i, [&](const Problem& phase) { return phase.boundary_conditions(start, end); })});
    all.push_back({"the velocity at the start of " + name, end_velocities(i, start, false)});
    all.push_back({"the velocity at the end of " + name, end_velocities(i, end, true)});
    starts.push_back(end_of(i, start));
    ends.push_back(end_of(i, end));
  }
  for (std::size_t i = 0; i + 1 < phases_.size(); ++i) {
    all.push_back({name_of_link(i), checked_link(i, ends[preceding(i + 1)], starts[i + 1])});
  }
  all.push_back({"conditions", call_formula(*this, "conditions", [&] { return conditions(starts, ends); })});
  return all;
}

ExpressionVector PhasedProblem::boundary_conditions(const State& first, const State& last) const {
  std::vector<ExpressionVector> rows;
  for (const NamedConditions& some : named_conditions(first, last)) rows.push_back(some.entries);
  return stacked(rows);
}

std::string PhasedProblem::condition_in_words(std::size_t i) const {
  const State any = point_of_inputs(*this).state();
  auto entry = static_cast<Eigen::Index>(i);
  for (const NamedConditions& some : named_conditions(any, any)) {
    if (entry < some.entries.size()) return fmt::format("{}, entry [{}]", some.name, entry);
    entry -= some.entries.size();
  }
  throw Error("{} has no boundary condition {}", name(), i);
}

std::string PhasedProblem::name_of_link(std::size_t i) const {
  return fmt::format("the link from {} to {}", phases_[preceding(i + 1)].name, phases_[i + 1].name);
}

std::string time_in_words(const Problem& problem, double from, std::optional<double> to) {
  const bool is_phased = problem.phased() != nullptr;
  const double unit = is_phased ? 1.0 / problem.horizon() : problem.card().time_unit.factor;
  const std::string until = to ? fmt::format(" to {:.4g}", unit * *to) : "";
  return is_phased ? fmt::format("{:.4g}{} of each phase", unit * from, until)
                   : fmt::format("t = {:.4g}{}", unit * from, until);
}

BoundaryState PhasedProblem::ends(BoundaryState (Problem::*end)() const) const {
  BoundaryState all;
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    const BoundaryState own = in_phase(i, [&](const Problem& phase) { return (phase.*end)(); });
    all = {.q = joined(all.q, own.q), .v = joined(all.v, guessed_share(i) * own.v), .y = joined(all.y, own.y)};
  }
  return all;
}

MotionPoint PhasedProblem::guess(double t) const {
  MotionPoint all;
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    const double s = guessed_share(i);
    const MotionPoint own = in_phase(i, [&](const Problem& phase) { return phase.guess(s * t); });
    all = {
        .q = joined(all.q, own.q), .v = joined(all.v, s * own.v), .u = joined(all.u, own.u), .y = joined(all.y, own.y)};
  }
  return all;
}

ProblemBounds PhasedProblem::phase_bounds(std::size_t i) const { return in_phase(i, problem_bounds); }

void PhasedProblem::require_stated_range(std::size_t i, const HorizonBounds& now) const {
  const Parameter& stated = parameters()[parameter_number(*this, name_of_duration(i))];
  if (stated.lower == now.lower && stated.upper == now.upper) return;
  throw Error(
      "phase {}: the range of its duration was {:g} to {:g}, but is {:g} to {:g} with these parameters; "
      "the range must not depend on parameters",
      phases_[i].name, stated.lower, stated.upper, now.lower, now.upper);
}

ProblemBounds PhasedProblem::bounds() const {
  ProblemBounds all;
  all.horizon = {.lower = horizon(), .upper = horizon()};
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    const ProblemBounds own = phase_bounds(i);
    if (parts_[i].is_free) require_stated_range(i, own.horizon);
    const auto in_shared_time = [&](const Bounds& v) {
      return parts_[i].is_free ? kept_by_scaling(v) : scaled(v, guessed_share(i));
    };
    const auto append_end = [&](EndBounds& end, const EndBounds& of_phase) {
      append(end.q, of_phase.q);
      append(end.v, in_shared_time(of_phase.v));
      append(end.y, of_phase.y);
    };
    append_end(all.first, own.first);
    append_end(all.last, own.last);
    append(all.q, own.q);
    append(all.u, own.u);
    append(all.y, own.y);
    append(all.integrals, own.integrals);
    append(all.v, parts_[i].is_free ? Bounds::none(parts_[i].q.size) : in_shared_time(own.v));
    append(all.path, own.of_path(parts_[i].path.size));
    for (const Eigen::Index j : parts_[i].is_free ? own.bounded_velocities() : std::vector<Eigen::Index>()) {
      append(all.path, {.lower = own.v.lower.segment(j, 1), .upper = own.v.upper.segment(j, 1)});
    }
    for (const InteriorBounds& at : own.interior) add_interior(all, i, at);
  }
  return all;
}

void PhasedProblem::add_interior(ProblemBounds& all, std::size_t i, const InteriorBounds& at) const {
  const Part& part = parts_[i];
  auto place = std::ranges::find(all.interior, at.relative_time, &InteriorBounds::relative_time);
  if (place == all.interior.end()) {
    all.interior.push_back({.relative_time = at.relative_time,
                            .q = Bounds::none(configuration_size()),
                            .v = Bounds::none(configuration_size()),
                            .y = Bounds::none(first_order_size())});
    place = all.interior.end() - 1;
  }
  put(place->q, part.q.first, at.q);
  put(place->y, part.y.first, at.y);
  for (Eigen::Index j = 0; part.is_free && j < part.q.size; ++j) {
    if (is_kept_by_scaling(at.v, j)) continue;
    throw Error(
        "phase {} has a free duration, so bounds on a velocity between its ends must be 0; split the phase there",
        phases_[i].name);
  }
  put(place->v, part.q.first, part.is_free ? at.v : scaled(at.v, guessed_share(i)));
}

ProblemCard PhasedProblem::card() const {
  ProblemCard all;
  const std::vector<std::string> names = [&] {
    std::vector<std::string> result;
    for (const Phase& phase : phases_) result.push_back(phase.name);
    return result;
  }();
  all.description = fmt::format("the phases {}", fmt::join(names, ", "));
  all.guess = "the guesses of all phases";
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    const ProblemCard own = in_phase(i, [](const Problem& phase) { return phase.card(); });
    if (i == 0) all.time_unit = own.time_unit;
    const auto append_units = [](std::vector<std::string>& to, std::vector<std::string> more, Eigen::Index size) {
      more.resize(static_cast<std::size_t>(size));
      to.insert(to.end(), more.begin(), more.end());
    };
    append_units(all.configuration_units, own.configuration_units, parts_[i].q.size);
    append_units(all.control_units, own.control_units, parts_[i].u.size);
    const auto count = static_cast<std::size_t>(parts_[i].path.size);
    for (std::size_t j = 0; j < count; ++j) {
      const bool is_named = j < own.path_constraint_names.size();
      all.path_constraint_names.push_back(
          fmt::format("{} of {}", is_named ? own.path_constraint_names[j] : fmt::format("constraint {}", j), names[i]));
    }
    for (const Eigen::Index j :
         parts_[i].is_free ? phase_bounds(i).bounded_velocities() : std::vector<Eigen::Index>()) {
      all.path_constraint_names.push_back(fmt::format(
          "velocity of {} in {}", phases_[i].problem->configuration_names()[static_cast<std::size_t>(j)], names[i]));
    }
  }
  const auto is_empty = [](const std::string& unit) { return unit.empty(); };
  for (std::vector<std::string>* units : {&all.configuration_units, &all.control_units}) {
    if (std::ranges::all_of(*units, is_empty)) units->clear();
  }
  all.picture = [this](const ControlledState& x) {
    Picture picture;
    for (std::size_t i = 0; i < phases_.size(); ++i) {
      for (PictureQuantity quantity :
           in_phase(i, [&](const Problem& phase) { return pictured_quantities(phase, in_own_velocities(i, x)); })) {
        quantity.name = phases_[i].name + "_" + quantity.name;
        picture.push_back(std::move(quantity));
      }
    }
    return picture;
  };
  return all;
}

}  // namespace dmocbench
