#pragma once

#include <cstddef>

#include "methods/runtime/instruction_set.hpp"

namespace dmocbench {

/// The number of instances of a program that are processed side by side, one per lane of a vector register.
inline constexpr std::size_t instance_lanes = 8;

/// Loops over interleaved vectors: entry i of the vector of lane l stands at i * instance_lanes + l. `size` counts
/// entries of one lane; a result or a factor "of every lane" is an array of `instance_lanes` numbers. No lane changes
/// a digit of another, and sums go from the first entry to the last, in every instruction set alike.
struct LaneLoops {
  /// Σ x_i of every lane.
  void (*sum)(const double* x, std::ptrdiff_t size, double* result);
  /// Sum and largest of |x_i| of every lane; the sum is not finite where an entry is not.
  void (*magnitudes)(const double* x, std::ptrdiff_t size, double* sum, double* largest);
  /// Largest |x_i| of every lane, 0 if there are none; any number if one of them is not finite.
  void (*largest)(const double* x, std::ptrdiff_t size, double* result);
  /// Σ x_i y_i of every lane.
  void (*dot)(const double* x, const double* y, std::ptrdiff_t size, double* result);
  /// x -= y; the sum and the largest of the magnitudes that are left, of every lane.
  void (*subtract)(double* x, const double* y, std::ptrdiff_t size, double* sum, double* largest);
  /// result_i = x_i + factor y_i, with a factor of every lane; x_i where that is 0, whatever y_i is. `result` may be x.
  void (*set_to_sum)(double* result, const double* x, const double* factor, const double* y, std::ptrdiff_t size);
  /// Σ 1/(|x_i + y_i| + least) of every lane; x may be null.
  void (*sum_of_reciprocals)(const double* x, const double* y, double least, std::ptrdiff_t size, double* result);
};

/// The loops for the instruction set that was preferred at the first call.
[[nodiscard]] const LaneLoops& lane_loops();
/// The loops for a set.
[[nodiscard]] const LaneLoops& lane_loops_of(InstructionSet set);

// The same source, lane_loops.cpp, compiled once per instruction set.
/// For any processor.
extern const LaneLoops lane_loops_baseline;
/// For processors with AVX2.
extern const LaneLoops lane_loops_avx2;
/// For processors with AVX-512.
extern const LaneLoops lane_loops_avx512;

}  // namespace dmocbench
