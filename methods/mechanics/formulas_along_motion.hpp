#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "methods/expression/enclosure.hpp"
#include "methods/expression/tape.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

/// Finds where L, f, C or h of a problem, or one of their derivatives, is not a finite number.
///
/// A formula may be undefined where its derivatives are not, as log(q - 1) is below its singularity: no equation of
/// motion contains the Lagrangian itself, so that a solver cannot notice.
class FormulaCheck {
 public:
  /// Which derivatives have to be finite.
  enum class Derivatives : std::uint8_t { first, second };
  /// Second derivatives, which Newton's method needs, are checked as sums over the second variable, and over the
  /// entries of a formula: a sum is not a number where one of its terms is not.
  explicit FormulaCheck(const Problem& problem, Derivatives up_to = Derivatives::first);
  /// The first that is not a number, "lagrangian", "a derivative of running_cost" or "a second derivative of force";
  /// empty if all are.
  [[nodiscard]] std::string undefined_at(const MotionPoint& point, double t);

 private:
  [[nodiscard]] ExpressionVector trace(const Problem& problem, const ControlledState& x, Derivatives up_to);

  std::vector<std::string> names_;  // per output; before the function, which fills them
  PointFunction formulas_;
  Eigen::VectorXd values_;
};

/// The path constraints h of a problem at many points at once, for the present values of parameters that are kept open.
class PathConstraints {
 public:
  /// Room for `most_rows` points at a time.
  PathConstraints(const TracedProblem& traced, Eigen::Index most_rows);

  /// How many entries h has.
  [[nodiscard]] Eigen::Index count() const noexcept { return values_.cols(); }
  /// Whether an entry of h depends on t.
  [[nodiscard]] bool reads_time() const noexcept { return reads_time_; }
  /// h in a column per entry, at the first `count` rows of (q, v, u, y, t), 2n + m + l + 1 columns; valid until the
  /// next call.
  [[nodiscard]] Eigen::Ref<const Eigen::MatrixXd> at(const Eigen::MatrixXd& rows, Eigen::Index count);
  /// The ranges of h and of its rate on a part of a motion, by the ranges of (q, v, u, y, t).
  [[nodiscard]] std::vector<EnclosedRate> on(std::span<const EnclosedRate> part) const;

 private:
  PathConstraints(Schedule schedule, Eigen::Index time_input, Eigen::Index most_rows);

  Schedule schedule_;
  Tape tape_;
  Tape::Workspace workspace_;
  Eigen::MatrixXd values_;
  bool reads_time_;
};

}  // namespace dmocbench
