#pragma once

#include <vector>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// Elastic impacts of simulated motions by conditions on the energy. A row per force, condition, number of stages and
/// of steps, and the orders; the columns are declared in the source.
struct ImpactTables {
  Table impacts;
  Table orders;
};

/// A particle falls on an uneven ground, bounces once and flies on, `steps` steps of DMOC before the impact and as many
/// after it, without force and under a drag. The impulse μ of p⁺ = p⁻ + Gᵀμ follows from one of three conditions:
///
/// - `momenta`: G(v⁺ + v⁻) = 0, the impact law for the velocities of the Legendre-transformed momenta p^±. Then
///   E(q, p⁺) = E(q, p⁻) too.
/// - `steps`: E_d of the last step equals E_d of the first step, E_d = -∂L_d/∂h = Σ b_i (L_v·Q̇_i - L) at fixed Q_i: the
///   action is stationary in the time of the impact if only the two neighbouring steps change (the energy condition of
///   variational collision integrators).
/// - `steps_and_work`: the same with half of the work of these steps' forces added before and subtracted after.
///
/// Errors are distances to the exact flow with the exact impact law.
[[nodiscard]] ImpactTables impact_tables(const std::vector<int>& steps);

}  // namespace dmocbench
