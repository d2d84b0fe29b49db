// Compiled once per instruction set, each time with names of its own.
#include "methods/kkt/intervals/segment_sweeps.hpp"

#include "methods/kkt/intervals/segment_kernel.hpp"

namespace dmocbench::kkt {

SegmentKernel DMOCBENCH_SEGMENT_KERNEL(const Shape& shape) { return choose_kernel(shape); }

}  // namespace dmocbench::kkt
