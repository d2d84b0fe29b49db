#include <array>

#include "methods/runtime/lane_loops.hpp"

namespace dmocbench {

const LaneLoops& lane_loops_of(InstructionSet set) {
  static constexpr std::array loops{DMOCBENCH_VERSIONS(&lane_loops)};
  return *compiled_for(set, loops);
}

const LaneLoops& lane_loops() {
  static const LaneLoops& preferred = lane_loops_of(preferred_instruction_set());
  return preferred;
}

}  // namespace dmocbench
