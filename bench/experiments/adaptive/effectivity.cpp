#include "bench/experiments/adaptive/effectivity.hpp"

#include <array>
#include <cmath>

#include "bench/run/solve_case.hpp"
#include "methods/adaptive/adaptive_solve.hpp"
#include "methods/diagnostics/accuracy.hpp"
#include "methods/runtime/stop_scope.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench {

namespace {

/// Smaller true errors, relative to the size of the quantity, are due to rounding and the solver's tolerance.
constexpr double share_of_rounding = 1e-10;

double size_of(const Eigen::MatrixXd& one) { return one.rowwise().norm().maxCoeff(); }
double size_of(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other) {
  return std::sqrt((one.rowwise().squaredNorm() + other.rowwise().squaredNorm()).maxCoeff());
}

/// A row for every quantity of an answer.
void append_rows(const CertifiedProblem& certified, const MeasuredEffectivity& row, const Trajectory& answer,
                 const ErrorEstimate& estimate, std::vector<MeasuredEffectivity>& rows) {
  const TrueError error = true_error(certified, answer);
  struct Quantity {
    const char* name;
    double estimated;
    double true_error;
    double size;
  };
  const std::array quantities{
      Quantity{"state", size_of(estimate.q), error.state, size_of(answer.q)},
      Quantity{"momentum", size_of(estimate.p), error.momentum, size_of(answer.p)},
      Quantity{"costate", size_of(estimate.psi_q, estimate.psi_p), error.costate, size_of(answer.psi_q, answer.psi_p)},
      Quantity{"objective", std::abs(estimate.objective), error.objective, std::abs(answer.cost)}};
  for (const Quantity& quantity : quantities) {
    MeasuredEffectivity of_quantity = row;
    of_quantity.quantity = quantity.name;
    of_quantity.estimated = quantity.estimated;
    of_quantity.true_error = quantity.true_error;
    of_quantity.relative = error.relative;
    of_quantity.verdict = quantity.true_error > share_of_rounding * quantity.size ? "measured" : "floor";
    rows.push_back(of_quantity);
  }
}

}  // namespace

std::vector<MeasuredEffectivity> measure_effectivity(const CertifiedProblem& certified, const std::string& method,
                                                     int stages, const std::string& solver_name,
                                                     const SolverOptions& options) {
  std::vector<MeasuredEffectivity> rows;
  MeasuredEffectivity row{.scheme = {certified.problem().name(), method, "gauss", stages}};
  SolverOptions exact = options;
  exact.tolerance = 1e-12;
  const auto solver = make_solver(solver_name, exact);
  for (const long long intervals : {64LL, 128LL}) {
    const auto program = certified.transcribe(row.scheme, intervals);
    const Solution solution =
        solve_from(*program, sample(*program, smooth_motion(certified.motion())), certified.motion(), *solver);
    row.grid = "uniform";
    row.intervals = intervals;
    row.status = name_of(solution.status);
    if (!is_solved(solution.status)) {
      rows.push_back(row);
      continue;
    }
    const Trajectory answer = read_trajectory(*program, solution.primal, solution.multipliers);
    if (!accuracy(certified.problem(), answer).is_motion()) {
      row.status = name_of(Status::too_coarse);
      rows.push_back(row);
      continue;
    }
    ErrorEstimator estimator(*program);
    append_rows(certified, row, answer, estimator.estimate(*program, solution.primal, solution.multipliers, answer),
                rows);
  }
  AdaptiveOptions adaptive;
  adaptive.accuracy = stages == 1 ? 1e-4 : 1e-6;
  adaptive.solver = solver_name;
  adaptive.solver_options = exact;
  const AdaptiveAnswer answer = solve_adaptively({.problem = &certified.problem(),
                                                  .method = method,
                                                  .tableau = "gauss",
                                                  .stages = stages,
                                                  .first = Grid::uniform(32),
                                                  .start = smooth_motion(certified.motion())},
                                                 adaptive);
  stop_if_requested();
  row.grid = "adapted";
  if (answer.program) row.intervals = static_cast<Eigen::Index>(answer.program->grid().intervals());
  row.status = name_of(answer.solution.status);
  if (answer.outcome == AdaptiveOutcome::reached) {
    append_rows(certified, row, answer.trajectory, answer.estimate, rows);
  } else {
    rows.push_back(row);
  }
  return rows;
}

Columns<MeasuredEffectivity> effectivity_columns() {
  using M = MeasuredEffectivity;
  return scheme_columns<M>() +
         Columns<M>{
             {"grid", "", "grid: uniform, or adapted to an accuracy of 1e-4 (s = 1) or 1e-6", &M::grid, in_key},
             {"intervals", "", "number of intervals N", &M::intervals, in_key},
             {"quantity", "", "q, p or psi (largest error over the nodes), or the cost", &M::quantity, in_key},
             {"status", "", "status of the solve", &M::status},
             {"estimated", "", "estimated error", &M::estimated},
             {"true_error", "", "error relative to the certified optimum", &M::true_error},
             {"effectivity", "", "estimated error divided by true error", &M::effectivity},
             {"relative_error", "", "largest relative true error of q, p and cost", &M::relative},
             {"verdict", "", "measured, or floor if the true error is below 1e-10 of the quantity", &M::verdict}};
}

}  // namespace dmocbench
