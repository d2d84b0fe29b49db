#include "bench/experiments/smoothness/optimum_error.hpp"

#include <cmath>
#include <utility>

#include "methods/error.hpp"
#include "methods/indirect/control_from_costate.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/transcription/motions/interpolation.hpp"

namespace dmocbench {

namespace {

double largest_row(const Eigen::MatrixXd& difference) { return difference.rowwise().norm().maxCoeff(); }

/// Throws `Error` if the problem has no closed form.
OptimalPoint closed_form_point(const Problem& problem, double t) {
  std::optional<OptimalPoint> point = problem.optimum(t);
  if (!point) throw Error(problem.name() + " states no optimum in closed form");
  return *std::move(point);
}

double closed_form_cost(const Problem& problem) {
  const std::optional<ReferenceOptimum> reference = problem.card().reference;
  if (!reference) throw Error(problem.name() + " does not state the cost of its optimum");
  return reference->objective;
}

}  // namespace

KnownOptimum::KnownOptimum(const Problem& problem, std::optional<Trajectory> finer) : problem_(problem) {
  if (finer) {
    finer_ = std::make_unique<const Trajectory>(*std::move(finer));
    finer_controls_ = minimisers(*finer_);
  } else {
    static_cast<void>(closed_form_point(problem, 0.0));
  }
}

Eigen::MatrixXd KnownOptimum::minimisers(const Trajectory& motion) const {
  Eigen::MatrixXd controls = ControlFromCostate(problem_).at_nodes(motion);
  const Bounds bounds = problem_.bounds().u;
  if (bounds.empty()) return controls;
  for (Eigen::Index k = 0; k < controls.rows(); ++k) {
    controls.row(k) = controls.row(k).cwiseMax(bounds.lower.transpose()).cwiseMin(bounds.upper.transpose());
  }
  return controls;
}

KnownOptimum::Sampled KnownOptimum::closed_form_at(const Trajectory& motion) const {
  LegendreTransform legendre{TracedProblem(problem_)};
  Sampled sampled{motion.q,
                  motion.p,
                  motion.psi_q,
                  motion.psi_p,
                  Eigen::MatrixXd(motion.q.rows(), motion.stage_u.cols()),
                  motion.stage_u,
                  closed_form_cost(problem_)};
  for (Eigen::Index k = 0; k < motion.q.rows(); ++k) {
    const double t = motion.node_times[k];
    const OptimalPoint point = closed_form_point(problem_, t);
    sampled.q.row(k) = point.motion.q.transpose();
    sampled.p.row(k) = legendre.momentum(point.motion.q, point.motion.v, t).transpose();
    sampled.psi_q.row(k) = point.psi_q.transpose();
    sampled.psi_p.row(k) = point.psi_p.transpose();
    sampled.node_u.row(k) = point.motion.u.transpose();
  }
  for (Eigen::Index i = 0; i < motion.stage_u.rows(); ++i) {
    sampled.stage_u.row(i) = closed_form_point(problem_, motion.stage_times[i]).motion.u.transpose();
  }
  return sampled;
}

KnownOptimum::Sampled KnownOptimum::finer_at(const Trajectory& motion) const {
  Sampled sampled{
      motion.q,       motion.p,    motion.psi_q, motion.psi_p, Eigen::MatrixXd(motion.q.rows(), motion.stage_u.cols()),
      motion.stage_u, finer_->cost};
  for (Eigen::Index k = 0; k < motion.q.rows(); ++k) {
    const auto node = node_at(finer_->node_times, motion.node_times[k]);
    if (!node) throw Error("a node of the trajectory is not a node of the reference grid");
    sampled.q.row(k) = finer_->q.row(*node);
    sampled.p.row(k) = finer_->p.row(*node);
    sampled.psi_q.row(k) = finer_->psi_q.row(*node);
    sampled.psi_p.row(k) = finer_->psi_p.row(*node);
    sampled.node_u.row(k) = finer_controls_.row(*node);
  }
  for (Eigen::Index i = 0; i < motion.stage_u.rows(); ++i) {
    sampled.stage_u.row(i) = control_at(*finer_, motion.stage_times[i]).transpose();
  }
  return sampled;
}

OptimumError KnownOptimum::error_of(const Trajectory& motion) const {
  const Sampled optimum = finer_ ? finer_at(motion) : closed_form_at(motion);
  Eigen::MatrixXd state(motion.q.rows(), 2 * motion.q.cols());
  state << motion.q - optimum.q, motion.p - optimum.p;
  return {.state = largest_row(state),
          .costate_q = largest_row(motion.psi_q - optimum.psi_q),
          .costate_p = largest_row(motion.psi_p - optimum.psi_p),
          .node_control = largest_row(minimisers(motion) - optimum.node_u),
          .control = largest_row(motion.stage_u - optimum.stage_u),
          .objective = std::abs(motion.cost - optimum.cost)};
}

}  // namespace dmocbench
