#include "methods/solvers/kkt/intervals/segment_kernel.hpp"

#include <cstddef>
#include <type_traits>

// A step is inlined into its sweep so that its blocks can live in registers.
#define DMOCBENCH_INLINE [[gnu::always_inline]] inline

// Compiled once per instruction set. A namespace of its own keeps what is not inlined apart: a linker may take either
// of two functions of the same name.
namespace dmocbench::kkt {
namespace DMOCBENCH_SEGMENT_NAMESPACE {

#include "methods/runtime/lanes.inc"
//
#include "methods/solvers/kkt/intervals/segment_kernel.inc"

}  // namespace DMOCBENCH_SEGMENT_NAMESPACE

SegmentKernel DMOCBENCH_SEGMENT_KERNEL(const Shape& shape) { return DMOCBENCH_SEGMENT_NAMESPACE::choose_kernel(shape); }

}  // namespace dmocbench::kkt
