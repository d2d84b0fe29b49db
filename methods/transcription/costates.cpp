#include "methods/transcription/costates.hpp"

#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/motion_constraints.hpp"
#include "methods/numerics/dense_solve.hpp"
#include "methods/transcription/derivatives/point_derivatives.hpp"

namespace dmocbench {

namespace {

/// The multipliers of the local rows of interval k, in the order of `ProgramBlocks::row_places`, for the true cost.
Eigen::VectorXd local_multipliers(const Transcription& transcription, const Eigen::VectorXd& multipliers,
                                  Eigen::Index k) {
  const std::vector<SeriesPlace>& places = transcription.blocks().row_places();
  Eigen::VectorXd local(static_cast<Eigen::Index>(places.size()));
  for (Eigen::Index r = 0; r < local.size(); ++r) local[r] = multipliers[index_of(places, r, k)];
  return local / transcription.cost_scale();
}

/// The costates of the stages of an interval that follow from its multipliers, one column per stage: Ψ^p_i, and w_i
/// (DMOC, Hamiltonian) or -α_i/(h b_i) (tangent-space).
struct StageMultipliers {
  Eigen::MatrixXd psi_p;  ///< n × s
  Eigen::MatrixXd other;  ///< n × s
};

/// Multipliers of DMOC as a variation of the motion: δq_k, δq_{k+1}, then h b_j δQ̇_j for j < s.
StageMultipliers as_variation(const Eigen::VectorXd& local, const Tableau& tableau, Eigen::Index n, double h) {
  const Eigen::Index last = tableau.stages() - 1;
  const Eigen::VectorXd left = local.head(n);
  Eigen::MatrixXd rates(n, last + 1);
  rates.col(last) = (local.segment(n, n) - left) / h;
  for (Eigen::Index j = 0; j < last; ++j) {
    rates.col(j) = local.segment((2 + j) * n, n) / (h * tableau.b[j]);
    rates.col(last) -= tableau.b[j] * rates.col(j);
  }
  rates.col(last) /= tableau.b[last];
  // lazyProduct: the blocked product costs seconds of compile time and pays off only for large matrices.
  return {(h * rates).lazyProduct(tableau.a.transpose()).colwise() + left, rates};
}

/// Multipliers of collocation: α_i, then β_i for every stage.
StageMultipliers as_pairs(const Eigen::VectorXd& local, const Tableau& tableau, Eigen::Index n, double h) {
  StageMultipliers result{Eigen::MatrixXd(n, tableau.stages()), Eigen::MatrixXd(n, tableau.stages())};
  for (Eigen::Index i = 0; i < tableau.stages(); ++i) {
    result.other.col(i) = -local.segment(2 * i * n, n) / (h * tableau.b[i]);
    result.psi_p.col(i) = -local.segment((2 * i + 1) * n, n) / (h * tableau.b[i]);
  }
  return result;
}

}  // namespace

Costates costates(Transcription& transcription, const Eigen::VectorXd& primal, const Eigen::VectorXd& multipliers,
                  const Eigen::MatrixXd& v) {
  const ProgramBlocks& blocks = transcription.blocks();
  const auto intervals = static_cast<Eigen::Index>(blocks.intervals());
  const Eigen::Index n = transcription.traced_problem().configuration_size();
  const bool has_second = transcription.node_state() != NodeState::configuration;
  const Eigen::Index l = transcription.traced_problem().first_order_size();
  const Eigen::Index node_size = (has_second ? 2 * n : n) + l;

  const Eigen::MatrixXd adjoint =
      transcription.tabulate(transcription.functions().adjoint, primal, multipliers);  // N × 2 node_size
  Eigen::MatrixXd at_nodes(intervals + 1, node_size);
  at_nodes.topRows(intervals) = adjoint.leftCols(node_size);
  at_nodes.row(intervals) = -adjoint.row(intervals - 1).rightCols(node_size);
  at_nodes /= transcription.cost_scale();

  Costates result{at_nodes.leftCols(n), Eigen::MatrixXd(intervals + 1, n), at_nodes.rightCols(l)};
  if (!has_second) {
    result.psi_p =
        blocks.row(Equation::euler_lagrange).columns(multipliers, intervals + 1) / transcription.cost_scale();
    return result;
  }
  result.psi_p = at_nodes.middleCols(n, n);
  if (transcription.node_state() == NodeState::momentum) return result;
  LegendreTransform legendre(transcription.traced_problem());
  const Eigen::VectorXd times = transcription.node_times(primal);
  // Entry k of the series of a block of the nodes.
  const auto series = [&](Quantity kind, Eigen::Index k) {
    const UnknownBlock& block = blocks.unknown(kind);
    return Eigen::VectorXd(primal(Eigen::seqN(block.index() + k, block.width, intervals + 1)));
  };
  for (Eigen::Index k = 0; k <= intervals; ++k) {
    const MotionPoint node{
        series(Quantity::configuration, k), v.row(k).transpose(), {}, series(Quantity::first_order, k)};
    const auto values = legendre.at(node.q, node.v, times[k], node.y);
    const Eigen::VectorXd psi_p = solve_square(values.mass, Eigen::VectorXd(result.psi_p.row(k).transpose()));
    result.psi_p.row(k) = psi_p.transpose();
    result.psi_q.row(k) -= (values.by_configuration.transpose() * psi_p).transpose();
    if (l > 0) result.psi_y.row(k) -= (values.by_first_order.transpose() * psi_p).transpose();
  }
  return result;
}

void move_to_projected_momenta(const TracedProblem& problem, const Eigen::MatrixXd& gaps, const Trajectory& trajectory,
                               Costates& psi) {
  MotionConstraints constraints(problem);
  LegendreTransform legendre(problem);
  const Eigen::Index c = constraints.count();
  for (Eigen::Index k = 0; k < gaps.rows(); ++k) {
    const MotionPoint node = trajectory.node(k);
    const double t = trajectory.node_times[k];
    constraints.evaluate(node.q);
    const Eigen::MatrixXd jacobian = constraints.jacobian();
    const Eigen::MatrixXd gram = jacobian * jacobian.transpose();
    Eigen::VectorXd psi_q = psi.psi_q.row(k).transpose();
    Eigen::VectorXd psi_p = psi.psi_p.row(k).transpose();
    // V(q, p) = V(q, p + G(q)'mu): at p + G'mu, its derivative by q at fixed p has one of G'mu besides.
    const Eigen::VectorXd mu = solve_square(gram, Eigen::VectorXd(jacobian * gaps.row(k).transpose()));
    psi_q += constraints.force_by_configuration(mu).transpose() * psi_p;
    // The gradients of G H_p, D by q and G L_vv⁻¹ by p, and the gradients of g vanish along motions.
    const Eigen::VectorXd normal = jacobian * psi_p;
    const auto values = legendre.at(node.q, node.v, t, node.y);
    if (is_invertible(values.mass)) {
      const Eigen::MatrixXd by_p = solve_square(values.mass, Eigen::MatrixXd(jacobian.transpose()));  // L_vv⁻¹ Gᵀ
      Eigen::MatrixXd by_q = -by_p.transpose() * values.by_configuration;
      for (Eigen::Index a = 0; a < c; ++a) {
        by_q.row(a) += node.v.transpose() * constraints.force_by_configuration(Eigen::VectorXd::Unit(c, a));
      }
      const Eigen::VectorXd beta = solve_square(Eigen::MatrixXd(jacobian * by_p), normal);
      psi_p -= by_p * beta;
      psi_q -= by_q.transpose() * beta;
    }
    const auto of_g = jacobian.topRows(constraints.holonomic_count());
    psi_q -= of_g.transpose() * solve_square(Eigen::MatrixXd(of_g * of_g.transpose()), Eigen::VectorXd(of_g * psi_q));
    psi.psi_q.row(k) = psi_q.transpose();
    psi.psi_p.row(k) = psi_p.transpose();
  }
}

StageCostates stage_costates(const Transcription& transcription, const Eigen::VectorXd& multipliers,
                             const Trajectory& trajectory) {
  const Tableau& tableau = transcription.tableau();
  const Eigen::Index n = trajectory.stage_q.cols();
  const Eigen::Index s = tableau.stages();
  const NodeState family = transcription.node_state();
  const double horizon = trajectory.node_times[trajectory.intervals()];
  const Eigen::Index l = trajectory.stage_y.cols();
  PointDerivatives at_stage(transcription.traced_problem(), trajectory.integral_prices);
  StageCostates result{Eigen::MatrixXd(trajectory.stage_q.rows(), n), Eigen::MatrixXd(trajectory.stage_q.rows(), n),
                       Eigen::MatrixXd(trajectory.stage_q.rows(), l)};
  const ProgramBlocks& blocks = transcription.blocks();
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    const double h = horizon * transcription.grid().relative_widths()[k];
    const Eigen::VectorXd local = local_multipliers(transcription, multipliers, k);
    const StageMultipliers stages =
        family == NodeState::configuration ? as_variation(local, tableau, n, h) : as_pairs(local, tableau, n, h);
    for (Eigen::Index i = 0; i < s; ++i) {
      const Eigen::Index row = k * s + i;
      const RowBlock& first_order = blocks.row(Equation::first_order, i);
      const double weight = tableau.b[i] * (family == NodeState::configuration ? 1.0 : h);
      Eigen::VectorXd psi_y(l);
      for (Eigen::Index j = 0; j < l; ++j) {
        psi_y[j] = multipliers[first_order.index(j) + k] / transcription.cost_scale() / -weight;
      }
      at_stage.evaluate(trajectory.stage(row), trajectory.stage_times[row]);
      const Eigen::VectorXd psi_p = stages.psi_p.col(i);
      const Eigen::VectorXd other = stages.other.col(i);
      Eigen::VectorXd psi_q;
      if (family == NodeState::velocity) {
        psi_q = other - at_stage.momentum_by_configuration().transpose() * psi_p;
      } else {
        psi_q = -(at_stage.cost_by_velocity() + at_stage.force_by_velocity().transpose() * psi_p +
                  at_stage.mass() * other + at_stage.rates_by_velocity().transpose() * psi_y);
      }
      result.psi_y.row(row) = psi_y.transpose();
      result.psi_p.row(row) = psi_p.transpose();
      result.psi_q.row(row) = psi_q.transpose();
    }
  }
  return result;
}

}  // namespace dmocbench
