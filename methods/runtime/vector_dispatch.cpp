#include "methods/runtime/vector_loops.hpp"

namespace dmocbench {

const VectorLoops& vector_loops_of(InstructionSet set) {
#ifdef DMOCBENCH_X86_KERNELS
  static constexpr std::array loops{&vector_loops_baseline, &vector_loops_avx2, &vector_loops_avx512};
#else
  static constexpr std::array loops{&vector_loops_baseline};
#endif
  return *compiled_for(set, loops);
}

const VectorLoops& vector_loops() {
  static const VectorLoops& preferred = vector_loops_of(preferred_instruction_set());
  return preferred;
}

}  // namespace dmocbench
