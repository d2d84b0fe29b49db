#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "methods/runtime/instruction_set.hpp"

/// Formulas written by hand and loops that show the peak of the machine, compiled once per instruction set with the
/// flags of the tape's kernel; DMOCBENCH_KERNELS is the namespace of a set. As in tape_kernel.cpp only headers whose
/// functions are inlined, or in a namespace of this set alone, may be used there.
namespace dmocbench::speed {

/// The arrays that a function written by hand reads and writes; entry k of a column belongs to interval k.
struct HandSeries {
  // One column per input, numbered as in `LocalInputs`: left q, right q, u, the step h, the time (not read), the
  // factor of the cost (not read: `factor` below), multipliers of the left and of the right constraints.
  const double* const* in;
  double factor;       ///< of the cost, the problem's scale included
  double* const* out;  ///< one column per output, in the order of `IntervalFunctions`; must not overlap
};

/// Treats intervals 0 .. `intervals` - 1.
using HandKernel = void (*)(std::size_t intervals, const HandSeries& columns);

/// Residual, Jacobian and Hessian of ℓ by DMOC with the midpoint rule for one problem with its default data, as an
/// engineer would write them: loops over the intervals that g++ vectorises.
///
/// With Q = (q_k + q_{k+1})/2, V = (q_{k+1} - q_k)/h and G = L_q + f at (Q, V, u) the constraints of an interval are
/// left h/2 G - L_v and right h/2 G + L_v, and its share of the Lagrangian is ℓ = factor h C + α·G + δ·L_v with α = h/2
/// (λ_left + λ_right), δ = λ_right - λ_left. Derivatives are found in Q and V, where they are few; a right end has ∂Q =
/// 1/2, ∂V = 1/h, a left one ∂Q = 1/2, ∂V = -1/h.
using HandFunctions = std::array<HandKernel, 3>;

/// A copy of the first pointers to inputs or outputs, which no store can change: g++ then keeps them out of its loops.
template <std::size_t count, class Pointer>
[[gnu::always_inline]] inline std::array<Pointer, count> first(const Pointer* pointers) {
  std::array<Pointer, count> copy{};
  for (std::size_t i = 0; i < count; ++i) copy[i] = pointers[i];
  return copy;
}

/// Writes the outputs of interval k. Written out like this, and not as a loop, the loop over the intervals is
/// vectorised.
template <std::size_t count>
[[gnu::always_inline]] inline void store(const std::array<double*, count>& out, std::size_t k,
                                         const std::array<double, count>& values) {
  [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) { ((out[i][k] = values[i]), ...); }
  (std::make_index_sequence<count>());
}

/// Multiplications with additions on registers alone, `turns` times; the result only keeps them from being left out.
using ArithmeticLoop = double (*)(std::size_t turns);
/// a_i = b_i + factor c_i. The arrays must not overlap.
using TriadLoop = void (*)(std::size_t size, double* a, const double* b, const double* c, double factor);

/// The loops that are compiled once per instruction set.
struct Kernels {
  HandFunctions orbital_transfer;      ///< formulas of the problem, written by hand
  HandFunctions two_link_manipulator;  ///< the same
  ArithmeticLoop arithmetic;           ///< the largest rate of operations
  std::size_t operations_of_a_turn;    ///< of `arithmetic`; a fused multiplication and addition are two
  TriadLoop triad;                     ///< the largest rate of bytes
};

/// Those that were compiled for this set, or for the widest one below it.
[[nodiscard]] Kernels kernels_of(InstructionSet set);

#ifdef DMOCBENCH_KERNELS
// The definitions for one instruction set, which gives the namespace its name.
namespace DMOCBENCH_KERNELS {
[[nodiscard]] HandFunctions orbital_transfer();
[[nodiscard]] HandFunctions two_link_manipulator();
[[nodiscard]] Kernels all();
}  // namespace DMOCBENCH_KERNELS
#endif

}  // namespace dmocbench::speed
