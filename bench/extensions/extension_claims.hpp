#pragma once

#include "bench/claims/claim.hpp"

namespace dmocbench {

[[nodiscard]] Claims primitives_claims();    ///< roadmaps of DMOC primitives
[[nodiscard]] Claims step_control_claims();  ///< step sizes tied to the motion
[[nodiscard]] Claims low_thrust_claims();    ///< many revolutions with few steps in each

}  // namespace dmocbench
