#include "methods/transcription/describe_violation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/expression/schedule.hpp"
#include "methods/judgement/flat_rows.hpp"
#include "methods/judgement/linearised_conditions.hpp"
#include "methods/mechanics/formulas_along_motion.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/transcription/start.hpp"

namespace dmocbench {

namespace {

/// "q[1] (theta)".
std::string named(char symbol, Eigen::Index i, const std::vector<std::string>& names) {
  return fmt::format("{}[{}] ({})", symbol, i, names[static_cast<std::size_t>(i)]);
}

/// "path_constraints[1] (clearance)"; without the name where the problem gives none.
std::string entry_of(const char* function, std::size_t i, const std::vector<std::string>& names) {
  return fmt::format("{}[{}]{}", function, i, i < names.size() ? " (" + names[i] + ")" : "");
}

/// "boundary_conditions[1] (gate)"; of phases, what the condition states.
std::string condition_in_words(const Problem& problem, std::size_t i) {
  if (const PhasedProblem* const phased = problem.phased()) return phased->condition_in_words(i);
  return entry_of("boundary_conditions", i, problem.card().boundary_condition_names);
}

/// Words for the constraints and unknowns of a transcription at one point.
class ConstraintWords {
 public:
  ConstraintWords(const Problem& problem, const Transcription& transcription, const Eigen::VectorXd& x)
      : problem_(&problem),
        blocks_(&transcription.blocks()),
        bounds_(&transcription.bounds()),
        times_(transcription.node_times(x)) {}

  [[nodiscard]] std::string row(std::size_t row) const {
    const RowBlock& block = blocks_->block_of_row(row);
    const std::string component = component_of(block, row);
    const Place place = blocks_->structure().rows[row];
    if (block.kind == Equation::euler_lagrange && place.kind == Place::Kind::node) {
      // The momenta of both sides agree; at an end one of them is given.
      if (place.index == 0)
        return end_momentum("initial_state", "bounds().first", bounds_->first, block, row) + where(place);
      if (place.index == blocks_->intervals())
        return end_momentum("final_state", "bounds().last", bounds_->last, block, row) + where(place);
    }
    if (block.kind == Equation::boundary_condition)
      return condition_in_words(*problem_, static_cast<std::size_t>(number_in(block, row)));
    return fmt::format(fmt::runtime(member_name(block.words.sentence)), component) + where(place);
  }

  [[nodiscard]] std::string unknown(std::size_t unknown) const {
    const UnknownBlock& block = blocks_->block_of_unknown(unknown);
    const std::string component = component_of(block, unknown);
    const Place place = blocks_->structure().unknowns[unknown];
    if (block.kind == Quantity::integral && place.index == blocks_->intervals()) {
      return member_name("bounds().integrals") + "[" + component + "]";
    }
    const std::string sentence = fmt::format(fmt::runtime(member_name(block.words.sentence)), component);
    // A control that neighbours share is the first one of an interval.
    if (block.kind == Quantity::control) return sentence + in_interval(std::min(place.index, blocks_->intervals() - 1));
    return sentence + where(place);
  }

  /// "q[1] (theta)" of an unknown.
  [[nodiscard]] std::string component(std::size_t unknown) const {
    return component_of(blocks_->block_of_unknown(unknown), unknown);
  }

 private:
  template <class Kind>
  [[nodiscard]] static Eigen::Index number_in(const Block<Kind>& block, std::size_t member) {
    return block.component + static_cast<Eigen::Index>((member - block.head) / block.length);
  }
  template <class Kind>
  [[nodiscard]] std::string component_of(const Block<Kind>& block, std::size_t member) const {
    const Eigen::Index i = number_in(block, member);
    const auto number = static_cast<std::size_t>(i);
    switch (block.words.names) {
      case ComponentNames::configuration:
        return named('q', i, problem_->configuration_names());
      case ComponentNames::first_order:
        return named('y', i, problem_->first_order_names());
      case ComponentNames::control:
        return named('u', i, problem_->control_names());
      case ComponentNames::parameter:
        return problem_->parameters()[problem_->unknowns()[number]].name;
      case ComponentNames::path_constraint:
        return entry_of("", number, problem_->card().path_constraint_names);
      case ComponentNames::boundary_condition:
        return entry_of("", number, problem_->card().boundary_condition_names);
      case ComponentNames::number:
        break;
    }
    return std::to_string(i);
  }
  [[nodiscard]] std::string in_interval(std::size_t k) const {
    const auto left = static_cast<Eigen::Index>(k);
    return fmt::format(" in interval {} ({})", k, time_in_words(*problem_, times_[left], times_[left + 1]));
  }
  [[nodiscard]] std::string where(const Place& place) const {
    if (place.kind == Place::Kind::border) return "";
    if (place.kind == Place::Kind::interval) return in_interval(place.index);
    if (place.index == 0) return in_interval(0);
    if (place.index == blocks_->intervals()) return in_interval(place.index - 1);
    return fmt::format(" between intervals {} and {} ({})", place.index - 1, place.index,
                       time_in_words(*problem_, times_[static_cast<Eigen::Index>(place.index)]));
  }
  [[nodiscard]] std::string end_momentum(const char* state, const char* bounds, const EndBounds& end,
                                         const RowBlock& block, std::size_t row) const {
    return fmt::format("{}: the momentum (p = L_v at its velocity) of {}",
                       member_name(end.v.is_fixed(number_in(block, row)) ? state : bounds), component_of(block, row));
  }

  const Problem* problem_;
  const ProgramBlocks* blocks_;
  const ProblemBounds* bounds_;
  Eigen::VectorXd times_;
};

struct Worst {
  std::size_t entry = 0;
  double amount = 0.0;
};

/// The entry farthest outside its bounds, or the first that is not a number.
Worst farthest_outside(const Eigen::VectorXd& values, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  Worst worst;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const double amount = std::max(lower[i] - values[i], values[i] - upper[i]);
    if (std::isnan(values[i])) return {static_cast<std::size_t>(i), values[i]};
    if (amount > worst.amount) worst = {static_cast<std::size_t>(i), amount};
  }
  return worst;
}

std::string missed(const std::string& quantity, double amount) {
  if (std::isnan(amount)) return quantity + " is not a number.";
  return fmt::format("The largest violation is {:.3g}, in {}.", amount, quantity);
}

/// The controls that are at a bound in most stages.
std::string held_controls(const Problem& problem, const Transcription& transcription, const Eigen::VectorXd& x) {
  const ProgramBlocks& blocks = transcription.blocks();
  const auto intervals = static_cast<Eigen::Index>(blocks.intervals());
  const Eigen::Index stages = transcription.functions().controls.stages();
  std::string text;
  for (Eigen::Index i = 0; i < problem.control_size(); ++i) {
    Eigen::Index held = 0;
    for (Eigen::Index stage = 0; stage < stages; ++stage) {
      const Eigen::Index head = blocks.unknown(Quantity::control, stage).index(i);
      for (Eigen::Index k = head; k < head + intervals; ++k) {
        if (is_held(x[k], transcription.variable_lower()[k]) || is_held(x[k], transcription.variable_upper()[k]))
          ++held;
      }
    }
    if (2 * held <= stages * intervals) continue;
    text += fmt::format(" {} is active for {} at {} of {} stages.", member_name("bounds().u"),
                        named('u', i, problem.control_names()), held, stages * intervals);
  }
  return text;
}

/// Jᵀr, r the amounts by which rows leave their bounds: the gradient of ½|r|².
Eigen::VectorXd gradient_of_violation(Transcription& transcription, const Eigen::VectorXd& x,
                                      const Eigen::VectorXd& rows) {
  const Eigen::VectorXd excess =
      rows - rows.cwiseMax(transcription.constraint_lower()).cwiseMin(transcription.constraint_upper());
  Eigen::VectorXd jacobian(static_cast<Eigen::Index>(transcription.jacobian_structure().size()));
  transcription.jacobian(x, jacobian);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size());
  transcription.jacobian_structure().for_each(
      [&](Eigen::Index e, int row, int column) { gradient[column] += jacobian[e] * excess[row]; });
  return gradient;
}

/// The bound on q or y against which the violation presses most, if it presses hardly less against any other: without
/// that bound the rows would be met better.
std::string pressed_bound(const Problem& problem, Transcription& transcription, const Eigen::VectorXd& x,
                          const Eigen::VectorXd& rows) {
  constexpr double near = 1e-2;   // a descent within the bounds stops before them
  constexpr double share = 1e-2;  // of the hardest pressure
  const Eigen::VectorXd gradient = gradient_of_violation(transcription, x, rows);
  const ProgramBlocks& blocks = transcription.blocks();
  double hardest = 0.0;
  Worst pressed;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double lower = transcription.variable_lower()[i];
    const double upper = transcription.variable_upper()[i];
    const double bound = gradient[i] > 0.0 ? lower : upper;
    const double pressure = std::abs(gradient[i]);
    if (lower == upper || !std::isfinite(bound) || !(std::abs(x[i] - bound) <= near * std::max(1.0, std::abs(bound))))
      continue;
    hardest = std::max(hardest, pressure);
    const auto number = static_cast<std::size_t>(i);
    const Quantity kind = blocks.block_of_unknown(number).kind;
    const bool is_state = kind == Quantity::configuration || kind == Quantity::first_order;
    if (is_state && pressure > pressed.amount) pressed = {number, pressure};
  }
  if (pressed.amount == 0.0 || pressed.amount < share * hardest) return "";
  const auto i = static_cast<Eigen::Index>(pressed.entry);
  const bool is_lower = gradient[i] > 0.0;
  return fmt::format(" The {} bound {:g} of {} is active.", is_lower ? "lower" : "upper",
                     is_lower ? transcription.variable_lower()[i] : transcription.variable_upper()[i],
                     ConstraintWords(problem, transcription, x).unknown(pressed.entry));
}

/// The bound on a velocity that is missed most, where it is not the row that is missed most of all.
std::string missed_velocity(const Problem& problem, const Transcription& transcription, const Eigen::VectorXd& x,
                            const Eigen::VectorXd& rows, double most) {
  constexpr double share = 1e-3;
  Worst worst;
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const double lower = transcription.constraint_lower()[i];
    const double upper = transcription.constraint_upper()[i];
    const double amount = lower < upper ? std::max(lower - rows[i], rows[i] - upper) : 0.0;
    const auto row = static_cast<std::size_t>(i);
    if (!(amount > worst.amount && amount < most)) continue;
    if (transcription.blocks().block_of_row(row).kind == Equation::bounded_velocity) worst = {row, amount};
  }
  if (worst.amount < share * most) return "";
  return fmt::format(" Another violated constraint is {}.",
                     ConstraintWords(problem, transcription, x).row(worst.entry));
}

/// The largest derivatives of each boundary condition, and by which unknown it is.
std::vector<Worst> slopes_of_conditions(Transcription& transcription, const Eigen::VectorXd& x) {
  const RowBlock& conditions = transcription.blocks().row(Equation::boundary_condition);
  const Eigen::Index first = conditions.index();
  Eigen::VectorXd jacobian(static_cast<Eigen::Index>(transcription.jacobian_structure().size()));
  transcription.jacobian(x, jacobian);
  std::vector<Worst> slopes(static_cast<std::size_t>(conditions.width));
  transcription.jacobian_structure().for_each([&](Eigen::Index e, int row, int column) {
    if (row < first || is_fixed(transcription, column)) return;
    Worst& slope = slopes[static_cast<std::size_t>(row - first)];
    if (std::abs(jacobian[e]) >= slope.amount) slope = {static_cast<std::size_t>(column), std::abs(jacobian[e])};
  });
  return slopes;
}

/// The values of the boundary conditions.
Eigen::VectorXd values_of_conditions(Transcription& transcription, const Eigen::VectorXd& x) {
  const RowBlock& conditions = transcription.blocks().row(Equation::boundary_condition);
  Eigen::VectorXd rows(static_cast<Eigen::Index>(transcription.constraint_count()));
  transcription.constraints(x, rows);
  return rows.segment(conditions.index(), conditions.width);
}

/// Boundary conditions that nearly hold where the solve ended, and whose derivatives vanish there, next to those at the
/// guess.
std::string vanishing_conditions(const Problem& problem, Transcription& transcription, const Eigen::VectorXd& x) {
  constexpr double small = 1e-3;
  if (transcription.traced_problem().boundary_condition_count() == 0 || !x.allFinite()) return "";
  const std::vector<Worst> here = slopes_of_conditions(transcription, x);
  const Eigen::VectorXd guess = sample(transcription, guessed_motion(transcription));
  const std::vector<Worst> guessed = slopes_of_conditions(transcription, guess);
  const Eigen::VectorXd values = values_of_conditions(transcription, x);
  const Eigen::VectorXd guessed_values = values_of_conditions(transcription, guess);
  std::string text;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const bool holds = std::abs(values[row]) <= small * std::abs(guessed_values[row]);
    if (!holds || !(here[i].amount <= small * guessed[i].amount)) continue;
    const Place place = transcription.blocks().structure().unknowns[guessed[i].entry];
    const auto node = place.kind == Place::Kind::node ? static_cast<Eigen::Index>(place.index)
                                                      : static_cast<Eigen::Index>(transcription.blocks().intervals());
    text += fmt::format(
        " {} is rank deficient: its derivatives vanish at node {} ({}); state it with a formula whose derivatives do "
        "not vanish where it holds.",
        condition_in_words(problem, i), node, time_in_words(problem, transcription.node_times(x)[node]));
  }
  return text;
}

/// Constraints whose gradients depend on each other where the solve ended.
std::string dependent_constraints(const Problem& problem, Transcription& transcription, const Eigen::VectorXd& x) {
  constexpr std::size_t most_named = 3;
  if (!x.allFinite()) return "";
  const std::vector<std::size_t> rows = dependent_rows(transcription, x);
  if (rows.empty()) return "";
  const ConstraintWords words(problem, transcription, x);
  if (rows.size() == 1) return fmt::format(" The derivatives of {} vanish.", words.row(rows.front()));
  std::vector<std::string> named;
  for (std::size_t i = 0; i < std::min(most_named, rows.size()); ++i) named.push_back(words.row(rows[i]));
  if (rows.size() > most_named) named.push_back(fmt::format("{} more", rows.size() - most_named));
  const std::string last = named.back();
  named.pop_back();
  return fmt::format(
      " These constraints depend on each other, so one of them is implied or cannot be satisfied: {} and {}.",
      fmt::join(named, "; "), last);
}

/// A sentence if no unknown is left to choose: the equations alone determine the motion.
std::string no_freedom(const Transcription& transcription) {
  std::size_t unknowns = 0;
  std::size_t equations = 0;
  for (Eigen::Index i = 0; i < transcription.variable_lower().size(); ++i)
    unknowns += is_fixed(transcription, i) ? 0 : 1;
  for (Eigen::Index i = 0; i < transcription.constraint_lower().size(); ++i) {
    equations += transcription.constraint_lower()[i] == transcription.constraint_upper()[i] ? 1 : 0;
  }
  if (equations < unknowns) return "";
  return fmt::format(
      " The problem has no degree of freedom: {} for {}. It is a boundary value problem, whose solution depends on the "
      "guess but not on the cost.",
      counted(equations, "equation"), counted(unknowns, "unknown"));
}

std::string held_horizon(const Problem& problem, const Transcription& transcription, const Eigen::VectorXd& x) {
  if (!transcription.has_free_horizon()) return "";
  const HorizonBounds bounds = problem.bounds().horizon;
  const double horizon = transcription.horizon(x);
  if (is_held(horizon, bounds.lower)) return " " + member_name("bounds().horizon") + ": T is at its lower bound.";
  if (is_held(horizon, bounds.upper)) return " " + member_name("bounds().horizon") + ": T is at its upper bound.";
  return "";
}

/// Which of the inputs 0 .. read.size() - 1 some formulas read, added to `read`.
void add_inputs(const Schedule& formulas, std::vector<bool>& read) {
  for (const Schedule::Step& step : formulas.steps()) {
    if (step.operation == Operation::input && step.input_index < read.size()) read[step.input_index] = true;
  }
}

/// A sentence if there are controls, but none acts on q: neither do force and Lagrangian read one, nor the rate of a
/// first-order state that they read, directly or through others.
std::string idle_controls(const Problem& problem) {
  const Eigen::Index n = problem.configuration_size();
  const Eigen::Index m = problem.control_size();
  const Eigen::Index l = problem.first_order_size();
  if (m == 0) return "";
  InputCounter inputs;
  const ExpressionVector u = inputs.take(m);
  const ExpressionVector y = inputs.take(l);
  const ControlledState x{inputs.take(n), inputs.take(n), u, inputs.take(), y};
  const ExpressionVector rates = problem.first_order_rates(x);
  std::vector<bool> acts(static_cast<std::size_t>(m + l));
  add_inputs(Schedule(problem.force(x)), acts);
  add_inputs(Schedule(ExpressionVector{{problem.lagrangian({x.q, x.v, x.t, x.y})}}), acts);
  for (Eigen::Index round = 0; round < l; ++round) {
    for (Eigen::Index i = 0; i < l; ++i) {
      if (acts[static_cast<std::size_t>(m + i)]) add_inputs(Schedule(ExpressionVector{{rates[i]}}), acts);
    }
  }
  if (std::any_of(acts.begin(), acts.begin() + m, std::identity{})) return "";
  return fmt::format(" The force does not depend on any control{}, so no control can steer the system.",
                     l > 0 ? ", directly or through a first-order state" : "");
}

/// A sentence if the cost is so far below 0 that it may have no lower bound: scaled costs are of order 1.
std::string endless_descent(Transcription& transcription, const Eigen::VectorXd& x) {
  constexpr double far_below = -1e6;
  const double cost = transcription.objective(x);
  if (!(cost < far_below)) return "";
  return fmt::format(" The scaled cost is {:.2g}: running_cost or final_cost may have no lower bound.", cost);
}

/// True if an end is bounded by more than the bounds that hold for q all along.
bool states_more_than(const EndBounds& end, const Bounds& all_along) {
  if (end.v.any() || end.y.any() || all_along.empty()) return end.v.any() || end.y.any() || end.q.any();
  return end.q.lower != all_along.lower || end.q.upper != all_along.upper;
}

/// The functions of the problem that contradict each other.
std::string contradiction(const Transcription& transcription) {
  std::vector<std::string> parts;
  const EndBounds& last = transcription.bounds().last;
  if (states_more_than(last, transcription.bounds().q)) parts.push_back(member_name("final_state"));
  if (!transcription.bounds().interior.empty()) parts.push_back(member_name("bounds().interior"));
  if (transcription.traced_problem().boundary_condition_count() > 0) parts.emplace_back("boundary_conditions");
  if (transcription.traced_problem().path_constraint_count() > 0) parts.emplace_back("path_constraints");
  if (transcription.traced_problem().integral_count() > 0) parts.push_back(member_name("bounds().integrals"));
  if (transcription.traced_problem().holonomic_count() > 0) parts.emplace_back("constraints");
  if (transcription.traced_problem().velocity_constraint_count() > 0) parts.emplace_back("velocity_constraints");
  if (parts.empty()) return "";
  std::string text = " The solver found no trajectory near its last point that satisfies " + parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) text += (i + 1 < parts.size() ? ", " : " and ") + parts[i];
  return text + " within the bounds and the horizon.";
}

}  // namespace

std::string describe_constraint(const Problem& problem, const Transcription& transcription, const Eigen::VectorXd& x,
                                std::size_t row) {
  return ConstraintWords(problem, transcription, x).row(row);
}

std::string describe_unknown(const Problem& problem, const Transcription& transcription, const Eigen::VectorXd& x,
                             std::size_t unknown) {
  return ConstraintWords(problem, transcription, x).unknown(unknown);
}

std::string describe_flat_constraint(const Problem& problem, Transcription& transcription) {
  const Eigen::VectorXd guess = sample(transcription, guessed_motion(transcription));
  const std::vector<FlatRow> flat = flat_rows(transcription, guess);
  if (flat.empty()) return "";
  Eigen::VectorXd rows(static_cast<Eigen::Index>(transcription.constraint_count()));
  transcription.constraints(guess, rows);
  const auto violation = [&](const FlatRow& of) {
    const auto row = static_cast<Eigen::Index>(of.row);
    return std::max(transcription.constraint_lower()[row] - rows[row],
                    rows[row] - transcription.constraint_upper()[row]);
  };
  const FlatRow& worst = *std::ranges::max_element(flat, {}, violation);
  const ConstraintWords words(problem, transcription, guess);
  return fmt::format(
      "The guess violates {}. The derivative of this constraint with respect to {} vanishes at the guess and does not "
      "determine on which side to pass; guess a trajectory on one side.",
      words.row(worst.row), words.component(worst.unknown));
}

namespace {

/// Which formula cannot be evaluated at a point of a program, and where first: "a derivative of force[1] is not a
/// number in interval 3 (t = 0.41)". L, f, C, h and their derivatives up to an order are looked at in all stages.
/// Empty if all are numbers.
std::string undefined_stage(const Problem& problem, Transcription& transcription, const Eigen::VectorXd& x,
                            FormulaCheck::Derivatives up_to) {
  const Eigen::Index n = problem.configuration_size();
  const Eigen::Index m = problem.control_size();
  const Eigen::Index l = problem.first_order_size();
  const Eigen::Index width = 2 * n + 1 + m + 2 * l;
  const Eigen::MatrixXd stages = transcription.tabulate(transcription.functions().stages, x);
  FormulaCheck check(problem, up_to);
  for (Eigen::Index k = 0; k < stages.rows(); ++k) {
    for (Eigen::Index i = 0; i < transcription.tableau().stages(); ++i) {
      const auto stage = stages.row(k).segment(i * width, width);
      const MotionPoint point{.q = stage.head(n),
                              .v = stage.segment(n, n),
                              .u = stage.segment(2 * n + 1, m),
                              .y = stage.segment(2 * n + 1 + m, l)};
      const std::string quantity = check.undefined_at(point, stage[2 * n]);
      if (!quantity.empty())
        return fmt::format("{} is not a number in interval {} (t = {:g})", quantity, k, stage[2 * n]);
    }
  }
  return "";
}

/// A sentence on the formula that is not a number where a solve ended. No method evaluates L itself, so that a solver
/// may have wandered off where it is not defined, and failed there for another reason.
std::string undefined_formula(const Problem& problem, Transcription& transcription, const Solution& solution) {
  const bool has_failed_there = solution.status == Status::evaluation_failed;
  const bool has_wandered = solution.status == Status::step_failed || solution.status == Status::infeasible ||
                            solution.status == Status::iteration_limit || solution.status == Status::diverged;
  if (!solution.primal.allFinite() || (!has_failed_there && !has_wandered)) return "";
  const auto up_to = has_failed_there ? FormulaCheck::Derivatives::second : FormulaCheck::Derivatives::first;
  const std::string undefined = undefined_stage(problem, transcription, solution.primal, up_to);
  return undefined.empty() ? "" : "At the last point, " + undefined + ".";
}

}  // namespace

Failure failure_of(const Problem& problem, Transcription& transcription, const Solution& solution, double tolerance) {
  const Eigen::VectorXd& x = solution.primal;
  if (is_solved(solution.status) || static_cast<std::size_t>(x.size()) != transcription.variable_count()) return {};
  const bool has_failed_there = solution.status == Status::evaluation_failed;
  Failure failure{.words = undefined_formula(problem, transcription, solution)};
  std::string& text = failure.words;
  failure.formula_undefined = !text.empty();
  if (has_failed_there && failure.formula_undefined) return failure;
  const bool has_stuck = solution.status == Status::step_failed || solution.status == Status::iteration_limit ||
                         solution.status == Status::infeasible || solution.status == Status::not_confirmed;
  if (has_stuck) {
    const std::string vanishing = vanishing_conditions(problem, transcription, x);
    text += vanishing.empty() ? dependent_constraints(problem, transcription, x) : vanishing;
    const std::string flat = describe_flat_constraint(problem, transcription);
    text += no_freedom(transcription) + (flat.empty() ? "" : " " + flat);
  }
  if (text.starts_with(' ')) text.erase(0, 1);
  Eigen::VectorXd rows(static_cast<Eigen::Index>(transcription.constraint_count()));
  transcription.constraints(x, rows);
  const Worst row = farthest_outside(rows, transcription.constraint_lower(), transcription.constraint_upper());
  const Worst unknown = farthest_outside(x, transcription.variable_lower(), transcription.variable_upper());
  // Where a simulation stops, the row of the interval is more informative than the node after it.
  const bool has_stopped = !transcription.functions().has_stage_unknowns && std::isnan(row.amount);
  const bool is_unknown = !has_stopped && (std::isnan(unknown.amount) || unknown.amount > row.amount);
  const Worst worst = is_unknown ? unknown : row;
  if (worst.amount <= tolerance) return failure;
  text += (text.empty() ? "" : " ") + missed(is_unknown ? describe_unknown(problem, transcription, x, worst.entry)
                                                        : describe_constraint(problem, transcription, x, worst.entry),
                                             worst.amount);
  if (std::isnan(worst.amount)) {
    failure.formula_undefined = true;
    return failure;
  }
  text += held_controls(problem, transcription, x) + held_horizon(problem, transcription, x);
  text += idle_controls(problem) + endless_descent(transcription, x);
  if (solution.status == Status::infeasible) {
    text += pressed_bound(problem, transcription, x, rows);
    text += missed_velocity(problem, transcription, x, rows, worst.amount) + contradiction(transcription);
  }
  return failure;
}

std::string describe_violation(const Problem& problem, Transcription& transcription, const Solution& solution,
                               double tolerance) {
  return failure_of(problem, transcription, solution, tolerance).words;
}

}  // namespace dmocbench
