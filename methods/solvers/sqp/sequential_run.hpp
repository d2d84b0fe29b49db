#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/solvers/linearisation.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/solvers/sqp/globalisation.hpp"
#include "methods/solvers/sqp/hessians.hpp"
#include "methods/solvers/sqp/quadratic/quadratic_solver.hpp"

namespace dmocbench::sqp {

/// What the method lets its user choose.
struct SequentialOptions {
  Crash crash = Crash::none;
  PricingRule pricing = PricingRule::largest;
  std::uint32_t seed = 1;
  bool limited_memory = false;  ///< quasi-Newton instead of the exact Hessian
};

/// One run of the SQP method.
class SequentialRun {
 public:
  SequentialRun(NonlinearProgram& program, const Eigen::VectorXd& start, const SolverOptions& options,
                const SequentialOptions& choices);

  /// Major iterations until the Karush-Kuhn-Tucker conditions hold; counts in the solution.
  [[nodiscard]] Solution run();

 private:
  [[nodiscard]] std::optional<Status> major_iteration();
  void choose_hessian();
  void take(const LineSearchResult& search, const QuadraticSolution& quadratic);
  void adapt_shift(double share);
  [[nodiscard]] bool has_converged();
  void print(double longest, double share, double objective) const;
  [[nodiscard]] std::optional<Status> reason_to_stop() const;
  [[nodiscard]] bool observe(MinorIteration minor);

  NonlinearProgram& program_;
  const SolverOptions& options_;
  SequentialOptions choices_;
  Evaluator evaluator_;
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
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace dmocbench::sqp
