#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "methods/adaptive/error_estimate.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/program/solution.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/motions/grid.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The refinement where an answer is not accurate enough.
enum class Refinement : std::uint8_t {
  h,   ///< the steps
  hp,  ///< the steps, and the number of stages, up to three: see `solve_adaptively`
};

/// The refinement with that name, "h" or "hp". Throws `Error` that lists the names if there is none.
[[nodiscard]] Refinement refinement_named(std::string_view name);

/// Options of an adaptive solve.
struct AdaptiveOptions {
  double accuracy = 1e-6;                 ///< of `ErrorEstimate::relative`
  Refinement refinement = Refinement::h;  ///< intervals, or stages too
  double largest_ratio = 2.0;             ///< of neighbouring steps
  int most_grids = 20;                    ///< after which it ends as `too_many`
  Eigen::Index most_intervals = 1 << 20;  ///< of a grid
  std::string solver = "interior_point";  ///< as `make_solver` takes it
  /// Of every solve, except the tolerance; `most_seconds` is the limit of all grids together.
  SolverOptions solver_options;
  NamedOptions named_options;  ///< the solver's, by name

  /// The tolerance of the solves: `tolerance`, or a hundredth of `accuracy` if that is less, but not below 1e-12.
  [[nodiscard]] double solver_tolerance(double tolerance) const;

  /// The permitted accuracies: doubles have 16 digits.
  static constexpr double finest = 1e-14;
  static constexpr double coarsest = 0.1;  ///< the largest permitted accuracy
  /// Throws `Error` that names the number if it is out of range.
  void validate() const;
};

/// One of the grids.
struct GridAttempt {
  Eigen::Index intervals = 0;       ///< N
  Eigen::Index stages = 0;          ///< s
  Status status = Status::not_run;  ///< how the solve ended, and whether its motion keeps its constraints
  std::string message;              ///< of the solver
  double relative = 0.0;            ///< `ErrorEstimate::relative`, infinite where there is none
  double floor = 0.0;               ///< `ErrorEstimate::floor`
  double largest_step = 0.0;        ///< of the grid, as a time
  double smallest_step = 0.0;       ///< of the grid, as a time
  int iterations = 0;               ///< of the solver
  double seconds = 0.0;             ///< set-up, solve, replay, estimate
};

/// The outcome of an adaptive solve.
enum class AdaptiveOutcome : std::uint8_t {
  reached,     ///< the estimated error is at most the requested accuracy
  not_solved,  ///< a program was not solved
  rounding,    ///< rounding keeps doubles from being that accurate
  too_many,    ///< that accuracy would take more grids or intervals than allowed
  stopped,     ///< the limit of time, or a request, ended it: the status of the solution says which
};

/// The answer on the last grid, and the grids before it. Where it was stopped, the last grid that was solved, or the
/// first; without a program if not even that was set up.
struct AdaptiveAnswer {
  AdaptiveOutcome outcome = AdaptiveOutcome::not_solved;  ///< how it ended
  std::string message;                                    ///< a sentence
  std::vector<GridAttempt> grids;                         ///< all grids, in their order
  std::unique_ptr<Transcription> program;                 ///< of the last grid
  /// Of the last grid; its counts and times are the sums over all solves.
  Solution solution;
  Trajectory trajectory;   ///< of the last grid that was solved; without nodes if none was
  ErrorEstimate estimate;  ///< of it
};

/// A problem, a method, a first grid and a first motion.
struct AdaptiveTask {
  const Problem* problem = nullptr;  ///< the problem to solve
  std::string method;                ///< as `make_element` takes it
  std::string tableau;               ///< as `make_tableau` takes it, with `stages`
  int stages = 1;                    ///< s
  Grid first = Grid::uniform(32);    ///< the first grid
  Motion start;                      ///< where the first solve begins
};

/// Solves on one grid after the other until the estimated error (`ErrorEstimator`) is at most `options.accuracy`.
///
/// The next grid is `graded_grid` of `equidistributed_widths`, for nine tenths of the requested accuracy; it has at
/// most four times as many intervals. Solves begin at the motion on the grid before, with the multipliers that belong
/// to its costates (`sample_multipliers`), and without these where that fails. With `Refinement::hp`, while there are
/// fewer than three stages and the next grid would have more than twice as many intervals, the number of stages grows
/// by one instead, on as many intervals as before.
///
/// Where `ErrorEstimator` does not cover the problem (a free horizon, boundary conditions, active bounds or
/// inequalities, singular controls), the error is the difference from the answer before (`error_by_comparison`), and
/// every interval is halved; with `Refinement::hp` the number of stages grows to three first. It ends as `too_many`
/// where, by the order of the error, the accuracy takes more than 65536 intervals, on three grids in turn.
///
/// A motion that leaves its constraints between stages (`violation_between_stages`) has no estimate, whatever the
/// requested accuracy: the next grid is four times as fine where a control leaves its bounds, or where the motion
/// leaves other constraints farthest, and the same elsewhere. Where three such grids have not helped a control, or one
/// of them is not solved, it begins again with one Gauss or two Lobatto stages, whose controls keep their bounds, on
/// that many more intervals; the number of stages stays so (`galerkin` keeps its own).
///
/// It ends as `rounding` where the floor of an estimate is above the accuracy, or the next grid's would be. It stops
/// where a program is not solved (`solution` has the reason), and as `stopped` where the time is up. `on_grid` is
/// called for every grid. Throws `Error` as `Transcription` does.
[[nodiscard]] AdaptiveAnswer solve_adaptively(const AdaptiveTask& task, const AdaptiveOptions& options,
                                              const std::function<void(const GridAttempt&)>& on_grid = {});

}  // namespace dmocbench
