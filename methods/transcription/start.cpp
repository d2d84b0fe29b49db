#include "methods/transcription/start.hpp"

#include "methods/mechanics/legendre_transform.hpp"

namespace dmocbench {

Eigen::VectorXd sample(Transcription& transcription, const Motion& motion) {
  const Layout& layout = transcription.layout();
  const Tableau& tableau = transcription.tableau();
  const Eigen::VectorXd& times = transcription.node_times();
  const Eigen::Index n = transcription.traced_problem().configuration_size();
  const Eigen::Index m = transcription.traced_problem().control_size();
  LegendreTransform legendre(transcription.traced_problem());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(transcription.variable_count()));
  const auto entry = [&](std::size_t column, Eigen::Index k) -> double& {
    return x[static_cast<Eigen::Index>(column) + k];
  };

  for (Eigen::Index k = 0; k < times.size(); ++k) {
    const MotionPoint point = motion(times[k]);
    Eigen::VectorXd second = point.v;
    if (layout.node_state() == NodeState::momentum) second = legendre.momentum(point.q, point.v, times[k]);
    for (Eigen::Index i = 0; i < n; ++i) {
      entry(layout.configuration_column(i), k) = point.q[i];
      if (layout.node_state() != NodeState::configuration) entry(layout.second_column(i), k) = second[i];
    }
  }
  x = x.cwiseMax(transcription.variable_lower()).cwiseMin(transcription.variable_upper());

  for (Eigen::Index k = 0; k + 1 < times.size(); ++k) {
    const double h = transcription.steps()[k];
    for (Eigen::Index stage = 0; stage < tableau.stages(); ++stage) {
      const MotionPoint point = motion(times[k] + tableau.c[stage] * h);
      for (Eigen::Index i = 0; i < m; ++i) entry(layout.control_column(stage, i), k) = point.u[i];
      if (stage == layout.interior_stages()) continue;
      for (Eigen::Index i = 0; i < n; ++i) {
        entry(layout.slope_q_column(stage, i), k) = point.v[i];
        if (layout.node_state() == NodeState::configuration) continue;
        const std::size_t column = layout.second_column(i);
        entry(layout.slope_y_column(stage, i), k) = (entry(column, k + 1) - entry(column, k)) / h;
      }
    }
  }
  return x;
}

Motion guessed_motion(const Problem& problem) {
  return [&problem](double t) { return problem.guess(t); };
}

}  // namespace dmocbench
