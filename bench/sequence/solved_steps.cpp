#include "bench/sequence/solved_steps.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "bench/experiment/column.hpp"
#include "bench/sequence/one_interval_later.hpp"
#include "methods/numerics/quantile.hpp"
#include "methods/transcription/motions/moved_to_ends.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

bool is_solved(const StepSolve& solve) { return solve.status == name_of(Status::solved); }

/// The answer; its time is the smallest of several solves. Without multipliers the start is cold.
Solution solve_step(PreparedSolve& prepared, const Eigen::VectorXd& start, const Eigen::VectorXd& multipliers,
                    std::optional<double> barrier_parameter, int repeats) {
  Solution solution = prepared.solve(start, multipliers, barrier_parameter);
  for (int i = 1; i < repeats && dmocbench::is_solved(solution.status); ++i) {
    solution.seconds = std::min(solution.seconds, prepared.solve(start, multipliers, barrier_parameter).seconds);
  }
  return solution;
}

StepSolve told_of(const Solution& solution) {
  constexpr double micro = 1e6;
  return {.status = std::string(name_of(solution.status)),
          .iterations = solution.major_iterations.value_or(0),
          .microseconds = micro * solution.seconds};
}

void set_quantiles(Row& row, const std::string& what, std::vector<double> values) {
  if (values.empty()) return;
  std::ranges::sort(values);
  row.set("median_" + what, quantile(values, 0.5));
  row.set("p99_" + what, quantile(values, 0.99));
  row.set("largest_" + what, values.back());
}

/// A number of every solved step that has such a solve.
template <class Number>
std::vector<double> numbers_of(const std::vector<const SequenceStep*>& steps, Number number) {
  std::vector<double> numbers;
  for (const SequenceStep* step : steps) {
    if (const std::optional<double> value = number(*step)) numbers.push_back(*value);
  }
  return numbers;
}

Row summary_of(const std::vector<const SequenceStep*>& steps) {
  const SequenceStep& any = *steps.front();
  Row row;
  row.set("problem", any.scheme.problem);
  row.set("method", any.scheme.method);
  row.set("tableau", any.scheme.tableau);
  row.set("stages", any.scheme.stages);
  row.set("intervals", any.intervals);
  row.set("sequence", any.sequence);
  row.set("steps", steps.size());
  row.set("solved", std::ranges::count_if(steps, [](const SequenceStep* step) { return is_solved(step->warm); }));
  const auto of_warm = [&](auto member) {
    return numbers_of(steps, [member](const SequenceStep& step) -> std::optional<double> {
      return is_solved(step.warm) ? std::optional<double>(step.warm.*member) : std::nullopt;
    });
  };
  const auto of_cold = [&](auto member) {
    return numbers_of(steps, [member](const SequenceStep& step) -> std::optional<double> {
      return step.cold && is_solved(*step.cold) ? std::optional<double>((*step.cold).*member) : std::nullopt;
    });
  };
  set_quantiles(row, "iterations", of_warm(&StepSolve::iterations));
  set_quantiles(row, "microseconds", of_warm(&StepSolve::microseconds));
  set_quantiles(row, "cold_iterations", of_cold(&StepSolve::iterations));
  set_quantiles(row, "cold_microseconds", of_cold(&StepSolve::microseconds));
  const std::vector<double> worse = numbers_of(steps, [](const SequenceStep& step) -> std::optional<double> {
    const std::optional<bool> is_worse = step.is_warm_worse();
    return is_worse ? std::optional(*is_worse ? 1.0 : 0.0) : std::nullopt;
  });
  row.set("compared_with_cold", worse.size());
  if (!worse.empty()) {
    row.set("warm_is_worse", static_cast<double>(std::ranges::count(worse, 1.0)) / static_cast<double>(worse.size()));
  }
  return row;
}

}  // namespace

std::optional<bool> SequenceStep::is_warm_worse() const {
  if (!cold) return std::nullopt;
  if (!is_solved(*cold)) return false;
  return !is_solved(warm) || warm.iterations > cold->iterations;
}

SequenceRun::SequenceRun(const SolvedCase& solved, std::unique_ptr<Neighbours> neighbours, const SolverOptions& options,
                         const SequenceChoices& choices)
    : case_(solved.the_case),
      neighbours_(std::move(neighbours)),
      choices_(choices),
      program_(std::make_unique<Transcription>(*case_.problem, *make_element(case_.method),
                                               make_tableau(case_.tableau, case_.stages), case_.grid,
                                               OpenParameters{neighbours_->open_parameters()})),
      prepared_(std::make_unique<PreparedSolve>(*program_, "interior_point", options)),
      trajectory_(*solved.trajectory),  // NOLINT(bugprone-unchecked-optional-access): a solved case has one
      multipliers_(solved.solution.multipliers),
      barrier_parameter_(solved.solution.barrier_parameter) {}

SequenceStep SequenceRun::next(bool also_cold) {
  const std::shared_ptr<const Problem> problem = neighbours_->next(++step_, trajectory_);
  neighbours_->give_values(*program_);
  const std::optional<double> barrier_parameter = start_barrier_parameter();
  const Eigen::VectorXd start = warm_start();
  Solution answer = solve_step(*prepared_, start, multipliers_, barrier_parameter, choices_.repeats);
  SequenceStep step{.scheme = {case_.problem->name(), case_.method, case_.tableau, case_.stages},
                    .intervals = case_.intervals(),
                    .sequence = neighbours_->name(),
                    .number = step_,
                    .warm = told_of(answer),
                    .start_barrier_parameter = barrier_parameter};
  if (also_cold || !is_solved(step.warm)) {
    const Eigen::VectorXd guess = sample(*program_, guessed_motion(*problem));
    Solution cold = solve_step(*prepared_, guess, Eigen::VectorXd(), std::nullopt, choices_.repeats);
    step.cold = told_of(cold);
    if (!is_solved(step.warm)) answer = std::move(cold);
  }
  is_at_end_ = !dmocbench::is_solved(answer.status);
  if (is_at_end_) return step;
  go_on_from(answer);
  step.objective = trajectory_.cost;
  return step;
}

Eigen::VectorXd SequenceRun::warm_start() {
  if (neighbours_->moves_on()) multipliers_ = shifted(program_->layout().structure().rows, multipliers_);
  const Motion motion = neighbours_->moves_on() ? one_interval_later(trajectory_) : smooth_motion(trajectory_);
  return sample(*program_, moved_to_ends(motion, program_->bounds()));
}

std::optional<double> SequenceRun::start_barrier_parameter() const {
  const bool has_barrier = barrier_parameter_.has_value();
  return has_barrier && choices_.barrier_parameter ? choices_.barrier_parameter : barrier_parameter_;
}

void SequenceRun::go_on_from(const Solution& answer) {
  multipliers_ = answer.multipliers;
  barrier_parameter_ = answer.barrier_parameter;
  trajectory_ = read_trajectory(*program_, answer.primal, multipliers_);
}

Table step_table(const std::vector<SequenceStep>& steps) {
  const auto of_cold = [](auto member) {
    return
        [member](const SequenceStep& step) { return step.cold ? std::optional((*step.cold).*member) : std::nullopt; };
  };
  const Columns<SequenceStep> columns =
      scheme_columns<SequenceStep>() +
      Columns<SequenceStep>{
          {"intervals", "", "number of intervals N", &SequenceStep::intervals},
          {"sequence", "", "receding_horizon or homotopy", &SequenceStep::sequence},
          {"step", "", "number of the step, from 1", &SequenceStep::number},
          {"status", "", "of the warm solve", from(&SequenceStep::warm, &StepSolve::status)},
          {"iterations", "", "of the warm solve", from(&SequenceStep::warm, &StepSolve::iterations)},
          {"microseconds", "us", "of the warm solve, the solver alone",
           from(&SequenceStep::warm, &StepSolve::microseconds)},
          {"start_barrier_parameter", "", "that the warm solve began with; empty where the problem has no barrier",
           from(&SequenceStep::start_barrier_parameter)},
          {"cold_status", "", "of a solve from the guess; empty where none was asked for", of_cold(&StepSolve::status)},
          {"cold_iterations", "", "its iterations", of_cold(&StepSolve::iterations)},
          {"cold_microseconds", "us", "its time", of_cold(&StepSolve::microseconds)},
          {"objective", "cost", "of the answer", from(&SequenceStep::objective)}};
  return table_of(columns, steps);
}

namespace {

/// What the columns of the summary mean.
std::map<std::string, std::string> meanings_in_summary() {
  std::map<std::string, std::string> meanings = meanings_of(scheme_columns<SequenceStep>());
  meanings["intervals"] = "number of intervals N";
  meanings["sequence"] = "receding_horizon or homotopy";
  meanings["steps"] = "number of steps";
  meanings["solved"] = "how many of them were solved";
  meanings["compared_with_cold"] = "how many were solved from the guess too";
  meanings["warm_is_worse"] = "share of those that cost more than the answer from the guess";
  for (const auto& [what, meaning] : {std::pair{"iterations", "iterations of a warm solve"},
                                      {"microseconds", "[us] time of a warm solve"},
                                      {"cold_iterations", "iterations of a solve from the guess"},
                                      {"cold_microseconds", "[us] time of a solve from the guess"}}) {
    meanings[fmt::format("median_{}", what)] = meaning;
    meanings[fmt::format("p99_{}", what)] = fmt::format("{}, 99th percentile", meaning);
    meanings[fmt::format("largest_{}", what)] = fmt::format("{}, the largest", meaning);
  }
  return meanings;
}

}  // namespace

Table sequence_summary(const std::vector<SequenceStep>& steps) {
  std::map<std::tuple<std::string, std::string, std::string>, std::vector<const SequenceStep*>> groups;
  std::vector<std::tuple<std::string, std::string, std::string>> order;
  for (const SequenceStep& step : steps) {
    const auto key = std::tuple(step.scheme.problem, step.sequence, step.scheme.method);
    auto& group = groups[key];
    if (group.empty()) order.push_back(key);
    group.push_back(&step);
  }
  std::vector<std::string> names{"problem", "method", "tableau", "stages", "intervals", "sequence", "steps", "solved"};
  for (const char* what : {"iterations", "microseconds", "cold_iterations", "cold_microseconds"}) {
    for (const char* which : {"median_", "p99_", "largest_"}) names.push_back(std::string(which) + what);
  }
  names.insert(names.end(), {"compared_with_cold", "warm_is_worse"});
  Table table(names);
  table.explain(meanings_in_summary());
  table.declare(types_of(scheme_columns<SequenceStep>()));
  table.declare({{"sequence", {FieldKind::text, false}}});
  for (const char* const count : {"intervals", "steps", "solved", "compared_with_cold"})
    table.declare({{count, {FieldKind::integer, false}}});
  for (const std::string& name : names) table.declare({{name, {FieldKind::number, true}}});  // all others
  for (const auto& key : order) table.append(summary_of(groups.at(key)));
  return table;
}

}  // namespace dmocbench
