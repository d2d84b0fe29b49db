#pragma once

#include <Eigen/Core>

#include "methods/expression/tape.hpp"
#include "methods/mechanics/traced_problem.hpp"

namespace dmocbench {

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

 private:
  PathConstraints(const Schedule& schedule, Eigen::Index time_input, Eigen::Index most_rows);

  Tape tape_;
  Tape::Workspace workspace_;
  Eigen::MatrixXd values_;
  bool reads_time_;
};

}  // namespace dmocbench
