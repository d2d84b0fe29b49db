#include "methods/transcription/costates.hpp"

#include "methods/mechanics/legendre_transform.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/transcription/columns.hpp"

namespace dmocbench {

Costates costates(Transcription& transcription, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers,
                  const Eigen::MatrixXd& v) {
  const Layout& layout = transcription.layout();
  const auto intervals = static_cast<Eigen::Index>(layout.intervals());
  const Eigen::Index n = transcription.traced_problem().configuration_size();
  const bool has_second = layout.node_state() != NodeState::configuration;
  const Eigen::Index node_size = has_second ? 2 * n : n;

  const Eigen::MatrixXd adjoint = evaluate_columns(transcription.functions().node_adjoint, layout.intervals(),
                                                   transcription.bind(primal, multipliers, 1.0));  // N × 2 node_size
  Eigen::MatrixXd at_nodes(intervals + 1, node_size);
  at_nodes.topRows(intervals) = adjoint.leftCols(node_size);
  at_nodes.row(intervals) = -adjoint.row(intervals - 1).rightCols(node_size);
  at_nodes /= transcription.cost_scale();

  Costates result{at_nodes.leftCols(n), Eigen::MatrixXd(intervals + 1, n)};
  if (!has_second) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto head = static_cast<Eigen::Index>(layout.node_row_column(i));
      result.psi_p.col(i) = multipliers.segment(head, intervals + 1) / transcription.cost_scale();
    }
    return result;
  }
  result.psi_p = at_nodes.rightCols(n);
  if (layout.node_state() == NodeState::momentum) return result;
  LegendreTransform legendre(transcription.traced_problem());
  const Eigen::VectorXd times = transcription.node_times(primal);
  for (Eigen::Index k = 0; k <= intervals; ++k) {
    Eigen::VectorXd q(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      q[i] = primal[static_cast<Eigen::Index>(layout.configuration_column(i)) + k];
    }
    const Eigen::VectorXd velocity = v.row(k).transpose();
    const double t = times[k];
    const Eigen::VectorXd psi_p =
        solve_square(legendre.mass(q, velocity, t), Eigen::VectorXd(result.psi_p.row(k).transpose()));
    result.psi_p.row(k) = psi_p.transpose();
    result.psi_q.row(k) -= (legendre.momentum_by_configuration(q, velocity, t).transpose() * psi_p).transpose();
  }
  return result;
}

}  // namespace dmocbench
