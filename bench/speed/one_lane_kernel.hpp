#pragma once

#include "methods/kkt/intervals/segment_kernel.hpp"

namespace dmocbench::speed {

/// The elimination of segments by plain instructions, which take one of the eight lanes after the other: the same
/// operations in the same order, compiled for AVX2's processors without vectors. Sizes known to the compiler are those
/// of DMOC with the midpoint rule for two configurations with one and with two controls.
[[nodiscard]] kkt::SegmentKernel one_lane_kernel(const kkt::Shape& shape);

}  // namespace dmocbench::speed
