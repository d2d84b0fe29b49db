#pragma once

#include <array>
#include <string_view>

#include "bench/claims/claim.hpp"

namespace dmocbench {

/// A claim of an extension by its problem and name.
struct ExtensionClaim {
  std::string_view problem;  ///< "orbital_transfer", or what takes its place
  std::string_view name;     ///< of the claim
};

/// The claims of all extensions in the order of the table: a build without extensions lists them as "not judged".
inline constexpr std::array claims_of_extensions{
    ExtensionClaim{"examples", "global_minima_by_primitives"},
    ExtensionClaim{"simulations", "variational_steps_symplectic"},
    ExtensionClaim{"simulations", "steps_by_the_motion_keep_momentum"},
    ExtensionClaim{"simulations", "variational_steps_energy"},
    ExtensionClaim{"simulations", "variational_steps_accuracy"},
    ExtensionClaim{"orbital_transfer", "low_thrust_structure_pays_in_momentum_alone"},
    ExtensionClaim{"orbital_transfer", "low_thrust_structure_pays_beside_explicit"},
    ExtensionClaim{"orbital_transfer", "low_thrust_order_pays_more"},
};

[[nodiscard]] Claims primitives_claims();    ///< roadmaps of DMOC primitives
[[nodiscard]] Claims step_control_claims();  ///< step sizes tied to the motion
[[nodiscard]] Claims low_thrust_claims();    ///< many revolutions with few steps in each

}  // namespace dmocbench
