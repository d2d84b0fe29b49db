#pragma once

#include <memory>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// Values of a program at a point: of its Lagrangian φ + λᵀa, and its bounds.
struct ProgramValues {
  double objective = 0.0;            ///< φ
  Eigen::VectorXd gradient;          ///< of the Lagrangian, one entry per variable
  Eigen::VectorXd constraints;       ///< a, one entry per constraint
  Eigen::VectorXd variable_lower;    ///< ξ⁻
  Eigen::VectorXd variable_upper;    ///< ξ⁺
  Eigen::VectorXd constraint_lower;  ///< a⁻
  Eigen::VectorXd constraint_upper;  ///< a⁺
};

/// `primal` has variable_count() entries, `multipliers` constraint_count().
[[nodiscard]] ProgramValues values_of(NonlinearProgram& program, const Eigen::VectorXd& primal,
                                      const Eigen::VectorXd& multipliers);

/// The rate at which a program changes with a parameter (a mass, a component of an end state) at a fixed point: the
/// difference of its values, entry by entry, over `distance`, the difference of the parameter. Central differences are
/// exact up to rounding where formulas are quadratic in the parameter, as bounds are that the parameter is itself.
/// Bounds that are infinite stay. The same program, given one value and then the other, or two programs of equal shape.
[[nodiscard]] ProgramValues rate_of_change(const ProgramValues& below, const ProgramValues& above, double distance);

/// The derivatives of an optimum in a parameter.
struct Sensitivity {
  double objective = 0.0;       ///< of the optimal φ, the scaled cost
  Eigen::VectorXd primal;       ///< of the optimum ξ, variable_count() entries
  Eigen::VectorXd multipliers;  ///< of λ, constraint_count() entries
};

/// First-order dependence of an optimum and its cost on parameters and end states.
///
/// The cost: the derivative of the Lagrangian, as the optimum's own motion does not change it (except for fixed
/// variables and active bounds, which move with their values). The optimum: one linear system with the matrix of a
/// Newton step there, factorised with pivoting since nothing corrects its answer, whose right-hand side is the rate of
/// change of the conditions. Bounds and inequalities are active as at the optimum; where one is about to
/// change, the derivative belongs to neither side.
class Sensitivities {
 public:
  /// A solved point of the program (`Solution::primal`, `Solution::multipliers`). The program must outlive this and
  /// keep its values. Throws `Error` if a size is wrong or a derivative is not finite.
  Sensitivities(NonlinearProgram& program, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers);
  ~Sensitivities();
  Sensitivities(const Sensitivities&) = delete;
  Sensitivities& operator=(const Sensitivities&) = delete;

  /// `rate`: see `rate_of_change`, at the solved point. Throws `Error` if the matrix is singular.
  [[nodiscard]] Sensitivity along(const ProgramValues& rate);

 private:
  struct Optimum;
  std::unique_ptr<Optimum> optimum_;
};

}  // namespace dmocbench
