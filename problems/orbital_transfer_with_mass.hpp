#pragma once

#include "problems/orbital_transfer.hpp"

namespace dmocbench {

/// The orbital transfer of the paper by an engine of given jet power, which makes the satellite lighter.
///
/// y = m, the mass relative to the initial one, with ṁ = -κF² for the thrust u = F: κ = 1/(2P), P the power of the
/// jet, both nondimensional. L = m [½(ṙ² + r²φ̇²) + 1/r]. The jet leaves with the momentum of the satellite, so that
/// f = (0, r F) + ṁ (ṙ, r²φ̇): the Euler-Lagrange equations reduce to m times the acceleration against the
/// thrust. The mass at the end is free. κ = 0 is `orbital_transfer`.
class OrbitalTransferWithMass final : public OrbitalTransfer {
 public:
  OrbitalTransferWithMass()
      : OrbitalTransfer({{"inverse_power", 5e3, "", "mass flow per square of the thrust, nondimensional", 0.0, 1e4}}) {}

  [[nodiscard]] std::string name() const override { return "orbital_transfer_with_mass"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override {
    ProblemCard card = OrbitalTransfer::card();
    card.description = "low-thrust transfer of a satellite that burns mass, with least control effort";
    card.title = "Orbital transfer with mass";
    card.source = "orbital_transfer with the mass flow of an engine of limited power";
    card.reference = with_default_parameters(
        *this, {.objective = 3.29498773270e-5,
                .digits = 12,
                .certificate = "Gauss with 3 stages on 128 and 256 intervals; DMOC and tangent-space collocation"});
    return card;
  }
  [[nodiscard]] std::vector<std::string> first_order_names() const override { return {"mass"}; }
  [[nodiscard]] ExpressionVector first_order_rates(const ControlledState& x) const override {
    return ExpressionVector{{-(varying("inverse_power") * x.u[0] * x.u[0])}};
  }

  [[nodiscard]] Expression lagrangian(const State& x) const override { return x.y[0] * OrbitalTransfer::lagrangian(x); }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    const Expression rate = first_order_rates(x)[0];
    const Expression& r = x.q[0];
    return ExpressionVector{{rate * x.v[0], r * x.u[0] + rate * r * r * x.v[1]}};
  }

  [[nodiscard]] BoundaryState initial_state() const override { return with_mass(OrbitalTransfer::initial_state()); }
  [[nodiscard]] BoundaryState final_state() const override { return with_mass(OrbitalTransfer::final_state()); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.last.free_first_order(0);
    return bounds;
  }

 private:
  static BoundaryState with_mass(BoundaryState state) {
    state.y = Eigen::VectorXd::Ones(1);
    return state;
  }
};

}  // namespace dmocbench
