#include "methods/solvers/interior_point/pattern_runs.hpp"

namespace dmocbench::interior_point {

std::vector<PatternRun> pattern_runs(const SparsityPattern& pattern) {
  std::vector<PatternRun> runs;
  const std::vector<int>& rows = pattern.rows;
  const std::vector<int>& columns = pattern.columns;
  const auto is_step = [](int step) { return step == 0 || step == 1; };
  for (std::size_t begin = 0; begin < pattern.size();) {
    std::size_t end = begin + 1;
    int row_step = 0;
    int column_step = 0;
    if (end < pattern.size() && is_step(rows[end] - rows[begin]) && is_step(columns[end] - columns[begin])) {
      row_step = rows[end] - rows[begin];
      column_step = columns[end] - columns[begin];
      while (end < pattern.size() && rows[end] == rows[end - 1] + row_step &&
             columns[end] == columns[end - 1] + column_step) {
        ++end;
      }
    }
    runs.push_back({static_cast<Eigen::Index>(begin), rows[begin], columns[begin], row_step, column_step,
                    static_cast<Eigen::Index>(end - begin)});
    begin = end;
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
