#include "methods/kkt/intervals/segment_kernel.hpp"

#include <cstddef>
#include <type_traits>
#include <utility>

// A step is inlined into its sweep so that its blocks can live in registers; CMake says otherwise for sanitizers.
#ifndef DMOCBENCH_INLINE
#define DMOCBENCH_INLINE [[gnu::always_inline]] inline
#endif

// Compiled once per instruction set, each time in a namespace of its own: of two functions of the same name, which were
// compiled for different sets, a linker would keep either.
namespace dmocbench::kkt {
namespace DMOCBENCH_SEGMENT_NAMESPACE {

#include "methods/runtime/lanes.inc"
// A comment between the two keeps the formatter from sorting them: the second needs the first.
#include "methods/kkt/intervals/segment_kernel.inc"

}  // namespace DMOCBENCH_SEGMENT_NAMESPACE

SegmentKernel DMOCBENCH_SEGMENT_KERNEL(const Shape& shape) { return DMOCBENCH_SEGMENT_NAMESPACE::choose_kernel(shape); }

}  // namespace dmocbench::kkt
