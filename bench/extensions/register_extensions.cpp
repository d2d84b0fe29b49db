#include "bench/extensions/register_extensions.hpp"

namespace dmocbench {

void register_extensions() {
  add_claims(primitives_claims());
  add_claims(step_control_claims());
  add_claims(low_thrust_claims());
}

}  // namespace dmocbench
