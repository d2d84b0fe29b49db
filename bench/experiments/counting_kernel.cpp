#include <cstddef>
#include <type_traits>
#include <utility>

#include "bench/experiments/operation_count.hpp"

// NOLINTBEGIN(*-macro-usage): what the fragments below read
#define DMOCBENCH_INLINE inline
#define DMOCBENCH_ANY_SIZE 0
#define DMOCBENCH_COUNT_OPERATIONS(count) (operations += (count))  // of all eight lanes
// NOLINTEND(*-macro-usage)

namespace dmocbench::kkt::counting {

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): operators and kernels are plain functions
long long operations = 0;
double operations_per_interval = 0.0;
SegmentKernel uncounted;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

#include "methods/runtime/lanes.inc"
//
#include "methods/kkt/intervals/segment_kernel.inc"

void counted_backward(const EliminationPlan& plan, const NewtonArrays& arrays, SegmentGroup& group) {
  operations = 0;
  uncounted.backward(plan, arrays, group);
  operations_per_interval = static_cast<double>(operations) / group.steps;
}

}  // namespace dmocbench::kkt::counting

namespace dmocbench {

kkt::SegmentKernel counting_segment_kernel(const kkt::Shape& shape) {
  using namespace kkt::counting;  // NOLINT(google-build-using-namespace): two names of one function
  uncounted = choose_kernel(shape);
  return {uncounted.workspace_size, counted_backward, uncounted.forward};
}

double counted_operations_per_interval() { return kkt::counting::operations_per_interval; }

}  // namespace dmocbench
