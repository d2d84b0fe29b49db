#pragma once

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Low thrust transfer of a satellite between two circular orbits, section 4.2.1 of the paper (orb_trans).
///
/// q = (r, φ), L = ½(ṙ² + r²φ̇²) + 1/r, f = (0, r u), C = u². Solved nondimensionally: length r⁰, time
/// sqrt(r⁰³/(γM)), mass of the satellite 1. The radii r⁰ and r^T are altitudes plus the Earth's radius (the paper prints
/// the altitudes 30 km and 330 km only). φ is unwrapped: φ(T) = 2πd after d revolutions, in the time
/// T = d sqrt(4π²/8 (1 + ρ)³) with ρ = r^T/r⁰.
class OrbitalTransfer final : public Problem {
 public:
  OrbitalTransfer();

  [[nodiscard]] std::string name() const override { return "orbital_transfer"; }
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] std::string source() const override;
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"r", "phi"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"u"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override;
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override;
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override;
  [[nodiscard]] BoundaryState initial_state() const override;
  [[nodiscard]] BoundaryState final_state() const override;
  [[nodiscard]] double horizon() const override;
  /// The optimum is about 4e-5.
  [[nodiscard]] double cost_scale() const override { return 1e4; }
  /// Rotations: ξ = (0, 1), the momentum is the angular momentum.
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const override;
  [[nodiscard]] Unit time_unit() const override;
  [[nodiscard]] std::vector<PictureQuantity> picture(const ControlledState& x) const override;

 private:
  [[nodiscard]] double initial_radius() const;  // km
  [[nodiscard]] double radius_ratio() const;    // ρ = r^T / r⁰
  [[nodiscard]] double time_scale() const;      // s
};

}  // namespace dmocbench
