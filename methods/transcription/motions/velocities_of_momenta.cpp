#include "methods/transcription/motions/velocities_of_momenta.hpp"

#include <algorithm>

#include "methods/mechanics/legendre_transform.hpp"

namespace dmocbench {

void add_velocities(const TracedProblem& problem, Trajectory& trajectory) {
  LegendreTransform legendre(problem);
  trajectory.stage_p.resizeLike(trajectory.stage_q);
  for (Eigen::Index i = 0; i < trajectory.stage_p.rows(); ++i) {
    const MotionPoint stage = trajectory.stage(i);
    trajectory.stage_p.row(i) = legendre.momentum(stage.q, stage.v, trajectory.stage_times[i], stage.y).transpose();
  }
  trajectory.v.resizeLike(trajectory.q);
  for (Eigen::Index k = 0; k < trajectory.v.rows(); ++k) {
    const Eigen::Index nearby = std::min(k * trajectory.stages(), trajectory.stage_v.rows() - 1);
    trajectory.v.row(k) =
        legendre
            .velocity(trajectory.q.row(k).transpose(), trajectory.p.row(k).transpose(), trajectory.node_times[k],
                      trajectory.stage_v.row(nearby).transpose(), Trajectory::row_of(trajectory.y, k))
            .transpose();
    if (problem.holonomic_count() == 0) continue;
    const MotionPoint node = trajectory.node(k);
    trajectory.p.row(k) = legendre.momentum(node.q, node.v, trajectory.node_times[k], node.y).transpose();
  }
}

}  // namespace dmocbench
