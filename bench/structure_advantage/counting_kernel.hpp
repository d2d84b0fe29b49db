#pragma once

#include "methods/solvers/interior_point/intervals/segment_kernel.hpp"

namespace dmocbench {

/// What a backward sweep over eight segments side by side computed, per interval.
struct SweepCount {
  double multiplications = 0.0;  ///< nearly all of them with an addition
  double divisions = 0.0;
  double additions = 0.0;
};

/// The kernels of the elimination by intervals, the same source with a number type that counts: slow, and for the same
/// shapes. Not for two threads.
[[nodiscard]] interior_point::SegmentKernel counting_segment_kernel(const interior_point::Shape& shape);

/// Of the last backward sweep of such a kernel.
[[nodiscard]] SweepCount last_sweep_count();

}  // namespace dmocbench
