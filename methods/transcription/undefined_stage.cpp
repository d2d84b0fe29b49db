#include "methods/transcription/undefined_stage.hpp"

#include <fmt/format.h>

namespace dmocbench {

std::string undefined_stage(const Problem& problem, Transcription& transcription, const Eigen::VectorXd& x,
                            FormulaCheck::Derivatives up_to) {
  const Eigen::Index n = problem.configuration_size();
  const Eigen::Index m = problem.control_size();
  const Eigen::Index l = problem.first_order_size();
  const Eigen::Index width = 2 * n + 1 + m + 2 * l;
  const Eigen::MatrixXd stages = transcription.tabulate(transcription.functions().stages, x);
  FormulaCheck check(problem, up_to);
  for (Eigen::Index k = 0; k < stages.rows(); ++k) {
    for (Eigen::Index i = 0; i < transcription.layout().stages(); ++i) {
      const auto stage = stages.row(k).segment(i * width, width);
      const MotionPoint point{.q = stage.head(n),
                              .v = stage.segment(n, n),
                              .u = stage.segment(2 * n + 1, m),
                              .y = stage.segment(2 * n + 1 + m, l)};
      const std::string quantity = check.undefined_at(point, stage[2 * n]);
      if (!quantity.empty())
        return fmt::format("{} is not a number in interval {} (t = {:g})", quantity, k, stage[2 * n]);
    }
  }
  return "";
}

}  // namespace dmocbench
