#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/batch/lane_vector.hpp"

namespace dmocbench::batch {

/// The bounds of eight barrier problems side by side: `interior_point::BarrierBounds` in lanes. Unknowns and, behind
/// them, the slacks of inequalities make one vector, the primal one; z are the multipliers of the bounds, one vector.
/// All instances of a batch have the same bounds, but for entries whose two bounds are equal, which have none here.
class LaneBounds {
 public:
  /// `inequalities`: the constraints that have slacks, in the order of these.
  LaneBounds(const NonlinearProgram& program, const std::vector<Eigen::Index>& inequalities);

  [[nodiscard]] Eigen::Index count() const noexcept { return count_; }

  /// Moves a point of one lane away from its bounds, by the share `push` of their size, at most of their distance: the
  /// entries `begin` .. `end` - 1.
  void push_inside(std::size_t lane, double push, Eigen::Index begin, Eigen::Index end, LaneVector& primal) const;
  /// z = max(μ/d, ±gradient) in one lane.
  void balance(std::size_t lane, double mu, const LaneVector& primal, const LaneVector& gradient, LaneVector& z) const;

  /// -Σ ln d
  [[nodiscard]] OfLanes barrier(const LaneVector& primal) const;
  /// Its derivative along a step.
  [[nodiscard]] OfLanes barrier_derivative(const LaneVector& primal, const LaneVector& step) const;
  /// sigma += z/d, and gradient ∓= μ/d.
  void add_barrier(const LaneVector& primal, const LaneVector& z, const OfLanes& mu, LaneVector& sigma,
                   LaneVector& gradient) const;
  /// gradient ∓= z
  void subtract_multipliers(const LaneVector& z, LaneVector& gradient) const;
  /// The same in one lane.
  void subtract_multipliers(std::size_t lane, const LaneVector& z, LaneVector& gradient) const;
  /// The smallest and the largest d z.
  void products(const LaneVector& primal, const LaneVector& z, OfLanes& smallest, OfLanes& largest) const;
  /// dz = μ/d - z ∓ (z/d) dx, (12).
  void set_multiplier_step(const LaneVector& primal, const LaneVector& z, const OfLanes& mu, const LaneVector& step,
                           LaneVector& z_step) const;
  /// The longest step, at most 1, that leaves the share 1 - τ of every d, (15a).
  [[nodiscard]] OfLanes fraction_to_boundary(const LaneVector& primal, const LaneVector& step,
                                             const OfLanes& tau) const;
  /// The same for z, (15b).
  [[nodiscard]] OfLanes multiplier_fraction_to_boundary(const LaneVector& z, const LaneVector& z_step,
                                                        const OfLanes& tau) const;
  /// z += length dz, then kept within a factor κ_Σ of μ/d, (14c) and (16), in lanes whose length is not 0.
  void update_multipliers(const LaneVector& primal, const LaneVector& z_step, const OfLanes& length, const OfLanes& mu,
                          LaneVector& z) const;

 private:
  /// A bound of one entry, and the place of its multiplier in z.
  struct OneSidedBound {
    Eigen::Index entry;
    double side;  ///< 1 of a lower bound, -1 of an upper one
    double value;
    double other;  ///< the bound on the other side, or infinity
  };
  void add(Eigen::Index entry, double lower, double upper);
  template <class Visit>
  void for_each(const Visit& visit) const;

  std::vector<OneSidedBound> bounds_;
  Eigen::Index count_ = 0;
};

}  // namespace dmocbench::batch
