#include "methods/transcription/stage_costates.hpp"

#include "methods/expression/derivatives.hpp"
#include "methods/mechanics/point_function.hpp"

namespace dmocbench {

namespace {

/// C_v, F_v, L_vv and L_vq at the stages, F = L_q + f.
class StageDerivatives {
 public:
  explicit StageDerivatives(const TracedProblem& problem)
      : n_(problem.configuration_size()),
        function_(n_, problem.control_size(),
                  [&](const ControlledState& x) {
                    const TracedProblem::Values values = problem.at(x);
                    ExpressionVector outputs(n_ + 3 * n_ * n_);
                    outputs << gradient(values.running_cost, x.v), jacobian(values.generalised_force, x.v).reshaped(),
                        values.mass.reshaped(), values.momentum_by_configuration.reshaped();
                    return outputs;
                  }),
        values_(function_.output_count()) {}

  void evaluate(const Trajectory& trajectory, Eigen::Index stage) {
    function_.evaluate(trajectory.stage_q.row(stage).transpose(), trajectory.stage_v.row(stage).transpose(),
                       trajectory.stage_u.row(stage).transpose(), trajectory.stage_times[stage], values_);
  }
  [[nodiscard]] Eigen::VectorXd cost_by_velocity() const { return values_.head(n_); }
  [[nodiscard]] Eigen::MatrixXd force_by_velocity() const { return matrix(0); }
  [[nodiscard]] Eigen::MatrixXd mass() const { return matrix(1); }
  [[nodiscard]] Eigen::MatrixXd momentum_by_configuration() const { return matrix(2); }

 private:
  [[nodiscard]] Eigen::MatrixXd matrix(Eigen::Index which) const {
    return values_.segment(n_ + which * n_ * n_, n_ * n_).reshaped(n_, n_);
  }

  Eigen::Index n_;
  PointFunction function_;
  Eigen::VectorXd values_;
};

/// The multipliers of the local rows of interval k, in the order of `Layout::row_places`, for the true cost.
Eigen::VectorXd local_multipliers(const Transcription& transcription, const Eigen::VectorXd& multipliers,
                                  Eigen::Index k) {
  const std::vector<ColumnPlace>& places = transcription.layout().row_places();
  Eigen::VectorXd local(static_cast<Eigen::Index>(places.size()));
  for (std::size_t r = 0; r < places.size(); ++r) {
    local[static_cast<Eigen::Index>(r)] =
        multipliers[static_cast<Eigen::Index>(places[r].at(static_cast<std::size_t>(k)))];
  }
  return local / transcription.cost_scale();
}

/// What an interval's multipliers say of its stages, one column each: Ψ^p_i, and w_i (DMOC, Hamiltonian) or
/// -α_i/(h b_i) (tangent-space).
struct StageMultipliers {
  Eigen::MatrixXd psi_p;  ///< n × s
  Eigen::MatrixXd other;  ///< n × s
};

/// Multipliers of DMOC as a variation of the motion: δq_k, δq_{k+1}, then h b_j δQ̇_j for j < s.
StageMultipliers as_variation(const Eigen::VectorXd& local, const Tableau& tableau, Eigen::Index n, double h) {
  const Eigen::Index last = tableau.stages() - 1;
  const Eigen::VectorXd left = local.head(n);
  Eigen::MatrixXd slopes(n, last + 1);
  slopes.col(last) = (local.segment(n, n) - left) / h;
  for (Eigen::Index j = 0; j < last; ++j) {
    slopes.col(j) = local.segment((2 + j) * n, n) / (h * tableau.b[j]);
    slopes.col(last) -= tableau.b[j] * slopes.col(j);
  }
  slopes.col(last) /= tableau.b[last];
  // lazyProduct: the blocked product takes the compiler seconds and pays only where matrices are large.
  return {(h * slopes).lazyProduct(tableau.a.transpose()).colwise() + left, slopes};
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

StageCostates stage_costates(const Transcription& transcription, const Eigen::VectorXd& multipliers,
                             const Trajectory& trajectory) {
  const Tableau& tableau = transcription.tableau();
  const Eigen::Index n = trajectory.stage_q.cols();
  const Eigen::Index s = tableau.stages();
  const NodeState family = transcription.layout().node_state();
  const double horizon = trajectory.node_times[trajectory.intervals()];
  StageDerivatives at_stage(transcription.traced_problem());
  StageCostates result{Eigen::MatrixXd(trajectory.stage_q.rows(), n), Eigen::MatrixXd(trajectory.stage_q.rows(), n)};
  for (Eigen::Index k = 0; k < trajectory.intervals(); ++k) {
    const double h = horizon * transcription.grid().relative_widths()[k];
    const Eigen::VectorXd local = local_multipliers(transcription, multipliers, k);
    const StageMultipliers stages =
        family == NodeState::configuration ? as_variation(local, tableau, n, h) : as_pairs(local, tableau, n, h);
    for (Eigen::Index i = 0; i < s; ++i) {
      const Eigen::Index row = k * s + i;
      at_stage.evaluate(trajectory, row);
      const Eigen::VectorXd psi_p = stages.psi_p.col(i);
      const Eigen::VectorXd other = stages.other.col(i);
      Eigen::VectorXd psi_q;
      if (family == NodeState::velocity) {
        psi_q = other - at_stage.momentum_by_configuration().transpose() * psi_p;
      } else {
        psi_q =
            -(at_stage.cost_by_velocity() + at_stage.force_by_velocity().transpose() * psi_p + at_stage.mass() * other);
      }
      result.psi_p.row(row) = psi_p.transpose();
      result.psi_q.row(row) = psi_q.transpose();
    }
  }
  return result;
}

}  // namespace dmocbench
