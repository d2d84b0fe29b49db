#include "methods/program/processor.hpp"
#include "methods/solvers/interior_point/intervals/segment_kernel.hpp"

namespace dmocbench::interior_point {

std::vector<SegmentKernelChoice> available_segment_kernels() {
  std::vector<SegmentKernelChoice> choices{segment_kernel_baseline};
#ifdef DMOCBENCH_X86_KERNELS
  if (has_avx2()) choices.push_back(segment_kernel_avx2);
  if (has_avx512()) choices.push_back(segment_kernel_avx512);
#endif
  return choices;
}

SegmentKernel segment_kernel_for(const Shape& shape) { return available_segment_kernels().back()(shape); }

}  // namespace dmocbench::interior_point
