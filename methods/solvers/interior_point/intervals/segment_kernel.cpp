#include "methods/solvers/interior_point/intervals/segment_kernel.hpp"

#include <cstddef>
#include <type_traits>

// A step has to be inlined into its sweep for its blocks to live in registers.
#define DMOCBENCH_INLINE [[gnu::always_inline]] inline

// Compiled once per instruction set. A namespace of its own keeps what is not inlined apart: a linker may take either
// of two functions of the same name.
namespace dmocbench::interior_point {
namespace DMOCBENCH_SEGMENT_NAMESPACE {

#include "methods/runtime/lanes.inc"
//
#include "methods/solvers/interior_point/intervals/collect.inc"
//
#include "methods/solvers/interior_point/intervals/backward_step.inc"
//
#include "methods/solvers/interior_point/intervals/records.inc"
//
#include "methods/solvers/interior_point/intervals/backward_sweep.inc"
//
#include "methods/solvers/interior_point/intervals/forward_sweep.inc"
//
#include "methods/solvers/interior_point/intervals/kernel_choice.inc"

}  // namespace DMOCBENCH_SEGMENT_NAMESPACE

SegmentKernel DMOCBENCH_SEGMENT_KERNEL(const Shape& shape) { return DMOCBENCH_SEGMENT_NAMESPACE::choose_kernel(shape); }

}  // namespace dmocbench::interior_point
