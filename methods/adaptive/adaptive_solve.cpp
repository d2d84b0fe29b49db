#include "methods/adaptive/adaptive_solve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "methods/adaptive/graded_grid.hpp"
#include "methods/choose.hpp"
#include "methods/diagnostics/violation_between_stages.hpp"
#include "methods/error.hpp"
#include "methods/judgement/polish.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/sample_multipliers.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

constexpr int most_stages = 3;

/// The share of the accuracy that the next grid is made for.
constexpr double margin = 0.9;

/// Every interval in equal parts.
Grid subdivided(const Grid& grid, Eigen::Index parts) {
  const Eigen::VectorXd coarse = grid.relative_times();
  Eigen::VectorXd fine(parts * (coarse.size() - 1) + 1);
  for (Eigen::Index i = 0; i < fine.size() - 1; ++i) {
    const Eigen::Index k = i / parts;
    const double share = static_cast<double>(i % parts) / static_cast<double>(parts);
    fine[i] = (1.0 - share) * coarse[k] + share * coarse[k + 1];
  }
  fine[fine.size() - 1] = coarse[coarse.size() - 1];
  return Grid::from_nodes(fine);
}

/// Adds the counts and times of an earlier solve to a solution.
void add_work(const Solution& earlier, Solution& solution) {
  const auto add = [&](auto count) {
    if (earlier.*count) solution.*count = *(earlier.*count) + (solution.*count).value_or(0);
  };
  add(&Solution::major_iterations);
  add(&Solution::minor_iterations);
  add(&Solution::phase_one_minor_iterations);
  add(&Solution::phase_two_minor_iterations);
  add(&Solution::linear_systems);
  add(&Solution::linear_seconds);
  solution.seconds += earlier.seconds;
  solution.evaluation_seconds += earlier.evaluation_seconds;
  if (!earlier.evaluations) return;
  if (!solution.evaluations) solution.evaluations.emplace();
  for (int EvaluationCounts::*count :
       {&EvaluationCounts::objective, &EvaluationCounts::gradient, &EvaluationCounts::constraints,
        &EvaluationCounts::jacobian, &EvaluationCounts::hessian}) {
    *solution.evaluations.*count += *earlier.evaluations.*count;
  }
}

/// Grid after grid.
class AdaptiveRun {
 public:
  AdaptiveRun(const AdaptiveTask& task, const AdaptiveOptions& options)
      : task_(task),
        options_(options),
        element_(make_element(task.method)),
        solver_options_(options.solver_options),
        grid_(task.first),
        stages_(task.stages) {
    solver_options_.tolerance = options.solver_tolerance(solver_options_.tolerance);
  }

  /// Where a limit of time or an interrupt ends it, the answer is the last one that was found.
  AdaptiveAnswer run(const std::function<void(const GridAttempt&)>& on_grid) {
    const StopScope scope(solver_options_.stop_requested, solver_options_.most_seconds);
    try {
      return refine(on_grid);
    } catch (const Stopped&) {
      return end_stopped();
    }
  }

 private:
  AdaptiveAnswer refine(const std::function<void(const GridAttempt&)>& on_grid) {
    for (int number = 0; number < options_.most_grids; ++number) {
      const bool is_solved_here = attempt();
      if (on_grid) on_grid(answer_.grids.back());
      if (!is_solved_here && narrowed_ > 0 && take_fewest_stages()) continue;
      if (!is_solved_here) return end(AdaptiveOutcome::not_solved, failure());
      if (!between_.is_motion()) {
        refine_where_violated();
        continue;
      }
      if (has_ended()) return std::move(answer_);
      if (!choose_next()) return std::move(answer_);
    }
    if (!between_.is_motion()) {
      return end(AdaptiveOutcome::not_solved,
                 fmt::format("After {}, the trajectory still violates constraints between stages:{}",
                             counted(options_.most_grids, "grid"), between_.words(*task_.problem, answer_.trajectory)));
    }
    return end(AdaptiveOutcome::too_many,
               fmt::format("After {}, the estimated error is still {:.1e}, larger than the requested accuracy {:g}.",
                           counted(options_.most_grids, "grid"), answer_.estimate.relative, options_.accuracy));
  }

  AdaptiveAnswer end(AdaptiveOutcome outcome, std::string message) {
    answer_.outcome = outcome;
    answer_.message = std::move(message);
    return std::move(answer_);
  }

  AdaptiveAnswer end_stopped() {
    Solution& solution = answer_.solution;
    std::string words = "The first grid was not solved.";
    if (is_solved(solution.status)) {
      const double error = is_estimated_ ? answer_.estimate.relative : std::numeric_limits<double>::infinity();
      words = fmt::format("The result is the solution on {} intervals. Its {}.", answer_.program->grid().intervals(),
                          std::isfinite(error) ? fmt::format("estimated error is {:.1e}", error) : "error is unknown");
    }
    solution.status = stop_is_requested() ? Status::interrupted : Status::time_limit;
    return end(AdaptiveOutcome::stopped, fmt::format("{} {}", sentence_of(solution.status), words));
  }

  /// Solves on the present grid and estimates the error. False if it was not solved. Where a limit ends the solve, the
  /// answer before stays, and its solution gets the work.
  bool attempt() {
    const auto begin = Clock::now();
    auto made = std::make_unique<Transcription>(*task_.problem, *element_, make_tableau(task_.tableau, stages_), grid_);
    grid_ = made->grid();  // with nodes at the times of bounds, which later grids share
    Solution solved_here = solve(*made);
    const int iterations = solved_here.major_iterations.value_or(0);
    if (must_stop() && !is_solved(solved_here.status) && answer_.program) {
      add_work(solved_here, answer_.solution);
      stop_if_requested();
    }
    add_work(answer_.solution, solved_here);
    answer_.program = std::move(made);
    answer_.solution = std::move(solved_here);
    is_estimated_ = false;
    Transcription& program = *answer_.program;
    const Solution& solution = answer_.solution;
    const Eigen::VectorXd steps = program.guessed_horizon() * grid_.relative_widths();
    GridAttempt record{.intervals = steps.size(),
                       .stages = stages_,
                       .status = solution.status,
                       .message = solution.message,
                       .relative = std::numeric_limits<double>::infinity(),
                       .largest_step = steps.maxCoeff(),
                       .smallest_step = steps.minCoeff(),
                       .iterations = iterations};
    if (is_solved(solution.status)) {
      const Trajectory earlier =
          std::exchange(answer_.trajectory, read_trajectory(program, solution.primal, solution.multipliers));
      between_ = violation_between_stages(*task_.problem, program.traced_problem(), answer_.trajectory);
      if (between_.is_motion()) {
        answer_.estimate = estimated(program, earlier);
        is_estimated_ = true;
        record.relative = answer_.estimate.relative;
        record.floor = answer_.estimate.floor;
      } else {
        record.status = Status::violates_between_stages;
      }
    }
    record.seconds = seconds_since(begin);
    answer_.grids.push_back(record);
    if (!is_solved(solution.status)) stop_if_requested();
    return is_solved(solution.status);
  }

  /// The estimate of `ErrorEstimator`; where that does not cover the problem, from here on by comparison with the
  /// answer before, infinite where there is none to compare with.
  [[nodiscard]] ErrorEstimate estimated(Transcription& program, const Trajectory& earlier) {
    if (reason_to_compare_.empty()) {
      try {
        if (!estimator_) estimator_.emplace(program);
        return estimator_->estimate(program, answer_.solution.primal, answer_.solution.multipliers, answer_.trajectory);
      } catch (const Error& reason) {
        reason_to_compare_ = reason.what();
      }
    }
    if (is_finer_than_before_) return error_by_comparison(program, earlier, answer_.trajectory);
    ErrorEstimate unknown;
    unknown.relative = std::numeric_limits<double>::infinity();
    return unknown;
  }

  [[nodiscard]] Solution solve(Transcription& program) const {
    const auto solver = make_solver(options_.solver, solver_options_, options_.named_options);
    const auto settled = [&](Solution solution) {
      if (!is_solved(solution.status)) settle(program, solver_options_.tolerance, solution);
      return solution;
    };
    if (answer_.grids.empty()) return settled(solver->solve(program, sample(program, task_.start)));
    const Eigen::VectorXd start = sample(program, smooth_motion(answer_.trajectory));
    Solution solution = settled(solver->solve(program, start, sample_multipliers(program, answer_.trajectory)));
    if (is_solved(solution.status) || must_stop()) return solution;
    Solution from_motion = settled(solver->solve(program, start));
    add_work(solution, from_motion);
    return from_motion;
  }

  [[nodiscard]] std::string failure() const {
    const GridAttempt& last = answer_.grids.back();
    return fmt::format("Grid {} with {} intervals has the status {}. {}", answer_.grids.size(), last.intervals,
                       name_of(last.status), last.message);
  }

  bool has_ended() {
    const ErrorEstimate& estimate = answer_.estimate;
    if (estimate.relative <= options_.accuracy) {
      answer_.outcome = AdaptiveOutcome::reached;
      answer_.message = fmt::format("The estimated error is {:.1e} on {} with {}{}.", estimate.relative,
                                    counted(answer_.grids.back().intervals, "interval"), counted(stages_, "stage"),
                                    reason_to_compare_.empty() ? "" : ", by comparison with the previous grid");
      return true;
    }
    return stopped_by_rounding(estimate.floor);
  }

  /// True if a floor is above the accuracy; sets the outcome and a sentence about it.
  bool stopped_by_rounding(double floor) {
    if (floor <= options_.accuracy) return false;
    answer_.outcome = AdaptiveOutcome::rounding;
    answer_.message = fmt::format(
        "Double precision cannot reach an accuracy of {:g}: at the required step sizes, the round-off of the momenta "
        "is {:.0e}. The estimated error is {:.1e}.",
        options_.accuracy, floor, answer_.estimate.relative);
    return true;
  }

  /// As few stages as the tableau has, and that many more intervals: controls are constant or linear in an interval
  /// then and keep their bounds wherever they switch. False if there are no fewer.
  bool take_fewest_stages() {
    const int fewest = task_.tableau == "gauss" ? 1 : 2;
    if (stages_ <= fewest || family_of(task_.method).name == "galerkin") return false;
    grid_ = subdivided(task_.first, stages_ / fewest);
    stages_ = most_stages_ = fewest;
    narrowed_ = 0;
    is_finer_than_before_ = false;
    return true;
  }

  /// The next grid where the motion leaves its constraints between stages: finer there, the same elsewhere. Where that
  /// has not helped controls that switch, one with fewer stages.
  void refine_where_violated() {
    constexpr int most_narrowed = 3;
    if (between_.keeps_state() && narrowed_++ == most_narrowed && take_fewest_stages()) return;
    constexpr double narrower = 0.25;
    Eigen::VectorXd widths = grid_.relative_widths();
    const auto narrow = [&](Eigen::Index k) { widths[k] = std::max(narrower * widths[k], Grid::narrowest); };
    if (between_.keeps_state()) {
      std::ranges::for_each(between_.intervals_of_control, narrow);
    } else {
      narrow(between_.state.interval);
    }
    grid_ = graded_grid(grid_, widths, options_.largest_ratio);
    is_finer_than_before_ = false;
  }

  /// The next grid where errors are estimated by comparison: more stages where they may grow, else every interval
  /// halved. False if by the order of the error the accuracy takes too many intervals, on three grids in turn.
  bool refine_everywhere() {
    constexpr double most_predicted = 65536.0;
    constexpr int most_slow_grids = 3;
    const double now = answer_.estimate.relative;
    const double before = answer_.grids.size() < 2 ? now : answer_.grids[answer_.grids.size() - 2].relative;
    const auto present = static_cast<double>(grid_.intervals());
    const double order = std::log2(before / now);  // not a number or infinite before there are two estimates
    const double predicted =
        order > 0.0 ? present * std::pow(now / options_.accuracy, 1.0 / order) : 2.0 * most_predicted;
    const bool is_slow = std::isfinite(before) && predicted > most_predicted;
    slow_grids_ = is_slow ? slow_grids_ + 1 : 0;
    is_finer_than_before_ = true;
    if (options_.refinement == Refinement::hp && stages_ < most_stages_) {
      ++stages_;
      return true;
    }
    const auto intervals = static_cast<Eigen::Index>(grid_.intervals());
    if (2 * intervals > options_.most_intervals || slow_grids_ >= most_slow_grids) {
      answer_.outcome = AdaptiveOutcome::too_many;
      answer_.message = fmt::format(
          "An accuracy of {:g} needs too many intervals. On {} intervals, the estimated error is {:.1e}. Use more "
          "stages, which need fewer intervals.",
          options_.accuracy, intervals, now);
      return false;
    }
    grid_ = subdivided(grid_, 2);
    return true;
  }

  /// The next grid and number of stages; false if there is none.
  bool choose_next() {
    if (!reason_to_compare_.empty()) return refine_everywhere();
    const ErrorEstimate& estimate = answer_.estimate;
    const Tableau& tableau = answer_.program->tableau();
    const double share = std::isfinite(estimate.relative) ? margin * options_.accuracy / estimate.relative : margin;
    const auto present = static_cast<double>(grid_.intervals());
    constexpr double most_growth = 4.0;
    const auto even_widths = [&](double growth) {
      return equidistributed_widths(grid_, estimate.defects, tableau.order, share, growth * present);
    };
    EvenWidths even = even_widths(most_growth);
    if (options_.refinement == Refinement::hp && stages_ < most_stages_ && even.asked > 2.0 * present) {
      ++stages_;
      even = even_widths(1.0);
    }
    const Grid next = graded_grid(grid_, even.widths, options_.largest_ratio);
    if (static_cast<Eigen::Index>(next.intervals()) > options_.most_intervals) {
      answer_.outcome = AdaptiveOutcome::too_many;
      answer_.message = fmt::format("An accuracy of {:g} needs more than {} intervals. The estimated error is {:.1e}.",
                                    options_.accuracy, options_.most_intervals, estimate.relative);
      return false;
    }
    const double narrower = grid_.relative_widths().minCoeff() / next.relative_widths().minCoeff();
    if (stopped_by_rounding(estimate.floor * narrower)) return false;
    grid_ = next;
    return true;
  }

  const AdaptiveTask& task_;
  const AdaptiveOptions& options_;
  std::unique_ptr<Element> element_;
  SolverOptions solver_options_;
  Grid grid_;
  int stages_;
  int most_stages_ = most_stages;
  std::optional<ErrorEstimator> estimator_;
  std::string reason_to_compare_;      // why `estimator_` gives no estimate; empty if it does
  bool is_finer_than_before_ = false;  // every interval of the grid before was halved, or has more stages
  int narrowed_ = 0;                   // grids, in turn, where controls left their bounds
  int slow_grids_ = 0;                 // in turn whose error hardly fell
  bool is_estimated_ = false;          // of the last solution: a limit may come before its estimate
  ViolationBetweenStages between_;     // of the last grid
  AdaptiveAnswer answer_;
};

constexpr std::array refinements{Named<Refinement>{"h", Refinement::h}, Named<Refinement>{"hp", Refinement::hp}};

}  // namespace

Refinement refinement_named(std::string_view name) { return value_named(refinements, name, "there is no refinement"); }

double AdaptiveOptions::solver_tolerance(double tolerance) const {
  constexpr double of_accuracy = 1e-2;
  constexpr double least = 1e-12;
  return std::min(tolerance, std::max(of_accuracy * accuracy, least));
}

void AdaptiveOptions::validate() const {
  const bool is_allowed = accuracy >= finest && accuracy <= coarsest;
  if (!is_allowed) {
    throw Error("the accuracy must lie between {:g} and {:g}, got {:g}; double precision has 16 digits", finest,
                coarsest, accuracy);
  }
  if (!(largest_ratio > 1.0)) throw Error("the largest ratio of neighbouring step sizes must be greater than 1");
}

AdaptiveAnswer solve_adaptively(const AdaptiveTask& task, const AdaptiveOptions& options,
                                const std::function<void(const GridAttempt&)>& on_grid) {
  options.validate();
  if (family_of(task.method).is_condensed) {
    throw Error("grids cannot be refined with single shooting, which has no nodes; choose multiple_shooting");
  }
  return AdaptiveRun(task, options).run(on_grid);
}

}  // namespace dmocbench
