#include <algorithm>

#include "methods/solvers/interior_point/intervals/segment_kernel.hpp"

namespace dmocbench::interior_point {

SegmentKernel segment_kernel_for(const Shape& shape) {
#ifdef DMOCBENCH_X86_KERNELS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return segment_kernel_avx512(shape);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return segment_kernel_avx2(shape);
#endif
  return segment_kernel_baseline(shape);
}

}  // namespace dmocbench::interior_point
