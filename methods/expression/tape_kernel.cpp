// Compiled once per instruction set, with the flags of that set and DMOCBENCH_TAPE_KERNEL naming the function. Only
// headers whose functions are inlined, or in a namespace of this set alone, may be used here: a function compiled with
// wide instructions and kept by the linker for all callers would stop a processor that lacks them. (CMake gives the
// namespace xsimd another name per set for this reason.)
#include "methods/expression/tape_kernel.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include <xsimd/xsimd.hpp>

#include "methods/expression/operation.hpp"
#include "methods/runtime/independent_iterations.hpp"

namespace dmocbench {

namespace {

/// All numbers of a block: the length of its loops is known at compile time.
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
    case Operation::inverse_hyperbolic_sine:
      return std::asinh(x);
    case Operation::error_function:
      return std::erf(x);
    case Operation::unit_step:
      return x > 0.0 ? 1.0 : x <= 0.0 ? 0.0 : x;  // not the template of operation.hpp, which one set might keep for all
    default:                                      // a constant or an input that is an output: copied
      return x;
  }
}

using Vector = xsimd::batch<double>;

/// Functions with a vector form, whose error is a few units in the last place (tests/expression); no result for other
/// operations. xsimd's logarithm is not among them, because it is wrong for subnormal numbers.
template <Operation operation>
inline auto vector_of([[maybe_unused]] const Vector& x) {
  if constexpr (operation == Operation::exponential) return xsimd::exp(x);
  if constexpr (operation == Operation::sine) return xsimd::sin(x);
  if constexpr (operation == Operation::cosine) return xsimd::cos(x);
  if constexpr (operation == Operation::tangent) return xsimd::tan(x);
  if constexpr (operation == Operation::arc_sine) return xsimd::asin(x);
  if constexpr (operation == Operation::arc_cosine) return xsimd::acos(x);
  if constexpr (operation == Operation::arc_tangent) return xsimd::atan(x);
  if constexpr (operation == Operation::hyperbolic_sine) return xsimd::sinh(x);
  if constexpr (operation == Operation::hyperbolic_cosine) return xsimd::cosh(x);
  if constexpr (operation == Operation::hyperbolic_tangent) return xsimd::tanh(x);
}

template <Operation operation>
constexpr bool has_vector_form = !std::is_void_v<decltype(vector_of<operation>(Vector()))>;

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

/// result[i] = function(a[i], b[i], ...) for as many operands as there are k.
template <class Width, class Function, std::size_t... k>
inline void for_each_number(const TapeInstruction& instruction, double* const* series, Width width, Function function,
                            std::index_sequence<k...> /*operands*/) {
  double* result = series[instruction.result];
  const std::array<const double*, sizeof...(k)> operands{series[instruction.operands[k]]...};
  DMOCBENCH_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < width.value; ++i) result[i] = function(operands[k][i]...);
}

template <Operation operation, class Width>
void run_alone(const TapeInstruction& instruction, double* const* series, Width width) {
  const double exponent = instruction.exponent;
  if constexpr (operand_count(operation) > 1) {
    const auto function = [=](double x, double y) { return value_of<operation>(x, y, exponent); };
    for_each_number(instruction, series, width, function, std::make_index_sequence<2>());
  } else {
    const auto function = [=](double x) { return value_of<operation>(x, 0.0, exponent); };
    for_each_number(instruction, series, width, function, std::make_index_sequence<1>());
  }
}

/// (a ∘ b) ∘ c
template <Combination inner, Combination outer, class Width>
void run_pair(const TapeInstruction& instruction, double* const* series, Width width) {
  const auto pair = [](double a, double b, double c) { return value_of<outer>(value_of<inner>(a, b), c); };
  for_each_number(instruction, series, width, pair, std::make_index_sequence<3>());
}

/// ((a ∘ b) ∘ c) ∘ d
template <Combination inner, Combination middle, Combination outer, class Width>
void run_chain(const TapeInstruction& instruction, double* const* series, Width width) {
  const auto chain = [](double a, double b, double c, double d) {
    return value_of<outer>(value_of<middle>(value_of<inner>(a, b), c), d);
  };
  for_each_number(instruction, series, width, chain, std::make_index_sequence<4>());
}

/// (a ∘ b) ∘ (c ∘ d)
template <Combination left, Combination right, Combination outer, class Width>
void run_tree(const TapeInstruction& instruction, double* const* series, Width width) {
  const auto tree = [](double a, double b, double c, double d) {
    return value_of<outer>(value_of<left>(a, b), value_of<right>(c, d));
  };
  for_each_number(instruction, series, width, tree, std::make_index_sequence<4>());
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

constexpr Combination combination(std::size_t number) { return static_cast<Combination>(number); }

template <std::size_t code, class Width>
constexpr Handler<Width> handler_of() {
  using namespace instruction_code;
  if constexpr (code < sine_and_cosine) {
    constexpr auto operation = static_cast<Operation>(code);
    if constexpr (has_vector_form<operation>) {
      return run_vectors<operation, Width>;
    } else {
      return run_alone<operation, Width>;
    }
  } else if constexpr (code == sine_and_cosine) {
    return run_sine_and_cosine<Width>;
  } else if constexpr (code < first_chain) {
    constexpr std::size_t k = code - first_pair;
    return run_pair<combination(k / combinations), combination(k % combinations), Width>;
  } else if constexpr (code < first_tree) {
    constexpr std::size_t k = code - first_chain;
    return run_chain<combination(k / combinations / combinations), combination(k / combinations % combinations),
                     combination(k % combinations), Width>;
  } else {
    constexpr std::size_t k = code - first_tree;
    return run_tree<combination(k / innermost / innermost), combination(k / innermost % innermost),
                    combination(k % innermost), Width>;
  }
}

/// Indexed by instruction code.
template <class Width, std::size_t... code>
constexpr std::array<Handler<Width>, sizeof...(code)> all_handlers(std::index_sequence<code...> /*codes*/) {
  return {handler_of<code, Width>()...};
}

template <class Width>
inline void run(const TapeInstruction* instructions, std::size_t count, double* const* series, Width width) {
  static constexpr auto handlers = all_handlers<Width>(std::make_index_sequence<instruction_code::count>());
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
