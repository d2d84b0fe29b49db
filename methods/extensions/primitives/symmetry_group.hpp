#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "methods/expression/vectors.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// An element g of a symmetry group that acts affinely: q ↦ A q + b, v ↦ A v. Translations, rotations of the plane and
/// shifts of angles are such elements, full turns of an angle among them.
struct Displacement {
  Eigen::MatrixXd linear;  ///< A, n × n, invertible
  Eigen::VectorXd shift;   ///< b, n entries

  /// q ↦ q.
  [[nodiscard]] static Displacement identity(Eigen::Index n);
  /// q ↦ q + b.
  [[nodiscard]] static Displacement translation(Eigen::VectorXd b);

  /// g·q.
  [[nodiscard]] Eigen::VectorXd configuration(const Eigen::VectorXd& q) const { return linear * q + shift; }
  /// g·(q, v).
  [[nodiscard]] BoundaryState state(const BoundaryState& x) const { return {configuration(x.q), linear * x.v}; }
  /// q ↦ this(other(q)).
  [[nodiscard]] Displacement after(const Displacement& other) const;
  /// The largest difference of an entry of A or b.
  [[nodiscard]] double distance(const Displacement& other) const;
};

/// An infinitesimal generator ξ(q) of a symmetry, n entries.
using Generator = std::function<ExpressionVector(const ExpressionVector& q)>;

/// A Lie group of symmetries, given by d generators that are affine in q: ξ_i(q) = A_i q + b_i. Its elements are
/// products of flows, q ↦ exp(τ Σ c_i ξ_i)(q). The group has to map motions of the problem to motions of equal cost;
/// nothing checks that but the equations of moved motions.
class SymmetryGroup {
 public:
  /// The group of `Problem::symmetry`. Throws `Error` if there is none, or as the other constructor.
  explicit SymmetryGroup(const Problem& problem);
  /// Throws `Error` without generators, or if one is not affine.
  SymmetryGroup(const Problem& problem, std::vector<Generator> generators);

  /// d.
  [[nodiscard]] Eigen::Index dimension() const noexcept { return static_cast<Eigen::Index>(generators_.size()); }
  /// Σ c_i ξ_i(q) as a formula: the velocity of the flow with the rates c, d entries.
  [[nodiscard]] ExpressionVector traced_velocity(const ExpressionVector& q, const ExpressionVector& rates) const;
  /// Σ c_i ξ_i(q) in numbers.
  [[nodiscard]] Eigen::VectorXd velocity(const Eigen::VectorXd& q, const Eigen::VectorXd& rates) const;
  /// exp(τ Σ c_i ξ_i).
  [[nodiscard]] Displacement flow(const Eigen::VectorXd& rates, double time) const;

 private:
  /// (A, b; 0, 0) with A q + b = Σ c_i ξ_i(q).
  [[nodiscard]] Eigen::MatrixXd algebra_element(const Eigen::VectorXd& rates) const;

  std::vector<Generator> generators_;
  std::vector<Displacement> affine_;  // A_i and b_i
};

}  // namespace dmocbench
