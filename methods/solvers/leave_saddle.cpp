#include "methods/solvers/leave_saddle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "methods/runtime/stop_scope.hpp"

namespace dmocbench {

namespace {

/// An answer, with the curvature there.
struct Judged {
  Solution solution;
  std::optional<NegativeCurvature> curvature;
};

double size_of(double value) { return std::max(1.0, std::abs(value)); }

bool is_lower(double cost, const Solution& than, double tolerance) {
  return cost < than.objective - confirmation_factor * tolerance * size_of(than.objective);
}

/// The counts of iterations and systems, which every run begins anew; evaluations and times cover all runs already.
constexpr std::array counts = {&Solution::major_iterations, &Solution::minor_iterations,
                               &Solution::phase_one_minor_iterations, &Solution::phase_two_minor_iterations,
                               &Solution::linear_systems};

/// Counts and times.
void take_costs_of(const Solution& last, Solution& solution) {
  for (const auto count : counts) solution.*count = last.*count;
  solution.evaluations = last.evaluations;
  solution.seconds = last.seconds;
  solution.evaluation_seconds = last.evaluation_seconds;
}

/// Both sides of a saddle.
class Descent {
 public:
  Descent(NonlinearProgram& program, double tolerance, const Confirmation& confirmation,
          const std::function<Solution(const Eigen::VectorXd&)>& solve_from)
      : program_(program), tolerance_(tolerance), confirmation_(confirmation), solve_from_(solve_from) {}

  /// The lowest answer next to a saddle; none where no run ends lower. Its counts, or else the saddle's, cover all runs
  /// so far.
  [[nodiscard]] std::optional<Judged> lowest_next_to(Judged& saddle) {
    const double size = size_of(saddle.solution.primal.lpNorm<Eigen::Infinity>());
    std::optional<Judged> lowest;
    for (const double share : {1e-2, 1e-1, 1.0}) {
      for (const double length : {share * size, -share * size}) {
        if (must_stop()) return lowest;
        consider(saddle.solution, saddle.solution.primal + length * saddle.curvature->direction, lowest);
      }
      if (lowest) return lowest;
    }
    return lowest;
  }

  /// The lowest cost of points that meet the constraints without being solved; none where there was no such point.
  [[nodiscard]] std::optional<double> lowest_cost() const { return lowest_cost_; }

 private:
  void consider(Solution& saddle, const Eigen::VectorXd& start, std::optional<Judged>& lowest) {
    Judged next{.solution = solve_from_(start.cwiseMax(program_.variable_lower()).cwiseMin(program_.variable_upper())),
                .curvature = confirmation_.negative_curvature()};
    Solution& last = lowest ? lowest->solution : saddle;
    for (const auto count : counts) {
      if (next.solution.*count && last.*count) *(next.solution.*count) += *(last.*count);
    }
    const double cost = next.solution.objective;
    // Where the cost has no lower end the point, and with it round-off, grows.
    const double allowed = confirmation_factor * tolerance_ * size_of(next.solution.primal.lpNorm<Eigen::Infinity>());
    if (is_lower(cost, saddle, tolerance_) && !is_solved(next.solution.status) &&
        next.solution.constraint_violation.value_or(unbounded) <= allowed) {
      lowest_cost_ = std::min(cost, lowest_cost_.value_or(cost));
    }
    const bool is_lowest = is_solved(next.solution.status) && is_lower(cost, last, tolerance_);
    if (is_lowest) {
      lowest = std::move(next);
    } else {
      take_costs_of(next.solution, last);
    }
  }

  NonlinearProgram& program_;
  double tolerance_;
  const Confirmation& confirmation_;
  const std::function<Solution(const Eigen::VectorXd&)>& solve_from_;
  std::optional<double> lowest_cost_;
};

/// The part of the cost by which `lower` is lower, in per cent.
double decrease(double cost, double lower) {
  return 100.0 * (cost - lower) / std::max(std::abs(cost), std::abs(lower));
}

}  // namespace

void leave_saddle(NonlinearProgram& program, double tolerance, const Confirmation& confirmation,
                  const std::function<Solution(const Eigen::VectorXd&)>& solve_from, Solution& solution) {
  constexpr int most_saddles = 10;  // on the way to a minimum
  Descent descent(program, tolerance, confirmation, solve_from);
  const double before = solution.objective;
  Judged at{.solution = std::move(solution), .curvature = confirmation.negative_curvature()};
  for (int saddles = 0; saddles < most_saddles && at.curvature; ++saddles) {
    std::optional<Judged> lower = descent.lowest_next_to(at);
    if (!lower) break;
    at = std::move(*lower);
  }
  solution = std::move(at.solution);
  if (solution.objective < before) {
    solution.message += fmt::format(
        " The solver first stopped at a saddle point with a cost {:.3g} % higher, and continued along a direction of "
        "negative curvature.",
        decrease(before, solution.objective));
  }
  if (!at.curvature) return;
  if (const auto cost = descent.lowest_cost(); cost && is_lower(*cost, solution, tolerance)) {
    solution.status = Status::stationary;
    solution.message = fmt::format(
        "{} A point with a cost {:.3g} % lower satisfies the constraints, but no solve from this point converged.",
        sentence_of(solution.status), decrease(solution.objective, *cost));
    return;
  }
  solution.message +=
      " The curvature is negative along a direction that satisfies the linearised constraints. The solution may be a "
      "saddle point, although no solve from either side of it reached a lower cost.";
}

}  // namespace dmocbench
