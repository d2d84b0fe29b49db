#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "methods/expression/tape.hpp"

namespace dmocbench {

/// The outputs of a schedule for all intervals, as a table: row k for interval k, one column per output. For what is
/// computed once after a solve; evaluations inside a solve use `AssembledTape`.
[[nodiscard]] inline Eigen::MatrixXd evaluate_columns(const Schedule& schedule, std::size_t intervals,
                                                      std::span<const Tape::Input> inputs) {
  const Tape tape(schedule);
  Tape::Workspace workspace(tape);
  Eigen::MatrixXd table(static_cast<Eigen::Index>(intervals), static_cast<Eigen::Index>(tape.output_count()));
  std::vector<double*> outputs;
  for (Eigen::Index j = 0; j < table.cols(); ++j) outputs.push_back(table.col(j).data());
  tape.evaluate(intervals, inputs, outputs, workspace);
  return table;
}

}  // namespace dmocbench
