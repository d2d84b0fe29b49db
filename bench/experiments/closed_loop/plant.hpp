#pragma once

#include <memory>
#include <optional>

#include <Eigen/Core>

#include "methods/diagnostics/driven_motion.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// The system of a problem as a controller meets it: an exact motion under the controls of plans and under
/// disturbances, further forces on the coordinates.
class Plant {
 public:
  /// The problem must outlive it.
  explicit Plant(const Problem& problem);
  ~Plant();
  Plant(const Plant&) = delete;
  Plant& operator=(const Plant&) = delete;

  /// At the initial state of the problem.
  void begin();
  /// Follows a plan from time `from` to `to`, times of the plan, under a constant disturbance, n entries. Throws
  /// `Error` as `DrivenMotion::carry`.
  void follow(const Trajectory& plan, double from, double to, const Eigen::VectorXd& disturbance);

  /// (q, v) now.
  [[nodiscard]] BoundaryState state() const;
  /// The cost of a motion that ends now, at time t.
  [[nodiscard]] double cost(double t);
  /// The largest violation of a bound or path constraint so far, at nodes of plans and ends of samples: as a share of
  /// the distance of both bounds, or in its own unit where there is only one.
  [[nodiscard]] double violation() const noexcept { return violation_; }
  /// Whether the problem has a symmetry.
  [[nodiscard]] bool has_momentum() const noexcept { return momentum_.has_value(); }
  /// p·ξ(q) at a state, of a problem that has one.
  [[nodiscard]] double momentum(const BoundaryState& state);

 private:
  class Disturbed;
  void note_violation(const Eigen::VectorXd& u, double t);

  const Problem& problem_;
  ProblemBounds bounds_;
  std::unique_ptr<Disturbed> disturbed_;
  DrivenMotion motion_;
  PointFunction path_constraints_;
  std::optional<PointFunction> momentum_;
  double violation_ = 0.0;
};

}  // namespace dmocbench
