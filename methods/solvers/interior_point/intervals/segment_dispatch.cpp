#include "methods/solvers/interior_point/intervals/segment_kernel.hpp"

namespace dmocbench::interior_point {

SegmentKernelChoice segment_kernels_of(InstructionSet set) {
#ifdef DMOCBENCH_X86_KERNELS
  static constexpr std::array choices{segment_kernel_baseline, segment_kernel_avx2, segment_kernel_avx512};
#else
  static constexpr std::array choices{segment_kernel_baseline};
#endif
  return compiled_for(set, choices);
}

SegmentKernel segment_kernel_for(const Shape& shape) { return segment_kernels_of(preferred_instruction_set())(shape); }

}  // namespace dmocbench::interior_point
