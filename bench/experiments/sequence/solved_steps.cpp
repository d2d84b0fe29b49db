#include "bench/experiments/sequence/solved_steps.hpp"

#include <algorithm>
#include <utility>

#include "bench/run/column.hpp"
#include "methods/numerics/quantile.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

Motion one_interval_later(const Trajectory& trajectory) {
  const Motion motion = smooth_motion(trajectory);
  const auto at = [motion, step = trajectory.step(0)](double t) {
    MotionPoint point = motion.at(t + step);
    const double beyond = t + step - motion.horizon;
    if (beyond > 0.0) point.q += beyond * point.v;
    return point;
  };
  return {at, motion.horizon, motion.unknowns};
}

Eigen::VectorXd shifted(const Places& places, const Eigen::VectorXd& values) {
  Eigen::VectorXd result = values;
  for (const PlaceRun& run : places.runs()) {
    if (run.kind == Place::Kind::border || run.count < 2) continue;
    const auto first = static_cast<Eigen::Index>(run.first);
    const auto moved = static_cast<Eigen::Index>(run.count) - 1;
    result.segment(first, moved) = values.segment(first + 1, moved);
  }
  return result;
}

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

}  // namespace

std::optional<bool> SequenceStep::is_warm_worse() const {
  if (!cold) return std::nullopt;
  if (!is_solved(*cold)) return false;
  return !is_solved(warm) || warm.iterations > cold->iterations;
}

SequenceRun::SequenceRun(const SolvedCase& solved, std::unique_ptr<Neighbours> neighbours, const SolverOptions& options,
                         int repeats)
    : case_(solved.the_case),
      neighbours_(std::move(neighbours)),
      repeats_(repeats),
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
  const std::optional<double> barrier_parameter = barrier_parameter_;
  const Eigen::VectorXd start = warm_start();
  Solution answer = solve_step(*prepared_, start, multipliers_, barrier_parameter, repeats_);
  SequenceStep step{.scheme = {case_.problem->name(), case_.method, case_.tableau, case_.stages},
                    .intervals = case_.intervals(),
                    .sequence = neighbours_->name(),
                    .number = step_,
                    .warm = told_of(answer),
                    .start_barrier_parameter = barrier_parameter};
  if (also_cold || !is_solved(step.warm)) {
    const Eigen::VectorXd guess = sample(*program_, guessed_motion(*problem));
    Solution cold = solve_step(*prepared_, guess, Eigen::VectorXd(), std::nullopt, repeats_);
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
  if (neighbours_->moves_on()) multipliers_ = shifted(program_->blocks().structure().rows, multipliers_);
  const Motion motion = neighbours_->moves_on() ? one_interval_later(trajectory_) : smooth_motion(trajectory_);
  return sample(*program_, moved_to_ends(motion, program_->bounds()));
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
          {"intervals", "", "number of intervals N", &SequenceStep::intervals, in_key},
          {"sequence", "", "kind of sequence: receding_horizon or homotopy", &SequenceStep::sequence, in_key},
          {"step", "", "number of the step, counted from 1", &SequenceStep::number, in_key},
          {"status", "", "status of the warm solve", from(&SequenceStep::warm, &StepSolve::status)},
          {"iterations", "", "iterations of the warm solve", from(&SequenceStep::warm, &StepSolve::iterations)},
          {"microseconds", "us", "time of the warm solve in the solver",
           from(&SequenceStep::warm, &StepSolve::microseconds)},
          {"start_barrier_parameter", "",
           "barrier parameter at the start of the warm solve; empty where the problem has no barrier",
           from(&SequenceStep::start_barrier_parameter)},
          {"cold_status", "", "status of a solve from the guess; empty without one", of_cold(&StepSolve::status)},
          {"cold_iterations", "", "its iterations", of_cold(&StepSolve::iterations)},
          {"cold_microseconds", "us", "its time", of_cold(&StepSolve::microseconds)},
          {"objective", "cost", "cost of the solution", from(&SequenceStep::objective)}};
  return table_of(columns, steps);
}

namespace {

/// The steps of a sequence.
struct SummarisedSteps {
  Scheme scheme;
  std::size_t intervals = 0;
  std::string sequence;
  std::vector<const SequenceStep*> steps;

  [[nodiscard]] std::ptrdiff_t solved() const {
    return std::ranges::count_if(steps, [](const SequenceStep* step) { return is_solved(step->warm); });
  }
  /// How many steps were solved from the guess too, and how many of these cost more than the answer from the guess.
  [[nodiscard]] std::ptrdiff_t compared() const {
    return std::ranges::count_if(steps, [](const SequenceStep* step) { return step->is_warm_worse().has_value(); });
  }
  [[nodiscard]] std::optional<double> share_of_worse() const {
    if (compared() == 0) return std::nullopt;
    const auto worse =
        std::ranges::count_if(steps, [](const SequenceStep* step) { return step->is_warm_worse().value_or(false); });
    return static_cast<double>(worse) / static_cast<double>(compared());
  }
};

/// median_NAME, p99_NAME and largest_NAME of the solved ones among the solves that `solve_of` finds in steps.
template <class Find, class Number>
Columns<SummarisedSteps> quantile_columns(const std::string& name, const std::string& unit, const std::string& meaning,
                                          Find solve_of, Number StepSolve::*number) {
  const auto at = [=](double share) {
    return [=](const SummarisedSteps& of) {
      std::vector<double> numbers;
      for (const SequenceStep* step : of.steps) {
        const StepSolve* solve = solve_of(*step);
        if (solve != nullptr && is_solved(*solve)) numbers.push_back(solve->*number);
      }
      std::ranges::sort(numbers);
      return quantile(numbers, share);
    };
  };
  return {{"median_" + name, unit, meaning, at(0.5)},
          {"p99_" + name, unit, meaning + ", 99th percentile", at(0.99)},
          {"largest_" + name, unit, meaning + ", the largest", at(1.0)}};
}

Columns<SummarisedSteps> summary_columns() {
  using Steps = SummarisedSteps;
  const auto warm = [](const SequenceStep& step) { return &step.warm; };
  const auto cold = [](const SequenceStep& step) { return step.cold ? &*step.cold : nullptr; };
  return scheme_columns<Steps>() +
         Columns<Steps>{{"intervals", "", "number of intervals N", &Steps::intervals, in_key},
                        {"sequence", "", "kind of sequence: receding_horizon or homotopy", &Steps::sequence, in_key},
                        {"steps", "", "number of steps", [](const Steps& of) { return of.steps.size(); }},
                        {"solved", "", "number of solved steps", &Steps::solved}} +
         quantile_columns("iterations", "", "iterations of a warm solve", warm, &StepSolve::iterations) +
         quantile_columns("microseconds", "us", "time of a warm solve", warm, &StepSolve::microseconds) +
         quantile_columns("cold_iterations", "", "iterations of a solve from the guess", cold, &StepSolve::iterations) +
         quantile_columns("cold_microseconds", "us", "time of a solve from the guess", cold, &StepSolve::microseconds) +
         Columns<Steps>{
             {"compared_with_cold", "", "number of steps that were also solved from the guess", &Steps::compared},
             {"warm_is_worse", "", "share of the compared steps whose warm cost exceeds the cold cost",
              &Steps::share_of_worse}};
}

}  // namespace

Table sequence_summary(const std::vector<SequenceStep>& steps) {
  std::vector<SummarisedSteps> all;
  for (const SequenceStep& step : steps) {
    auto of = std::ranges::find_if(all, [&](const SummarisedSteps& summary) {
      return summary.sequence == step.sequence && summary.scheme.problem == step.scheme.problem &&
             summary.scheme.method == step.scheme.method;
    });
    if (of == all.end()) of = all.insert(of, {step.scheme, step.intervals, step.sequence, {}});
    of->steps.push_back(&step);
  }
  return table_of(summary_columns(), all);
}

}  // namespace dmocbench
