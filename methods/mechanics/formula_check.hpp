#pragma once

#include <string>
#include <vector>

#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Tells where L, f, C or h of a problem, or one of their first derivatives, is not a finite number.
///
/// A formula may be undefined where its derivatives are not, as log(q - 1) is below its singularity: no equation of
/// motion contains the Lagrangian itself, so that a solver cannot notice.
class FormulaCheck {
 public:
  explicit FormulaCheck(const Problem& problem);
  /// The first that is not a number, "lagrangian" or "a derivative of running_cost"; empty if all are.
  [[nodiscard]] std::string undefined_at(const MotionPoint& point, double t);

 private:
  [[nodiscard]] ExpressionVector trace(const Problem& problem, const ControlledState& x);

  std::vector<std::string> names_;  // per output; before the function, which fills them
  PointFunction formulas_;
  Eigen::VectorXd values_;
};

}  // namespace dmocbench
