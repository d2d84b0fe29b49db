#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "methods/solvers/minor_iteration.hpp"
#include "methods/solvers/sqp/quadratic/iterate.hpp"
#include "methods/solvers/sqp/quadratic/pricing.hpp"
#include "methods/solvers/sqp/quadratic/quadratic_program.hpp"

namespace dmocbench::sqp {

/// Called at the end of every minor iteration; false stops the method. The number of calls is the count of minor
/// iterations.
using MinorObserver = std::function<bool(const MinorIteration&)>;

/// The outcome of a quadratic program.
enum class QuadraticStatus : std::uint8_t {
  optimal,
  infeasible,  ///< rows stay violated; `step` minimises the objective with their violations accepted
  breakdown,   ///< singular basis or reduced Hessian not positive definite
  stopped,     ///< by the observer
};

/// The answer to a quadratic program.
struct QuadraticSolution {
  QuadraticStatus status = QuadraticStatus::breakdown;
  std::string message;
  Eigen::VectorXd step;         ///< d
  Eigen::VectorXd multipliers;  ///< λ of the rows: g + Hd + Aᵀλ vanishes in the free variables
  double infeasibility = 0.0;   ///< left in the rows
};

/// Solves the quadratic programs of one SQP run by the active-set method and remembers the sets from one to the next.
class QuadraticSolver {
 public:
  QuadraticSolver(const QuadraticOptions& options, const Pricing& pricing, MinorObserver observer)
      : options_(options), pricing_(pricing), observer_(std::move(observer)) {}

  /// Solves from the sets of the last call (the basis chosen again from the basic and superbasic columns), or from a
  /// start by `Crash` at the first call. If these sets leave variables outside their bounds, or break down, it starts
  /// again from the slack basis; all minor iterations are observed.
  [[nodiscard]] QuadraticSolution solve(const QuadraticProgram& program);

 private:
  [[nodiscard]] QuadraticSolution solve_from(const QuadraticProgram& program, WorkingSet start, bool may_restart);

  QuadraticOptions options_;
  Pricing pricing_;
  MinorObserver observer_;
  std::optional<WorkingSet> sets_;  // at the end of the last call
};

}  // namespace dmocbench::sqp
