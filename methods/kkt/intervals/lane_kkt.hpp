#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <tl/expected.hpp>

#include "methods/kkt/intervals/elimination_plan.hpp"
#include "methods/kkt/intervals/interval_entries.hpp"
#include "methods/kkt/intervals/segment_group.hpp"
#include "methods/kkt/intervals/terminal_weights.hpp"
#include "methods/kkt/kkt_system.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench::kkt {

/// The KKT systems of eight instances of a program side by side, one whole horizon per lane, for programs whose state
/// is given at both ends. There are no joints: with the state fixed at the first node, and given as d at the last, the
/// value of the horizon is -½νᵀΓν + νᵀ(γ - d), so ν = Γ⁻¹(γ - d), and the inertia is right exactly if all pivots hold
/// and Γ is positive definite.
///
/// All arrays are interleaved (lane_loops.hpp). No lane changes a digit of another.
class LaneKkt {
 public:
  /// The outcome of a lane's system.
  enum class Outcome : std::uint8_t {
    solved,
    wrong_inertia,  ///< the Hessian is not positive definite on the null space of the equalities
    again,          ///< undecided: the same system has to be solved again with other terminal weights
    failed,         ///< singular, or pivots that cannot be trusted: a case for `RefinedKkt`
  };
  using Outcomes = std::array<Outcome, lane_count>;

  /// `usual` is the matrix of any one instance near those that will come: the order of elimination is chosen by it, and
  /// pivots are measured by it. A sentence with the reason instead if the program has another structure.
  using Made = tl::expected<std::unique_ptr<LaneKkt>, std::string>;
  [[nodiscard]] static Made make(const NonlinearProgram& program, const KktMatrix& usual,
                                 SegmentKernelChoice choose = segment_kernel_for);

  /// The arrays of the eight matrices and right-hand sides, see `KktMatrix` and `KktRightHandSide`.
  struct Systems {
    const double* hessian;
    const double* jacobian;
    const double* diagonal;
    const double* compliance;
    const double* gradient;
    const double* constraints;
  };
  using Mask = std::array<bool, lane_count>;
  /// Solves the systems of the `wanted` lanes. Writes the steps of those that are `solved`, and any numbers to the
  /// other lanes of `primal` and `multipliers`. Lanes that are not wanted have no system yet: they are `failed`.
  [[nodiscard]] Outcomes solve(const Systems& systems, const Mask& wanted, double* primal, double* multipliers);

  /// A new instance is in a lane: nothing is known about its terminal weights.
  void forget(std::size_t lane);

  [[nodiscard]] const Shape& shape() const noexcept { return entries_.shape; }

 private:
  LaneKkt(IntervalEntries entries, EliminationPlan plan, SegmentKernelChoice choose);

  [[nodiscard]] NewtonArrays arrays_of(const Systems& systems);
  void rescale_weights(const NewtonArrays& arrays, const Mask& wanted);
  void find_end_multipliers(const double* constraints);
  void factorise_reachability();
  [[nodiscard]] Outcome outcome_of(std::size_t lane);
  void write_ends(double* primal, double* multipliers) const;

  IntervalEntries entries_;
  EliminationPlan plan_;
  SegmentKernel kernel_;
  TerminalWeights fresh_weights_;
  std::vector<TerminalWeights> weights_;    // one per lane
  Mask has_other_weights_{};                // than its matrix began with
  Mask tries_others_{};                     // one after the other, until one decides or none is left
  std::array<int, lane_count> refusals_{};  // in a row
  std::array<int, lane_count> calm_{};      // systems in a row that were not refused
  std::vector<TerminalWeights::Diagonal> free_diagonals_;
  std::vector<double> compliances_;   // by diagonal and lane
  std::vector<double> lane_weights_;  // by entry of the state and lane
  std::vector<double> last_state_;    // d, by entry of the state and lane
  Mask is_definite_{};
  std::vector<double> factor_;  // of Γ, lower triangle, by entry and lane
  std::vector<double> end_;     // ν, by entry and lane
  Eigen::MatrixXd reachability_;
  Eigen::VectorXd padded_;
  GroupMemory memory_;
};

}  // namespace dmocbench::kkt
