#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/batch/lane_vector.hpp"
#include "methods/solvers/interior_point/bound_formulas.hpp"

namespace dmocbench::batch {

/// A bound of one entry in all lanes: a stretch of `interior_point::BoundFormulas`. Points are vectors of all lanes
/// (`LaneVector`) or of one.
struct LaneBound {
  using Number = OfLanes;

  Eigen::Index entry;
  double side;  ///< 1 of a lower bound, -1 of an upper one
  std::size_t set;
  Eigen::Index bound;  ///< the place of its multiplier in z
  double value;
  double other;  ///< the bound on the other side, or infinity

  template <class Point>
  [[nodiscard]] auto entries(Point& of) const {
    return number(of, entry);
  }
  template <class Multipliers>
  [[nodiscard]] auto multipliers(Multipliers& z) const {
    return number(z, bound);
  }
  template <class Point>
  [[nodiscard]] auto distances(const Point& of) const {
    return (side * (entries(of) - value)).eval();
  }

  [[nodiscard]] static OfLanes all(double number) { return OfLanes::Constant(number); }
  [[nodiscard]] static OfLanes sum(const OfLanes& numbers) { return numbers; }
  [[nodiscard]] static OfLanes smaller(const OfLanes& than, const OfLanes& numbers) { return than.min(numbers); }
  [[nodiscard]] static OfLanes larger(const OfLanes& than, const OfLanes& numbers) { return than.max(numbers); }
  [[nodiscard]] static OfLanes shortened(const OfLanes& loss, const OfLanes& tau) {
    return (loss > tau).select(tau / loss, 1.0);
  }
  [[nodiscard]] static OfLanes where_moving(const OfLanes& length, const OfLanes& moved, const OfLanes& kept) {
    return (length > 0.0).select(moved, kept);
  }

 private:
  [[nodiscard]] static auto number(const LaneVector& of, Eigen::Index i) { return of[i]; }
  [[nodiscard]] static auto number(LaneVector& of, Eigen::Index i) { return of[i]; }
  template <class OfOneLane>
  [[nodiscard]] static auto number(OfOneLane& of, Eigen::Index i) {
    return of.template segment<1>(i).array();
  }
};

/// The bounds of eight barrier problems side by side. The primal vector has the unknowns, followed by the slacks of the
/// inequalities; the vector z has the multipliers of the bounds. All instances of a batch share their bounds. Entries
/// whose two bounds are equal are fixed: they may differ between instances, and have no bounds here.
class LaneBounds : public interior_point::BoundFormulas<LaneBound> {
 public:
  /// `inequalities`: the constraints that have slacks, in the order of these.
  LaneBounds(const NonlinearProgram& program, const std::vector<Eigen::Index>& inequalities);

  /// Moves the entries `begin` .. `end` - 1 of one lane's point away from their bounds: by `push` times the size of the
  /// bound, or `push` times the distance between both bounds if that is less.
  void push_inside(std::size_t lane, double push, Eigen::Index begin, Eigen::Index end, LaneVector& primal) const;
  /// -Σ ln d
  [[nodiscard]] OfLanes barrier(const LaneVector& primal) const;

 private:
  void add(std::size_t set, Eigen::Index entry, double lower, double upper);
};

}  // namespace dmocbench::batch
