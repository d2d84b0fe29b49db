#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "methods/error.hpp"
#include "methods/expression/schedule.hpp"

namespace dmocbench {

namespace detail {

/// One step on values of type Scalar. Functions are found by argument-dependent lookup, or in std.
template <class Scalar>
Scalar replay_operation(const Schedule::Step& step, const std::vector<Scalar>& values) {
  using std::acos, std::asin, std::asinh, std::atan, std::atan2, std::cos, std::cosh, std::erf, std::exp, std::log,
      std::pow, std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
  const Scalar& x = values[step.left];
  const Scalar& y = values[step.right];
  switch (step.operation) {
    case Operation::add:
      return Scalar(x + y);
    case Operation::subtract:
      return Scalar(x - y);
    case Operation::multiply:
      return Scalar(x * y);
    case Operation::divide:
      return Scalar(x / y);
    case Operation::negate:
      return Scalar(-x);
    case Operation::reciprocal:
      return Scalar(1.0 / x);
    case Operation::square_root:
      return Scalar(sqrt(x));
    case Operation::exponential:
      return Scalar(exp(x));
    case Operation::logarithm:
      return Scalar(log(x));
    case Operation::sine:
      return Scalar(sin(x));
    case Operation::cosine:
      return Scalar(cos(x));
    case Operation::tangent:
      return Scalar(tan(x));
    case Operation::arc_sine:
      return Scalar(asin(x));
    case Operation::arc_cosine:
      return Scalar(acos(x));
    case Operation::arc_tangent:
      return Scalar(atan(x));
    case Operation::arc_tangent2:
      return Scalar(atan2(x, y));
    case Operation::hyperbolic_sine:
      return Scalar(sinh(x));
    case Operation::hyperbolic_cosine:
      return Scalar(cosh(x));
    case Operation::hyperbolic_tangent:
      return Scalar(tanh(x));
    case Operation::power:
      return Scalar(pow(x, step.value));
    case Operation::inverse_hyperbolic_sine:
      return Scalar(asinh(x));
    case Operation::error_function:
      return Scalar(erf(x));
    case Operation::unit_step:
      return Scalar(unit_step(x));
    case Operation::constant:
    case Operation::input:
      break;
  }
  throw Error("a constant or an input is not an operation");
}

}  // namespace detail

/// Evaluates a schedule on any scalar: double, long double, the differentiating type of another package, or
/// `Expression` itself, which substitutes formulas for the inputs.
///
/// `inputs` has at least `schedule.input_count()` entries. Returns the outputs. Throws `Error` if inputs are missing.
template <class Scalar>
std::vector<Scalar> replay(const Schedule& schedule, std::span<const Scalar> inputs) {
  if (inputs.size() < schedule.input_count()) {
    throw Error("replay needs " + std::to_string(schedule.input_count()) + " inputs, got " +
                std::to_string(inputs.size()));
  }
  std::vector<Scalar> values;
  values.reserve(schedule.steps().size());
  for (const Schedule::Step& step : schedule.steps()) {
    if (step.operation == Operation::constant) {
      values.push_back(Scalar(step.value));
    } else if (step.operation == Operation::input) {
      values.push_back(inputs[step.input_index]);
    } else {
      values.push_back(detail::replay_operation(step, values));
    }
  }
  std::vector<Scalar> outputs;
  outputs.reserve(schedule.outputs().size());
  for (const std::uint32_t position : schedule.outputs()) outputs.push_back(values[position]);
  return outputs;
}

}  // namespace dmocbench
