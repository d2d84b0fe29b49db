#pragma once

#include <numbers>

#include "problems/planar_quadrotor.hpp"

namespace dmocbench {

/// A somersault of the planar quadrotor: from rest at (0, 0, 0) to rest at (0, 0, 2π) in T = 1 s; all else is as in
/// `PlanarQuadrotor`, by option 0 <= u <= mg.
class PlanarQuadrotorFlip : public PlanarQuadrotor {
 public:
  PlanarQuadrotorFlip() : PlanarQuadrotor(flip_duration) {}

  [[nodiscard]] std::string name() const override { return "planar_quadrotor_flip"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = PlanarQuadrotor::card();
    card.description = "somersault of a planar quadrotor on the spot in fixed time, with least control effort";
    card.title = "Somersault of the quadrotor";
    card.reference = reference_optimum();
    return card;
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return BoundaryState::at_rest(Eigen::Vector3d(0.0, 0.0, 2.0 * std::numbers::pi));
  }

 private:
  [[nodiscard]] std::optional<ReferenceOptimum> reference_optimum() const {
    if (!has_default_parameters({"bounded"})) return std::nullopt;
    if (is_bounded()) {
      return ReferenceOptimum{
          .objective = 15.3075,
          .digits = 6,
          .certificate = "Gauss with s = 3 on 256 intervals, Lobatto with s = 4 on 192 intervals and a replay agree"};
    }
    return ReferenceOptimum{
        .objective = 14.19952298017,
        .digits = 11,
        .certificate = certificate,
        .remark = "no published value is known; other minima cost more and turn unevenly (17.47, 19.09)"};
  }

  static constexpr double flip_duration = 1.0;  // s
};

}  // namespace dmocbench
