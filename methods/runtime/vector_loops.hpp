#pragma once

#include <cstddef>

#include "methods/runtime/instruction_set.hpp"

namespace dmocbench {

/// Loops over stretches of vectors, compiled for one instruction set. Sums have eight interleaved parts, in the
/// same order in every set.
struct VectorLoops {
  /// Largest |x_i|, 0 if there are none; any number if one of them is not finite.
  double (*largest)(const double* x, std::ptrdiff_t size);
  /// Σ |x_i|
  double (*sum_of_magnitudes)(const double* x, std::ptrdiff_t size);
  /// Σ x_i y_i
  double (*dot)(const double* x, const double* y, std::ptrdiff_t size);
  /// Zero if and only if all numbers are finite.
  double (*sum_of_zeros)(const double* x, std::ptrdiff_t size);
  /// result_i += x_i y_i; `result` overlaps neither.
  void (*add_products)(double* result, const double* x, const double* y, std::ptrdiff_t size);
  /// result_i = x_i + factor y_i; `result` may be x.
  void (*set_to_sum)(double* result, const double* x, double factor, const double* y, std::ptrdiff_t size);
};

/// The loops for the instruction set that was preferred at the first call.
[[nodiscard]] const VectorLoops& vector_loops();
/// The loops for a set.
[[nodiscard]] const VectorLoops& vector_loops_of(InstructionSet set);

// The same source, vector_loops.cpp, compiled once per instruction set.
/// For any processor.
extern const VectorLoops vector_loops_baseline;
/// For processors with AVX2.
extern const VectorLoops vector_loops_avx2;
/// For processors with AVX-512.
extern const VectorLoops vector_loops_avx512;

}  // namespace dmocbench
