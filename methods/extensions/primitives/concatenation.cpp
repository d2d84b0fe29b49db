#include "methods/extensions/primitives/concatenation.hpp"

#include "methods/error.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/motions/grid.hpp"

namespace dmocbench {

namespace {

/// Rows x of a table moved by x ↦ A x.
Eigen::MatrixXd turned(const Displacement& moved, const Eigen::MatrixXd& rows) {
  return rows * moved.linear.transpose();
}

/// Times, nodes and controls of the path.
Trajectory motion_along(const PrimitiveLibrary& library, const Roadmap& roadmap, const RoadmapPath& path) {
  const Eigen::Index intervals = Eigen::Index{path.duration} * library.intervals_per_step;
  const Primitive& any = library.primitives.front();
  Trajectory motion;
  motion.tableau = gauss_tableau(1);
  motion.node_times = library.step * path.duration * Grid::uniform(intervals).relative_times();
  motion.q.resize(intervals + 1, any.q.cols());
  motion.v.resize(intervals + 1, any.q.cols());
  motion.stage_u.resize(intervals, any.u.cols());
  Eigen::Index begin = 0;
  for (const std::size_t number : path.edges) {
    const RoadmapEdge& edge = roadmap.edges()[number];
    const Primitive& primitive = library.primitives[edge.primitive];
    const Displacement& moved = roadmap.nodes()[edge.from].moved;
    const Eigen::Index count = primitive.u.rows();
    motion.q.middleRows(begin, count + 1) = turned(moved, primitive.q).rowwise() + moved.shift.transpose();
    motion.v.middleRows(begin, count + 1) = turned(moved, primitive.v);
    motion.stage_u.middleRows(begin, count) = primitive.u;
    begin += count;
  }
  motion.cost = path.cost;
  return motion;
}

}  // namespace

Trajectory concatenate(const Problem& problem, const PrimitiveLibrary& library, const Roadmap& roadmap,
                       const RoadmapPath& path) {
  if (path.edges.empty()) throw Error("a path without edges is not a motion; choose a goal other than the start");
  Trajectory motion = motion_along(library, roadmap, path);
  const Eigen::Index intervals = motion.intervals();
  const Eigen::VectorXd first_times = motion.node_times.head(intervals);
  const Eigen::VectorXd steps = motion.node_times.tail(intervals) - first_times;
  motion.stage_times = first_times + 0.5 * steps;
  motion.stage_q = 0.5 * (motion.q.topRows(intervals) + motion.q.bottomRows(intervals));
  motion.stage_v = steps.cwiseInverse().asDiagonal() * (motion.q.bottomRows(intervals) - motion.q.topRows(intervals));
  const TracedProblem traced(problem);
  LegendreTransform legendre(traced);
  motion.p.resizeLike(motion.q);
  for (Eigen::Index k = 0; k <= intervals; ++k) {
    motion.p.row(k) = legendre.momentum(motion.node(k).q, motion.node(k).v, motion.node_times[k]).transpose();
  }
  motion.stage_p.resizeLike(motion.stage_q);
  for (Eigen::Index k = 0; k < intervals; ++k) {
    const MotionPoint stage = motion.stage(k);
    motion.stage_p.row(k) = legendre.momentum(stage.q, stage.v, motion.stage_times[k]).transpose();
  }
  return motion;
}

}  // namespace dmocbench
