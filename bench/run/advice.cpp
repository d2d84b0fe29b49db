#include "bench/run/advice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/judgement/confirm.hpp"
#include "methods/mechanics/member_name.hpp"
#include "methods/mechanics/phased_problem.hpp"
#include "methods/mechanics/point_function.hpp"

namespace dmocbench {

namespace {

/// Whether L depends on q_i through functions of period 2π, as on an angle in radians.
bool has_period_of_angle(const Problem& problem, Eigen::Index i) {
  PointFunction lagrangian(
      problem.configuration_size(), problem.control_size(),
      [&](const ControlledState& x) { return ExpressionVector{{problem.lagrangian(x.state())}}; },
      problem.first_order_size());
  MotionPoint point = problem.guess(0.4 * problem.horizon());
  const auto value_after = [&](double turn) {
    MotionPoint turned = point;
    turned.q[i] += turn;
    Eigen::VectorXd value(1);
    lagrangian.evaluate(turned, 0.4 * problem.horizon(), value);
    return value[0];
  };
  constexpr double rounding = 1e-9;
  const double value = value_after(0.0);
  const double size = rounding * (1.0 + std::abs(value));
  return std::abs(value_after(2.0 * std::numbers::pi) - value) < size && std::abs(value_after(1.0) - value) > size;
}

/// A coordinate that is likely an angle in degrees: it turns by more than a full turn, and by a multiple of 15.
/// `is_angle(i, unit)`: whether q_i, with a unit that may be empty, can be an angle.
template <class IsAngle>
std::optional<Advice> angle_in_degrees(const Problem& problem, const IsAngle& is_angle) {
  constexpr double full_turn = 6.3;
  constexpr double step = 15.0;
  const Eigen::VectorXd turned = problem.final_state().q - problem.initial_state().q;
  const std::vector<std::string> names = problem.configuration_names();
  const std::vector<std::string> units = problem.card().configuration_units;
  for (Eigen::Index i = 0; i < turned.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool turns_by_degrees = std::abs(turned[i]) > full_turn && std::fmod(turned[i], step) == 0.0;
    if (turns_by_degrees && is_angle(i, units.empty() ? "" : units[k])) {
      return Advice{.remedy = Remedy::radians, .coordinate = names[k], .size = turned[i]};
    }
  }
  return std::nullopt;
}

/// Coordinates whose sizes along the guess differ by four orders of magnitude.
std::optional<Advice> units_apart(const Problem& problem) {
  constexpr double far = 1e4;
  constexpr int samples = 16;
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(problem.configuration_size());
  for (int i = 0; i <= samples; ++i) {
    sizes = sizes.cwiseMax(problem.guess(problem.horizon() * i / samples).q.cwiseAbs());
  }
  Eigen::Index largest = 0;
  if (!(sizes.maxCoeff(&largest) > 0.0)) return std::nullopt;
  Eigen::Index smallest = 0;
  const double least = (sizes.array() > 0.0).select(sizes, sizes.maxCoeff()).minCoeff(&smallest);
  if (sizes[largest] < far * least) return std::nullopt;
  const std::vector<std::string> names = problem.configuration_names();
  return Advice{.remedy = Remedy::other_units,
                .coordinate = names[static_cast<std::size_t>(largest)],
                .size = sizes[largest],
                .smallest = names[static_cast<std::size_t>(smallest)],
                .smallest_size = least};
}

/// Whether the problem states how long the motion takes, in every phase.
bool has_given_duration(const Problem& problem) {
  const PhasedProblem* const phased = problem.phased();
  return !problem.bounds().horizon.is_free() &&
         (!phased || std::ranges::none_of(phased->parts(), &PhasedProblem::Part::is_free));
}

/// Whether a formula of the problem is not a number where the solve went.
bool has_undefined_formula(const Solution& solution) {
  return solution.status == Status::evaluation_failed || solution.formula_undefined;
}

}  // namespace

Advice doubt_about_units(const Problem& problem) {
  const auto is_angle = [&](Eigen::Index i, const std::string& unit) {
    return unit == "rad" || ((unit.empty() || unit == "deg") && has_period_of_angle(problem, i));
  };
  return angle_in_degrees(problem, is_angle).value_or(Advice());
}

Advice doubt_about_replay(const SolvedCase& solved, const std::optional<ReplayError>& replay) {
  constexpr double most = 0.1;
  constexpr double most_amplified = 10.0;
  if (!is_solved(solved.solution.status) || !solved.trajectory || !solved.accuracy || !replay) return {};
  const Eigen::MatrixXd& q = solved.trajectory->q;
  const Eigen::VectorXd ranges = (q.colwise().maxCoeff() - q.colwise().minCoeff()).transpose();
  Advice worst{.size = most};
  for (Eigen::Index i = 0; i < replay->q.size(); ++i) {
    const double share = std::abs(replay->q[i]) / ranges[i];
    if (!(share > worst.size) || ranges[i] <= smallest_range * std::max(1.0, q.col(i).cwiseAbs().maxCoeff())) continue;
    worst.coordinate = solved.the_case.problem->configuration_names()[static_cast<std::size_t>(i)];
    worst.size = share;
  }
  if (worst.coordinate.empty()) return {};
  const double jumps = static_cast<double>(q.rows() - 1) * solved.accuracy->relative_jump;
  worst.remedy = worst.size > most_amplified * jumps ? Remedy::feedback : Remedy::finer_grid;
  return worst;
}

std::string replay_in_words(const Problem& problem, const ReplayError& replay) {
  const ProblemCard card = problem.card();
  const std::vector<std::string>& units = card.configuration_units;
  if (units.empty()) return fmt::format("{:.1e}", replay.norm());
  std::vector<std::pair<std::string, double>> by_unit;
  const auto add = [&](const std::string& unit, double error) {
    const auto found = std::ranges::find(by_unit, unit, &std::pair<std::string, double>::first);
    auto& entry = found == by_unit.end() ? by_unit.emplace_back(unit, 0.0) : *found;
    entry.second = std::max(entry.second, std::abs(error));
  };
  const std::string per_time = card.time_unit.name.empty() ? "" : "/" + card.time_unit.name;
  for (Eigen::Index i = 0; i < replay.q.size(); ++i) add(units[static_cast<std::size_t>(i)], replay.q[i]);
  // Velocities per unit of time as shown.
  for (Eigen::Index i = 0; i < replay.v.size(); ++i)
    add(units[static_cast<std::size_t>(i)] + per_time, replay.v[i] / card.time_unit.factor);
  std::vector<std::string> words;
  for (const auto& [unit, error] : by_unit)
    words.push_back(fmt::format("{:.1e}{}{}", error, unit.empty() ? "" : " ", unit));
  return fmt::format("{}", fmt::join(words, ", "));
}

Advice next_to_try(const SolvedCase& solved, const std::string& start) {
  const Status status = solved.solution.status;
  const Case& the_case = solved.the_case;
  const Problem& problem = *the_case.problem;
  if (is_solved(status) || is_no_motion(status) || status == Status::interrupted) return {};
  if (status == Status::out_of_memory || status == Status::solver_error) return {};  // the message has the advice
  // A settled answer solves its program; what is not confirmed lies elsewhere, and the message states it.
  if (status == Status::not_confirmed && solved.solution.correction.value_or(unbounded) <= settled) return {};
  if (status == Status::time_limit) return {.remedy = Remedy::more_time};
  if (has_undefined_formula(solved.solution)) return {.remedy = Remedy::finite_formula};
  const auto may_be_angle = [](Eigen::Index /*i*/, const std::string& unit) {
    return unit.empty() || unit == "rad" || unit == "deg";
  };
  if (auto degrees = angle_in_degrees(problem, may_be_angle)) return *degrees;
  if (auto units = units_apart(problem)) return *units;
  if (status == Status::infeasible && has_given_duration(problem)) {
    return {.remedy = problem.phased() ? Remedy::longer_phases : Remedy::longer_horizon, .size = problem.horizon()};
  }
  if (status == Status::too_large || status == Status::invalid_program || the_case.solver == "nlopt")
    return {.remedy = Remedy::solver_auto};
  if (the_case.solver != "auto") return {.remedy = Remedy::several_solvers};
  if (start == "guess") return {.remedy = Remedy::common_start};
  return {.remedy = Remedy::another_guess};
}

std::string in_words(const Advice& advice) {
  switch (advice.remedy) {
    case Remedy::none:
      return "";
    case Remedy::more_time:
      return "Try more time (--seconds) or fewer intervals.";
    case Remedy::finite_formula:
      return fmt::format(
          "Try bounds that keep the coordinates away from the singularity of the formula ({}), and a guess within "
          "them.",
          member_name("Problem::bounds"));
    case Remedy::radians:
      return fmt::format("Try radians: {} changes by {:g}, which looks like an angle in degrees.", advice.coordinate,
                         advice.size);
    case Remedy::other_units:
      return fmt::format("Try other units: {} is about {:.1g}, {} about {:.1g}; solvers work best with sizes near 1.",
                         advice.coordinate, advice.size, advice.smallest, advice.smallest_size);
    case Remedy::longer_horizon:
      return fmt::format("Try a longer horizon than T = {:g}, or wider bounds: the ends may be out of reach.",
                         advice.size);
    case Remedy::longer_phases:
      return "Try longer phases, or wider bounds: the ends may be out of reach.";
    case Remedy::solver_auto:
      return "Try --solver auto.";
    case Remedy::several_solvers:
      return "Try --solver auto, which uses interior_point, then ipopt, then a start from a feasible trajectory.";
    case Remedy::common_start:
      return "Try --start common, which first searches for a trajectory with other methods.";
    case Remedy::another_guess:
      return fmt::format("Try another guess ({}), or --start FILE with a trajectory near the solution you expect.",
                         member_name("Problem::guess"));
    case Remedy::finer_grid:
      return fmt::format(
          "Try --accuracy 1e-4, or more intervals: with these controls, {} misses its final value by {:.2g} of its "
          "range.",
          advice.coordinate, advice.size);
    case Remedy::feedback:
      return fmt::format(
          "Try feedback to follow this trajectory. The system is unstable: with these controls alone, {} misses its "
          "final value by {:.2g} of its range.",
          advice.coordinate, advice.size);
  }
  return "";
}

std::string_view name_of(Remedy remedy) noexcept {
  constexpr std::array names{"none",           "more_time",     "finite_formula", "radians",         "other_units",
                             "longer_horizon", "longer_phases", "solver_auto",    "several_solvers", "common_start",
                             "another_guess",  "finer_grid",    "feedback"};
  return names[static_cast<std::size_t>(remedy)];
}

}  // namespace dmocbench
