#pragma once

#include "problems/satellite_slew.hpp"

namespace dmocbench {

/// `SatelliteSlew` by a matrix: no angle has a singularity.
///
/// q = (d_1, d_2, d_3), the columns of the rotation matrix R, with six constraints R'R = 1;
///   L = ½ Σ_i E_i |ḋ_i|²,  E_i = ½(J_1 + J_2 + J_3) - J_i,
///   ω_1 = ½(d_3·ḋ_2 - d_2·ḋ_3) and so on, the angular velocity in the frame of the body; torques do work on these ω,
/// also where R'R is not 1.
class SatelliteDirectors final : public SatelliteSlew {
 public:
  [[nodiscard]] std::string name() const override { return "satellite_directors"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    return card_of("directors", "stated for this library, after the directors of Betsch and Leyendecker",
                   "dimensionless");
  }
  [[nodiscard]] std::vector<std::string> configuration_names() const override {
    return {"d1_x", "d1_y", "d1_z", "d2_x", "d2_y", "d2_z", "d3_x", "d3_y", "d3_z"};
  }

  [[nodiscard]] ExpressionVector constraints(const ExpressionVector& q) const override {
    ExpressionVector g(6);
    Eigen::Index next = 0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = i; j < 3; ++j) {
        g[next++] = director(q, i).dot(director(q, j)) - (i == j ? 1.0 : 0.0);
      }
    }
    return g;
  }
  /// The chart of `SatelliteSlew`, at every node another one.
  [[nodiscard]] ExpressionVector moving_embedding(const ExpressionVector& theta, const Expression& t) const override {
    return rotation_by(chart_at(theta, t)).reshaped();
  }
  [[nodiscard]] ExpressionMatrix attitude(const ExpressionVector& q) const override { return q.reshaped(3, 3); }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const ExpressionVector moments = inertia();
    const Expression half_sum = 0.5 * moments.sum();
    Expression sum = 0.0;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const ExpressionVector rate = director(x.v, i);
      sum += 0.5 * (half_sum - moments[i]) * rate.dot(rate);
    }
    return sum;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    ExpressionVector f(9);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Eigen::Index j = (i + 1) % 3;
      const Eigen::Index k = (i + 2) % 3;
      const Expression half = 0.5 * x.u[i];
      f.segment(3 * j, 3) += half * director(x.q, k);
      f.segment(3 * k, 3) -= half * director(x.q, j);
    }
    return f;
  }

  /// Rotations of space about the axis x.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override {
    ExpressionVector generator(9);
    for (Eigen::Index i = 0; i < 9; i += 3) generator.segment(i, 3) << 0.0, -q[i + 2], q[i + 1];
    return generator;
  }

 private:
  static ExpressionVector director(const ExpressionVector& of, Eigen::Index i) { return of.segment(3 * i, 3); }

  [[nodiscard]] BoundaryState turned(double angle, double rate) const override {
    const Eigen::Matrix3d attitude = Eigen::AngleAxisd(angle, axis()).toRotationMatrix();
    BoundaryState state{.q = attitude.reshaped(), .v = Eigen::VectorXd(9)};
    for (Eigen::Index i = 0; i < 3; ++i) state.v.segment<3>(3 * i) = rate * axis().cross(attitude.col(i));
    return state;
  }
};

}  // namespace dmocbench
