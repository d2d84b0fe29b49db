#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/program/lane_program.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// Eight instances of a transcription side by side, by its exact derivatives: the tapes of one interval run over the
/// intervals of all eight, interval k of lanes 0 to 7 being neighbours.
class LaneTranscription final : public LaneProgram {
 public:
  /// The program must outlive it; its values are read in this call only. Throws `Error` where the horizon is free.
  explicit LaneTranscription(const Transcription& program);
  ~LaneTranscription() override;
  LaneTranscription(const LaneTranscription&) = delete;
  LaneTranscription& operator=(const LaneTranscription&) = delete;

  /// All parameters of the problem, if the transcription keeps some of them open; else 0.
  [[nodiscard]] std::size_t parameter_count() const override;
  /// In the order of `Problem::parameters`; none for those that the program had at first. Sets the horizon, too. Throws
  /// `Error` if a parameter that is not open, or a bound, would be another one.
  void set_parameters(std::size_t lane, std::span<const double> values) override;
  void objective(const double* x, double* result) override;
  void gradient(const double* x, double* result) override;
  void constraints(const double* x, double* result) override;
  void jacobian(const double* x, double* values) override;
  void hessian(const double* x, const double* multipliers, double* values) override;

 private:
  struct Part;
  [[nodiscard]] double checked_horizon(const Eigen::VectorXd& parameters) const;

  const Transcription& program_;
  Eigen::VectorXd usual_parameters_;

  Eigen::Index variables_;
  Eigen::Index rows_;
  Eigen::Index jacobian_entries_;
  Eigen::Index hessian_entries_;
  Eigen::VectorXd steps_;  // of every interval and lane
  Eigen::VectorXd times_;
  std::vector<std::unique_ptr<Part>> parts_;  // the intervals; the ends, unless they add nothing
};

/// Makes the lanes of a transcription, which must outlive the result.
[[nodiscard]] MakeLanes lanes_of(const Transcription& program);

/// Gives a transcription the parameters of an instance, or those that it has now where the instance has none:
/// `BatchOptions::set_parameters`. The program must outlive the result.
[[nodiscard]] std::function<void(const Eigen::VectorXd&)> parameters_of(Transcription& program);

/// Writes states of the ends into the numbers of an instance: a clamped end fixes q and, where nodes carry it, p or v;
/// for DMOC the momentum of the end is the value of its row, (eq:gDLOCP3).
class ClampedEnds {
 public:
  /// The program must outlive it; momenta are those for the parameters that it has now. Throws `Error` unless both ends
  /// are clamped.
  explicit ClampedEnds(const Transcription& program);

  /// `x`: the unknowns of a start, variable_count() entries; `equality_values`: the values that equalities have,
  /// constraint_count() entries, of which the ends' are written. The configurations between are moved with the
  /// ends, linearly in time: q_k += (1 - t_k/T) δq_0 + (t_k/T) δq_N, as the default guess of a problem would be.
  void write(const BoundaryState& first, const BoundaryState& last, Eigen::VectorXd& x,
             Eigen::VectorXd& equality_values);

 private:
  void write_end(const BoundaryState& end, std::size_t node, double time, double sign, Eigen::VectorXd& x,
                 Eigen::VectorXd& equality_values);

  const Transcription& program_;
  LegendreTransform legendre_;
};

}  // namespace dmocbench
