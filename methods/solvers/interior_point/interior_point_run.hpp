#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "methods/program/solution.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/solvers/counted_program.hpp"
#include "methods/solvers/interior_point/barrier_program.hpp"
#include "methods/solvers/interior_point/filter.hpp"
#include "methods/solvers/interior_point/newton_step.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/solvers/stop_rule.hpp"

namespace dmocbench::interior_point {

/// One solve by the primal-dual interior-point method with a filter line search of Wächter and Biegler (Mathematical
/// Programming 106, 2006); equations are named after it.
class InteriorPointRun {
 public:
  InteriorPointRun(CountedProgram& program, const ProgramRuns& runs, KktSystem& kkt, const Eigen::VectorXd& start,
                   const SolverOptions& options);

  /// Judged by `confirm` afterwards, like every solver's.
  [[nodiscard]] Solution run();

 private:
  /// What the conditions of optimality leave at a point.
  struct Residuals {
    double stationarity = 0.0;
    double violation = 0.0;
  };
  /// Mean magnitudes of multipliers.
  struct Means {
    double all;
    double of_bounds;
  };

  [[nodiscard]] bool is_warm() const noexcept { return options_.start_multipliers.size() > 0; }
  [[nodiscard]] std::optional<Status> iterate();
  [[nodiscard]] std::optional<Status> reason_to_stop() const;
  [[nodiscard]] bool begin(const Eigen::VectorXd& start);
  /// From the derivatives at the point; false if one of them is not finite.
  [[nodiscard]] bool find_slope();

  // Convergence.
  [[nodiscard]] Residuals residuals();
  [[nodiscard]] Means mean_multipliers() const;
  [[nodiscard]] bool has_converged(const Residuals& at) const;
  void lower_barrier(const Residuals& at);
  void keep_multipliers_from_running_away();

  // Line search.
  [[nodiscard]] double largest_step(const Direction& direction, double share) const;
  [[nodiscard]] double largest_bound_step(const Direction& direction, double share) const;
  [[nodiscard]] bool search(const Direction& direction);
  [[nodiscard]] bool try_point(const Direction& direction, double length, double slope, double reference_length);
  [[nodiscard]] bool is_worth_correcting(double violation_there) const;
  [[nodiscard]] bool correct_second_order(double slope, double length);
  void move_bounds(const Direction& direction, double length);
  void set_trial(const Direction& direction, double length);
  void accept_trial();
  [[nodiscard]] double noise_of_function() const;

  // Where no step is acceptable.
  [[nodiscard]] std::optional<Status> restore();
  [[nodiscard]] bool step_towards_rows();
  void begin_anew();

  void report(const char* kind, double length);
  void measure();
  [[nodiscard]] double function_at(const Point& point, const BarrierProgram::Merit& merit) const;

  NonlinearProgram& plain_program_;
  const SolverOptions& options_;
  BarrierProgram program_;
  NewtonStep newton_;
  Filter filter_;
  Point point_;
  Point trial_;
  Direction direction_;
  std::vector<Eigen::Index> fixed_;
  Eigen::VectorXd slope_;  // ∇φ + Jᵀλ at the point, zero for what is fixed
  Eigen::VectorXd rows_;   // residuals at the point
  Eigen::VectorXd trial_rows_;
  Eigen::VectorXd balanced_;  // slope_ with multipliers of bounds
  BarrierProgram::Merit merit_{};
  BarrierProgram::Merit trial_merit_{};
  double function_ = 0.0;  // φ + μ barrier at the point
  double mu_ = 0.0;
  double tolerance_;
  StopRule allowed_;
  double first_violation_ = 0.0;
  double noise_of_violation_ = 0.0;
  int iterations_ = 0;
  double step_length_ = 0.0;
  std::string message_;
  Clock::time_point begin_;
};

}  // namespace dmocbench::interior_point
