#pragma once

#include <memory>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "methods/program/solution.hpp"
#include "methods/solvers/counted_program.hpp"
#include "methods/solvers/linearisation.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/solvers/sqp/globalisation.hpp"
#include "methods/solvers/sqp/hessians.hpp"
#include "methods/solvers/sqp/quadratic/quadratic_solver.hpp"
#include "methods/solvers/sqp/sqp_solver.hpp"

namespace dmocbench::sqp {

/// The quadratic program at a point with derivatives; `hessian` must outlive it.
[[nodiscard]] QuadraticProgram quadratic_program_at(const NonlinearProgram& program, const Linearisation& at,
                                                    const Hessian& hessian);

/// One run of the SQP method.
class SequentialRun {
 public:
  SequentialRun(CountedProgram& program, const Eigen::VectorXd& start, const SolverOptions& options,
                const SequentialOptions& choices);

  /// Major iterations until the Karush-Kuhn-Tucker conditions hold.
  [[nodiscard]] Solution run();

 private:
  [[nodiscard]] std::optional<Status> major_iteration();
  void choose_hessian();
  void take(const LineSearchResult& search, const QuadraticSolution& quadratic);
  void adapt_shift(double step_length);
  [[nodiscard]] bool has_converged();
  void print(double longest, double step_length, double objective) const;
  [[nodiscard]] std::optional<Status> reason_to_stop() const;
  [[nodiscard]] bool observe(MinorIteration minor);

  CountedProgram& program_;
  const SolverOptions& options_;
  SequentialOptions choices_;
  double tolerance_;
  QuadraticSolver quadratic_solver_;
  Globalisation globalisation_;
  Convexification convexification_;
  std::unique_ptr<Hessian> hessian_;
  LimitedMemoryHessian* limited_memory_ = nullptr;  // hessian_, if it is one
  Linearisation at_;
  Eigen::VectorXd multipliers_;
  double shift_ = 0.0;           // of the present Hessian
  double cautious_shift_ = 0.0;  // asked for by short steps
  int majors_ = 0;
  int phase_one_minors_ = 0;
  int phase_two_minors_ = 0;
  std::string message_;
};

}  // namespace dmocbench::sqp
