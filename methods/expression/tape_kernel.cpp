// Compiled once per instruction set, with the flags of that set and DMOCBENCH_TAPE_KERNEL naming the function. Only
// headers whose functions are inlined, or in a namespace of this set alone, may be used here: a function compiled with
// wide instructions and kept by the linker for all callers would stop a processor that lacks them. (CMake gives the
// namespace xsimd another name per set for this reason.)
#include "methods/expression/tape_kernel.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include <xsimd/xsimd.hpp>

#include "methods/expression/operation.hpp"

namespace dmocbench {

namespace {

/// All numbers of a block: the compiler knows the length of its loops.
struct FullWidth {
  static constexpr std::size_t value = tape_block_width;
  static constexpr bool is_full = true;
};

/// The last, shorter block.
struct PartialWidth {
  std::size_t value;
  static constexpr bool is_full = false;
};

template <class Width, class Function>
inline void for_each(Width width, double* result, const double* x, Function function) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < width.value; ++i) result[i] = function(x[i]);
}

template <class Width, class Function>
inline void for_each(Width width, double* result, const double* x, const double* y, Function function) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < width.value; ++i) result[i] = function(x[i], y[i]);
}

/// A function of xsimd, vector by vector; the remainder goes through a padded vector, so that every number takes the
/// same path whatever its place.
template <class Width, class Function>
inline void for_each_vector(Width width, double* result, const double* x, Function function) {
  using Vector = xsimd::batch<double>;
  std::size_t i = 0;
  for (; i + Vector::size <= width.value; i += Vector::size) {
    function(Vector::load_unaligned(x + i)).store_unaligned(result + i);
  }
  if constexpr (!Width::is_full) {
    if (i == width.value) return;
    alignas(64) std::array<double, Vector::size> padded{};
    for (std::size_t j = i; j < width.value; ++j) padded[j - i] = x[j];
    function(Vector::load_aligned(padded.data())).store_aligned(padded.data());
    for (std::size_t j = i; j < width.value; ++j) result[j] = padded[j - i];
  }
}

template <class Width>
inline void run(const TapeInstruction& instruction, double* const* columns, Width width) {
  double* result = columns[instruction.result];
  const double* x = columns[instruction.left];
  const double* y = columns[instruction.right];
  switch (instruction.operation) {
    case Operation::add:
      return for_each(width, result, x, y, [](double a, double b) { return a + b; });
    case Operation::subtract:
      return for_each(width, result, x, y, [](double a, double b) { return a - b; });
    case Operation::multiply:
      return for_each(width, result, x, y, [](double a, double b) { return a * b; });
    case Operation::divide:
      return for_each(width, result, x, y, [](double a, double b) { return a / b; });
    case Operation::negate:
      return for_each(width, result, x, [](double a) { return -a; });
    case Operation::reciprocal:
      return for_each(width, result, x, [](double a) { return 1.0 / a; });
    case Operation::square_root:
      return for_each(width, result, x, [](double a) { return std::sqrt(a); });
    case Operation::sine:
      return for_each_vector(width, result, x, [](const auto& a) { return xsimd::sin(a); });
    case Operation::cosine:
      return for_each_vector(width, result, x, [](const auto& a) { return xsimd::cos(a); });
    case Operation::exponential:
      return for_each(width, result, x, [](double a) { return std::exp(a); });
    case Operation::logarithm:
      return for_each(width, result, x, [](double a) { return std::log(a); });
    case Operation::tangent:
      return for_each(width, result, x, [](double a) { return std::tan(a); });
    case Operation::arc_sine:
      return for_each(width, result, x, [](double a) { return std::asin(a); });
    case Operation::arc_cosine:
      return for_each(width, result, x, [](double a) { return std::acos(a); });
    case Operation::arc_tangent:
      return for_each(width, result, x, [](double a) { return std::atan(a); });
    case Operation::arc_tangent2:
      return for_each(width, result, x, y, [](double a, double b) { return std::atan2(a, b); });
    case Operation::hyperbolic_sine:
      return for_each(width, result, x, [](double a) { return std::sinh(a); });
    case Operation::hyperbolic_cosine:
      return for_each(width, result, x, [](double a) { return std::cosh(a); });
    case Operation::hyperbolic_tangent:
      return for_each(width, result, x, [](double a) { return std::tanh(a); });
    case Operation::power: {
      const double exponent = instruction.exponent;
      return for_each(width, result, x, [exponent](double a) { return std::pow(a, exponent); });
    }
    case Operation::constant:  // a value that is an output as it stands: copied
    case Operation::input:
      return for_each(width, result, x, [](double a) { return a; });
  }
}

}  // namespace

void DMOCBENCH_TAPE_KERNEL(const TapeInstruction* instructions, std::size_t count, double* const* columns,
                           std::size_t width) {
  if (width == tape_block_width) {
    for (std::size_t i = 0; i < count; ++i) run(instructions[i], columns, FullWidth{});
  } else {
    for (std::size_t i = 0; i < count; ++i) run(instructions[i], columns, PartialWidth{width});
  }
}

}  // namespace dmocbench
