// Compiled once per instruction set, see kernels.hpp: the peak of the machine, and the list of all kernels.
#include <array>
#include <cstddef>

#include <xsimd/xsimd.hpp>

#include "bench/speed/kernels.hpp"
#include "methods/runtime/independent_iterations.hpp"

namespace dmocbench::speed {

namespace {

using Vector = xsimd::batch<double>;

// Enough independent sums to hide the latency of an operation on two ports, few enough for 16 registers.
constexpr std::size_t chains = 12;

double arithmetic(std::size_t turns) {
  const Vector factor(0.999);
  const Vector summand(0.001);
  std::array<Vector, chains> sums{};
  for (std::size_t i = 0; i < chains; ++i) sums[i] = Vector(1.0 + 0.01 * static_cast<double>(i));
  for (std::size_t turn = 0; turn < turns; ++turn) {
#pragma GCC unroll 12
    for (std::size_t i = 0; i < chains; ++i) sums[i] = xsimd::fma(sums[i], factor, summand);
  }
  Vector sum = sums[0];
  for (std::size_t i = 1; i < chains; ++i) sum += sums[i];
  return sum.get(0);
}

void triad(std::size_t size, double* a, const double* b, const double* c, double factor) {
  DMOCBENCH_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < size; ++i) a[i] = b[i] + factor * c[i];
}

}  // namespace

namespace DMOCBENCH_KERNELS {

Kernels all() {
  return {.orbital_transfer = orbital_transfer(),
          .two_link_manipulator = two_link_manipulator(),
          .arithmetic = arithmetic,
          .operations_of_a_turn = 2 * chains * Vector::size,
          .triad = triad};
}

}  // namespace DMOCBENCH_KERNELS

}  // namespace dmocbench::speed
