// Compiled once per instruction set, with the flags of that set and DMOCBENCH_TAPE_KERNEL naming the function. Only
// headers whose functions are inlined, or in a namespace of this set alone, may be used here: a function compiled with
// wide instructions and kept by the linker for all callers would stop a processor that lacks them. (CMake gives the
// namespace xsimd another name per set for this reason.)
#include "methods/expression/tape_kernel.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

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

/// The result of an operation on one or two numbers.
template <Operation operation>
inline double value_of(double x, double y, double exponent) {
  switch (operation) {  // a constant at compile time
    case Operation::add:
      return x + y;
    case Operation::subtract:
      return x - y;
    case Operation::multiply:
      return x * y;
    case Operation::divide:
      return x / y;
    case Operation::negate:
      return -x;
    case Operation::reciprocal:
      return 1.0 / x;
    case Operation::square_root:
      return std::sqrt(x);
    case Operation::logarithm:
      return std::log(x);
    case Operation::arc_tangent2:
      return std::atan2(x, y);
    case Operation::power:
      return std::pow(x, exponent);
    default:  // a constant or an input that is an output: copied
      return x;
  }
}

using Vector = xsimd::batch<double>;

/// Functions with a vector form, whose error is a few units in the last place (tests/expression). xsimd's logarithm is
/// not among them, because it is wrong for subnormal numbers.
constexpr bool has_vector_form(Operation operation) {
  switch (operation) {
    case Operation::exponential:
    case Operation::sine:
    case Operation::cosine:
    case Operation::tangent:
    case Operation::arc_sine:
    case Operation::arc_cosine:
    case Operation::arc_tangent:
    case Operation::hyperbolic_sine:
    case Operation::hyperbolic_cosine:
    case Operation::hyperbolic_tangent:
      return true;
    default:
      return false;
  }
}

template <Operation operation>
inline Vector vector_of(const Vector& x) {
  switch (operation) {
    case Operation::exponential:
      return xsimd::exp(x);
    case Operation::sine:
      return xsimd::sin(x);
    case Operation::cosine:
      return xsimd::cos(x);
    case Operation::tangent:
      return xsimd::tan(x);
    case Operation::arc_sine:
      return xsimd::asin(x);
    case Operation::arc_cosine:
      return xsimd::acos(x);
    case Operation::arc_tangent:
      return xsimd::atan(x);
    case Operation::hyperbolic_sine:
      return xsimd::sinh(x);
    case Operation::hyperbolic_cosine:
      return xsimd::cosh(x);
    case Operation::hyperbolic_tangent:
      return xsimd::tanh(x);
    default:
      return x;
  }
}

template <Combination combination>
inline double value_of(double x, double y) {
  switch (combination) {
    case Combination::add:
      return x + y;
    case Combination::subtract:
      return x - y;
    case Combination::multiply:
      return x * y;
    case Combination::subtract_from:
      return y - x;
  }
}

/// Carries out one instruction.
template <class Width>
using Handler = void (*)(const TapeInstruction& instruction, double* const* series, Width width);

template <Operation operation, class Width>
void run_alone(const TapeInstruction& instruction, double* const* series, Width width) {
  double* result = series[instruction.result];
  const double* x = series[instruction.operands[0]];
  const double exponent = instruction.exponent;
  if constexpr (operand_count(operation) > 1) {
    const double* y = series[instruction.operands[1]];
#pragma GCC ivdep
    for (std::size_t i = 0; i < width.value; ++i) result[i] = value_of<operation>(x[i], y[i], exponent);
  } else {
#pragma GCC ivdep
    for (std::size_t i = 0; i < width.value; ++i) result[i] = value_of<operation>(x[i], 0.0, exponent);
  }
}

/// (a ∘ b) ∘ c
template <Combination inner, Combination outer, class Width>
void run_pair(const TapeInstruction& instruction, double* const* series, Width width) {
  double* result = series[instruction.result];
  const double* a = series[instruction.operands[0]];
  const double* b = series[instruction.operands[1]];
  const double* c = series[instruction.operands[2]];
#pragma GCC ivdep
  for (std::size_t i = 0; i < width.value; ++i) result[i] = value_of<outer>(value_of<inner>(a[i], b[i]), c[i]);
}

/// ((a ∘ b) ∘ c) ∘ d
template <Combination inner, Combination middle, Combination outer, class Width>
void run_chain(const TapeInstruction& instruction, double* const* series, Width width) {
  double* result = series[instruction.result];
  const double* a = series[instruction.operands[0]];
  const double* b = series[instruction.operands[1]];
  const double* c = series[instruction.operands[2]];
  const double* d = series[instruction.operands[3]];
#pragma GCC ivdep
  for (std::size_t i = 0; i < width.value; ++i) {
    result[i] = value_of<outer>(value_of<middle>(value_of<inner>(a[i], b[i]), c[i]), d[i]);
  }
}

/// (a ∘ b) ∘ (c ∘ d)
template <Combination left, Combination right, Combination outer, class Width>
void run_tree(const TapeInstruction& instruction, double* const* series, Width width) {
  double* result = series[instruction.result];
  const double* a = series[instruction.operands[0]];
  const double* b = series[instruction.operands[1]];
  const double* c = series[instruction.operands[2]];
  const double* d = series[instruction.operands[3]];
#pragma GCC ivdep
  for (std::size_t i = 0; i < width.value; ++i) {
    result[i] = value_of<outer>(value_of<left>(a[i], b[i]), value_of<right>(c[i], d[i]));
  }
}

/// Passes a series to `function(vector, i, count)`, vector by vector. The remainder is padded to a vector of which only
/// `count` numbers are used, so that every number is computed in the same way wherever it stands.
template <class Width, class Function>
inline void for_each_vector(Width width, const double* x, Function function) {
  std::size_t i = 0;
  for (; i + Vector::size <= width.value; i += Vector::size) function(Vector::load_unaligned(x + i), i, Vector::size);
  if constexpr (!Width::is_full) {
    if (i == width.value) return;
    alignas(64) std::array<double, Vector::size> padded{};
    for (std::size_t j = i; j < width.value; ++j) padded[j - i] = x[j];
    function(Vector::load_aligned(padded.data()), i, width.value - i);
  }
}

/// The first `count` numbers of a vector.
inline void store(const Vector& values, double* result, std::size_t count) {
  if (count == Vector::size) return values.store_unaligned(result);
  alignas(64) std::array<double, Vector::size> padded{};
  values.store_aligned(padded.data());
  for (std::size_t j = 0; j < count; ++j) result[j] = padded[j];
}

template <Operation operation, class Width>
void run_vectors(const TapeInstruction& instruction, double* const* series, Width width) {
  double* result = series[instruction.result];
  for_each_vector(width, series[instruction.operands[0]], [&](const Vector& x, std::size_t i, std::size_t count) {
    store(vector_of<operation>(x), result + i, count);
  });
}

template <class Width>
void run_sine_and_cosine(const TapeInstruction& instruction, double* const* series, Width width) {
  double* sines = series[instruction.result];
  double* cosines = series[instruction.second_result];
  for_each_vector(width, series[instruction.operands[0]], [&](const Vector& x, std::size_t i, std::size_t count) {
    const auto [sines_of_x, cosines_of_x] = xsimd::sincos(x);
    store(sines_of_x, sines + i, count);
    store(cosines_of_x, cosines + i, count);
  });
}

template <class Width>
using Handlers = std::array<Handler<Width>, instruction_code::count>;

constexpr Combination combination(std::size_t number) { return static_cast<Combination>(number); }

template <Operation operation, class Width>
constexpr Handler<Width> handler_alone() {
  if constexpr (has_vector_form(operation)) {
    return run_vectors<operation, Width>;
  } else {
    return run_alone<operation, Width>;
  }
}

template <class Width, std::size_t... k>
constexpr void add_operations(Handlers<Width>& handlers, std::index_sequence<k...> /*operations*/) {
  ((handlers[k] = handler_alone<static_cast<Operation>(k), Width>()), ...);
  handlers[instruction_code::sine_and_cosine] = run_sine_and_cosine<Width>;
}

template <class Width, std::size_t... k>
constexpr void add_pairs(Handlers<Width>& handlers, std::index_sequence<k...> /*pairs*/) {
  using instruction_code::combinations;
  ((handlers[instruction_code::first_pair + k] =
        run_pair<combination(k / combinations), combination(k % combinations), Width>),
   ...);
}

template <class Width, std::size_t... k>
constexpr void add_chains(Handlers<Width>& handlers, std::index_sequence<k...> /*chains*/) {
  using instruction_code::combinations;
  ((handlers[instruction_code::first_chain + k] =
        run_chain<combination(k / combinations / combinations), combination(k / combinations % combinations),
                  combination(k % combinations), Width>),
   ...);
}

template <class Width, std::size_t... k>
constexpr void add_trees(Handlers<Width>& handlers, std::index_sequence<k...> /*trees*/) {
  using instruction_code::innermost;
  ((handlers[instruction_code::first_tree + k] =
        run_tree<combination(k / innermost / innermost), combination(k / innermost % innermost),
                 combination(k % innermost), Width>),
   ...);
}

/// Indexed by instruction code.
template <class Width>
constexpr Handlers<Width> all_handlers() {
  Handlers<Width> handlers{};
  add_operations(handlers, std::make_index_sequence<instruction_code::sine_and_cosine>{});
  add_pairs(handlers, std::make_index_sequence<instruction_code::pairs>{});
  add_chains(handlers, std::make_index_sequence<instruction_code::chains>{});
  add_trees(handlers, std::make_index_sequence<instruction_code::trees>{});
  return handlers;
}

template <class Width>
inline void run(const TapeInstruction* instructions, std::size_t count, double* const* series, Width width) {
  static constexpr Handlers<Width> handlers = all_handlers<Width>();
  for (std::size_t i = 0; i < count; ++i) handlers[instructions[i].code](instructions[i], series, width);
}

}  // namespace

void DMOCBENCH_TAPE_KERNEL(const TapeInstruction* instructions, std::size_t count, double* const* series,
                           std::size_t width) {
  if (width == tape_block_width) {
    run(instructions, count, series, FullWidth{});
  } else {
    run(instructions, count, series, PartialWidth{width});
  }
}

}  // namespace dmocbench
