#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "methods/mechanics/problem.hpp"
#include "methods/tables/table.hpp"
#include "methods/transcription/motions/trajectory.hpp"

namespace dmocbench {

/// A system whose L is invariant under a constant generator ξ, with a motion under controls.
struct InvariantSystem {
  std::shared_ptr<const Problem> problem;
  bool orthogonal;      ///< whether f·ξ = 0
  double amplitude;     ///< of the controls
  BoundaryState start;  ///< of the motion
  double step;          ///< of a discrete motion
};
/// Two systems with orthogonal forces, two with forces along ξ.
[[nodiscard]] std::vector<InvariantSystem> invariant_systems();

/// The forced discrete Noether theorem (th:discforcNoe, eq:noether_force_d): `steps` steps of the one-step map under
/// arbitrary stage controls. A row per system with a symmetry, method and tableau.
[[nodiscard]] Table noether_table(int steps);

/// The states at which one-step maps are tested for symplecticity.
struct MappedStates {
  std::shared_ptr<const Problem> problem;
  std::vector<BoundaryState> states;  ///< where a step begins, at t = 0
  double step = 0.0;                  ///< h
};
/// Eight states around one of each of three example systems.
[[nodiscard]] std::vector<MappedStates> example_states();
/// Eight nodes of a motion, evenly spread, with its first step.
[[nodiscard]] MappedStates states_along(const std::shared_ptr<const Problem>& problem, const Trajectory& motion);

/// The unforced one-step map's |DᵀΩD - Ω|, the largest over the states.
struct SymplecticityTable {
  Table table;                  ///< a row per system, method and tableau; columns are declared in the source
  std::ptrdiff_t unsolved = 0;  ///< rows without a number because a step cannot be solved; they have the reason
};
[[nodiscard]] SymplecticityTable symplecticity_table(const std::vector<MappedStates>& systems);

}  // namespace dmocbench
