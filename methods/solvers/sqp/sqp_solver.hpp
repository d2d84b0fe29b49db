#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "methods/solvers/minor_iteration.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/solvers/sqp/quadratic/pricing.hpp"

namespace dmocbench {

/// The second derivatives of the quadratic programs.
enum class SecondDerivatives : std::uint8_t {
  exact,                   ///< the Hessian of the Lagrangian
  limited_memory,          ///< quasi-Newton updates of the identity
  limited_memory_by_cost,  ///< quasi-Newton updates of the curvatures of the cost at the start, 1 where it has none
};

/// Options of `SqpSolver`.
struct SequentialOptions {
  sqp::Crash crash = sqp::Crash::none;                                 ///< the basis of the first quadratic program
  sqp::PricingRule pricing = sqp::PricingRule::largest;                ///< which column enters
  std::uint32_t seed = 1;                                              ///< of the random pricing rule
  SecondDerivatives hessian = SecondDerivatives::exact;                ///< of the quadratic programs
  std::function<void(const MinorIteration&)> on_minor_iteration = {};  ///< called for every one
};

/// The basis with that name, "none" or "basis". Throws `Error` that lists the names if there is none.
[[nodiscard]] sqp::Crash crash_named(std::string_view name);

/// The options from their names: crash=none|basis, pricing=largest|lowest|last|random, seed=(a whole number),
/// hessian=exact|limited_memory|limited_memory_by_cost. Throws `Error` on another name or value.
[[nodiscard]] SequentialOptions sequential_options(const NamedOptions& named);

/// Sequential quadratic programming with an active-set method that starts each first quadratic program from the slack
/// basis, as the solver of the paper does: every minor iteration is counted and can be watched
/// (`SequentialOptions::on_minor_iteration`). README.md in this folder explains minor iterations and their expected
/// numbers.
class SqpSolver final : public SolverWithoutMemory {
 public:
  /// Throws `Error` if an option is out of range.
  explicit SqpSolver(SolverOptions options = {}, SequentialOptions choices = {});

 private:
  [[nodiscard]] Solution run(CountedProgram& program, const Eigen::VectorXd& start) const override;

  SequentialOptions choices_;
};

}  // namespace dmocbench
