#pragma once

#include <memory>

#include <Eigen/Core>

#include "methods/extensions/step_control/extended_action.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/derivatives/program_part.hpp"
#include "methods/transcription/derivatives/series_assembly.hpp"
#include "methods/transcription/motions/interpolation.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// DMOC with step sizes that are tied to the motion by a constraint of the principle (`ExtendedAction`), as a nonlinear
/// program.
///
/// Unknowns: q_k and t_k of the nodes; Q̇_j, U_i and λ_k of the intervals; the pace Δτ. Equations, with
/// ∂_x = ∂(A + λ c)/∂x + W[x]: at the nodes the sums of ∂_{q_k} and of ∂_{t_k} over the two intervals next to them
/// vanish; in every interval ∂_{Q̇_j} = 0 and c = t_{k+1} - t_k - Δτ σ_k = 0. The ends fix q, t and p = L_v, and the
/// momentum of time begins as minus the energy of the first end; t_N = T fixes the pace. The problem has fixed ends, a
/// fixed horizon and no constraints.
class StepControlProgram final : public NonlinearProgram {
 public:
  /// Throws `Error` if the problem has bounds, constraints, free ends or a free horizon.
  StepControlProgram(const Problem& problem, Tableau tableau, StepFunction sigma, std::size_t intervals);

  [[nodiscard]] std::size_t variable_count() const override { return structure_.unknowns.size(); }
  [[nodiscard]] std::size_t constraint_count() const override { return structure_.rows.size(); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return variables_.lower; }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return variables_.upper; }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return rows_.lower; }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return rows_.upper; }
  [[nodiscard]] const BlockPattern& jacobian_structure() const override { return jacobian_.pattern; }
  [[nodiscard]] const BlockPattern& hessian_structure() const override { return hessian_.pattern; }
  [[nodiscard]] double objective(const VectorIn& x) override { return part_->cost(x); }
  void gradient(const VectorIn& x, VectorOut result) override { part_->gradient(x, result); }
  void constraints(const VectorIn& x, VectorOut result) override { part_->rows(x, result); }
  void jacobian(const VectorIn& x, VectorOut values) override { part_->jacobian(x, values); }
  void hessian(const VectorIn& x, double factor, const VectorIn& multipliers, VectorOut values) override {
    part_->hessian(x, factor, multipliers, values);
  }
  [[nodiscard]] const IntervalStructure* interval_structure() const override { return &structure_; }

  /// The unknowns sampled from a motion, at nodes that divide it into steps proportional to σ; λ = 0. Throws `Error` if
  /// σ is not positive along it.
  [[nodiscard]] Eigen::VectorXd start(const Motion& motion) const;
  /// The discrete motion of a point, without costates. Throws `Error` if its size is wrong.
  [[nodiscard]] Trajectory read(const Eigen::VectorXd& x);
  /// Δτ of a point.
  [[nodiscard]] double pace(const Eigen::VectorXd& x) const { return x[static_cast<Eigen::Index>(columns_.pace)]; }

 private:
  /// Heads of series.
  struct Columns {
    std::size_t q = 0, t = 0, rates = 0, controls = 0, multiplier = 0, pace = 0;
    std::size_t momentum_rows = 0, energy_rows = 0, rate_rows = 0, step_rows = 0;
  };
  /// The unknowns of an interval as traced inputs.
  struct TracedUnknowns;

  void place();
  void trace();
  void fix_ends();
  [[nodiscard]] TracedUnknowns take_unknowns() const;
  [[nodiscard]] std::vector<SeriesPlace> places_of_local_rows() const;
  void assemble(const LocalFunctions& functions, const std::vector<SeriesPlace>& unknowns,
                const std::vector<SeriesPlace>& rows);
  [[nodiscard]] static Eigen::Index head(std::size_t column, Eigen::Index i, Eigen::Index length) {
    return static_cast<Eigen::Index>(column) + i * length;
  }

  const Problem& problem_;
  TracedProblem traced_;
  Tableau tableau_;
  StepFunction sigma_;
  Eigen::Index n_, m_, intervals_;
  Columns columns_;
  IntervalStructure structure_;
  Bounds variables_, rows_;
  AssembledPattern jacobian_, hessian_;
  Schedule reading_;        // -∂_{q_k}, ∂_{q_{k+1}}, then Q_i, Q̇_i, T_i of every stage
  Eigen::VectorXd unread_;  // steps and times, which no formula reads: both are unknowns
  std::unique_ptr<ProgramPart> part_;
};

}  // namespace dmocbench
