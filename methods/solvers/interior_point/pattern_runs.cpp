#include "methods/solvers/interior_point/pattern_runs.hpp"

namespace dmocbench::interior_point {

std::vector<PatternRun> pattern_runs(const SparsityPattern& pattern) {
  std::vector<PatternRun> runs;
  for (std::size_t e = 0; e < pattern.size(); ++e) {
    const Eigen::Index row = pattern.rows[e];
    const Eigen::Index column = pattern.columns[e];
    if (!runs.empty()) {
      PatternRun& run = runs.back();
      const Eigen::Index row_step = row - (run.row + (run.length - 1) * run.row_step);
      const Eigen::Index column_step = column - (run.column + (run.length - 1) * run.column_step);
      const bool is_step = row_step >= 0 && row_step <= 1 && column_step >= 0 && column_step <= 1;
      const bool goes_on = run.length == 1 || (row_step == run.row_step && column_step == run.column_step);
      if (is_step && goes_on) {
        run.row_step = row_step;
        run.column_step = column_step;
        ++run.length;
        continue;
      }
    }
    runs.push_back({static_cast<Eigen::Index>(e), row, column, 0, 0, 1});
  }
  return runs;
}

void add_transposed_product(const std::vector<PatternRun>& runs, const Eigen::VectorXd& values,
                            const Eigen::VectorXd& multipliers, Eigen::VectorXd& result) {
  for (const PatternRun& run : runs) {
    const auto entries = values.segment(run.entry, run.length);
    if (run.row_step == 0) {
      result.segment(run.column, run.column_step == 0 ? 1 : run.length) += multipliers[run.row] * entries;
    } else if (run.column_step == 0) {
      result[run.column] += entries.dot(multipliers.segment(run.row, run.length));
    } else {
      result.segment(run.column, run.length) += entries.cwiseProduct(multipliers.segment(run.row, run.length));
    }
  }
}

}  // namespace dmocbench::interior_point
