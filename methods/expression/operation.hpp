#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace dmocbench {

/// The operation of a node in a traced formula.
///
/// A quotient a / b is recorded as a · (1 / b), so that every formula that divides by b shares one division; `Schedule`
/// turns it back into a quotient where the reciprocal has a single reader.
enum class Operation : std::uint8_t {
  constant,
  input,
  add,
  subtract,
  multiply,
  divide,
  negate,
  reciprocal,
  square_root,
  exponential,
  logarithm,
  sine,
  cosine,
  tangent,
  arc_sine,
  arc_cosine,
  arc_tangent,
  arc_tangent2,
  hyperbolic_sine,
  hyperbolic_cosine,
  hyperbolic_tangent,
  power,
  /// log(x + √(x² + 1)), exact enough by that formula for x >= 0; odd.
  inverse_hyperbolic_sine,
  /// 2/√π ∫₀ˣ exp(-t²) dt, which has no elementary form; odd.
  error_function,
  /// 1 where the operand is positive, else 0; its derivative counts as 0. Where a spline passes from one cubic to the
  /// next.
  unit_step,
};

/// Number of operands: 0 for constants and inputs, 1 or 2 otherwise. `power` has 1; its exponent is part of the node.
[[nodiscard]] constexpr std::size_t operand_count(Operation operation) noexcept {
  switch (operation) {
    case Operation::constant:
    case Operation::input:
      return 0;
    case Operation::add:
    case Operation::subtract:
    case Operation::multiply:
    case Operation::divide:
    case Operation::arc_tangent2:
      return 2;
    default:
      return 1;
  }
}

namespace detail {
/// The value of `Operation::unit_step` at a number; NaN passes.
template <std::floating_point Real>
[[nodiscard]] constexpr Real unit_step(Real x) noexcept {
  if (x > Real(0)) return Real(1);
  return x <= Real(0) ? Real(0) : x;
}
}  // namespace detail

}  // namespace dmocbench
