#pragma once

#include <Eigen/Core>

#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench::tests {

/// The vector of another method's program that stands for the same discrete motion: q, rates Q̇_j and controls as they
/// are, p or v as nodes carry them, rates Ṗ_j = L_q + f (or V̇_j = L_vv⁻¹(L_q + f), for constant L_vv) at the stages.
inline Eigen::VectorXd pack(const Transcription& target, const Trajectory& motion) {
  const ProgramBlocks& blocks = target.blocks();
  const TracedProblem& problem = target.traced_problem();
  const Eigen::Index n = problem.configuration_size();
  const Eigen::Index s = motion.stages();
  PointFunction force(n, problem.control_size(),
                      [&](const ControlledState& x) { return problem.at(x).generalised_force; });
  Eigen::VectorXd x(static_cast<Eigen::Index>(target.variable_count()));
  const auto set = [&](std::size_t column, Eigen::Index k, double value) {
    x[static_cast<Eigen::Index>(column) + k] = value;
  };
  const bool has_second = target.node_state() != NodeState::configuration;
  const Eigen::MatrixXd& second = target.node_state() == NodeState::momentum ? motion.p : motion.v;
  for (Eigen::Index k = 0; k <= motion.intervals(); ++k) {
    for (Eigen::Index i = 0; i < n; ++i) {
      set(blocks.unknown(Quantity::configuration).at(i), k, motion.q(k, i));
      if (has_second) set(blocks.unknown(Quantity::second).at(i), k, second(k, i));
    }
  }
  Eigen::VectorXd rate(n);
  for (Eigen::Index k = 0; k < motion.intervals(); ++k) {
    for (Eigen::Index j = 0; j < s; ++j) {
      const Eigen::Index row = k * s + j;
      for (Eigen::Index i = 0; i < problem.control_size(); ++i) {
        set(blocks.unknown(Quantity::control, j).at(i), k, motion.stage_u(row, i));
      }
      if (j + 1 == s) continue;
      force.evaluate(motion.stage_q.row(row).transpose(), motion.stage_v.row(row).transpose(),
                     motion.stage_u.row(row).transpose(), motion.stage_times[row], rate);
      for (Eigen::Index i = 0; i < n; ++i) {
        set(blocks.unknown(Quantity::rate, j).at(i), k, motion.stage_v(row, i));
        if (has_second) set(blocks.unknown(Quantity::second_rate, j).at(i), k, rate[i]);
      }
    }
  }
  return x;
}

}  // namespace dmocbench::tests
