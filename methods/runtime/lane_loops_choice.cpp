#include <array>

#include "methods/runtime/lane_loops.hpp"

namespace dmocbench {

const LaneLoops& lane_loops_of(InstructionSet set) {
#ifdef DMOCBENCH_X86_KERNELS
  static constexpr std::array loops{&lane_loops_baseline, &lane_loops_avx2, &lane_loops_avx512};
#else
  static constexpr std::array loops{&lane_loops_baseline};
#endif
  return *compiled_for(set, loops);
}

const LaneLoops& lane_loops() {
  static const LaneLoops& preferred = lane_loops_of(preferred_instruction_set());
  return preferred;
}

}  // namespace dmocbench
