#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "tests/support/random_points.hpp"

namespace dmocbench::tests {

/// A random straight-line program with much sharing that runs on any scalar: on `Expression` it
/// traces, on double it computes what the traced graph has to come to.
///
/// It is grown around a random point: an operation is kept only if its value there is moderate and
/// the operand is well inside the domain.
class RandomProgram {
 public:
  RandomProgram(RandomPoints& random, std::size_t input_count, std::size_t step_count, std::size_t output_count)
      : input_count_(input_count) {
    point_.resize(input_count);
    for (double& coordinate : point_) coordinate = random.number(-2.0, 2.0);
    std::vector<double> values = leaves(std::span<const double>(point_));
    while (steps_.size() < step_count) {
      const Step step{static_cast<Kind>(below(random, kind_count)), place(random, values.size()),
                      place(random, values.size()), exponents[below(random, exponents.size())]};
      if (!is_inside(step, values[step.left], values[step.right])) continue;
      const double value = apply(step, values[step.left], values[step.right]);
      if (std::abs(value) > largest) continue;
      values.push_back(value);
      steps_.push_back(step);
    }
    outputs_.resize(output_count);
    for (std::size_t& output : outputs_) output = values.size() - 1 - below(random, step_count / 2);
  }

  /// Where the program was grown.
  [[nodiscard]] const std::vector<double>& point() const { return point_; }

  template <class Scalar>
  [[nodiscard]] std::vector<Scalar> run(std::span<const Scalar> inputs) const {
    std::vector<Scalar> values = leaves(inputs);
    values.reserve(values.size() + steps_.size());
    for (const Step& step : steps_) {
      values.push_back(apply(step, values[step.left], values[step.right]));
    }
    std::vector<Scalar> results;
    results.reserve(outputs_.size());
    for (const std::size_t output : outputs_) results.push_back(values[output]);
    return results;
  }

 private:
  enum class Kind : unsigned char {
    add,
    subtract,
    multiply,
    divide,
    negate,
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
    another_multiply,  // formulas are mostly products and sums
    another_add,
    count
  };
  static constexpr std::size_t kind_count = static_cast<std::size_t>(Kind::count);
  static constexpr double largest = 20.0;
  static constexpr std::array exponents{0.5, -0.5, 1.5, -1.5, 2.0, 3.0, -1.0, -2.0, 5.0, 0.7, -1.3};
  // What folding acts on is among the constants.
  static constexpr std::array constants{0.0, 1.0, -1.0, 0.5, -3.0};

  struct Step {
    Kind kind;
    std::size_t left;
    std::size_t right;
    double exponent;
  };

  static std::size_t below(RandomPoints& random, std::size_t bound) {
    return static_cast<std::size_t>(random.number(0.0, static_cast<double>(bound)));
  }

  /// A leaf or any earlier value, recent ones more often: chains as well as sharing.
  static std::size_t place(RandomPoints& random, std::size_t size) {
    const std::size_t recent = size < 6 ? size : 6;
    return random.number() < 0.0 ? below(random, size) : size - 1 - below(random, recent);
  }

  /// The inputs, then the constants.
  template <class Scalar>
  [[nodiscard]] std::vector<Scalar> leaves(std::span<const Scalar> inputs) const {
    std::vector<Scalar> values;
    values.reserve(input_count_ + constants.size());
    values.assign(inputs.begin(), inputs.begin() + static_cast<std::ptrdiff_t>(input_count_));
    for (const double constant : constants) values.push_back(Scalar(constant));
    return values;
  }

  static bool is_inside(const Step& step, double x, double y) {
    switch (step.kind) {
      case Kind::divide:
        return std::abs(y) > 0.2;
      case Kind::square_root:
      case Kind::logarithm:
        return x > 0.1;
      case Kind::tangent:
        return std::abs(std::cos(x)) > 0.3;
      case Kind::arc_sine:
      case Kind::arc_cosine:
        return std::abs(x) < 0.9;
      case Kind::arc_tangent2:  // away from the origin and from the cut
        return x * x + y * y > 0.1 && (y > 0.1 || std::abs(x) > 0.1);
      case Kind::power:
        return x > 0.2;
      default:
        return true;
    }
  }

  template <class Scalar>
  static Scalar apply(const Step& step, const Scalar& x, const Scalar& y) {
    using std::acos, std::asin, std::atan, std::atan2, std::cos, std::cosh, std::exp, std::log, std::pow, std::sin,
        std::sinh, std::sqrt, std::tan, std::tanh;
    switch (step.kind) {
      case Kind::add:
      case Kind::another_add:
        return Scalar(x + y);
      case Kind::subtract:
        return Scalar(x - y);
      case Kind::multiply:
      case Kind::another_multiply:
        return Scalar(x * y);
      case Kind::divide:
        return Scalar(x / y);
      case Kind::negate:
        return Scalar(-x);
      case Kind::square_root:
        return Scalar(sqrt(x));
      case Kind::exponential:
        return Scalar(exp(x));
      case Kind::logarithm:
        return Scalar(log(x));
      case Kind::sine:
        return Scalar(sin(x));
      case Kind::cosine:
        return Scalar(cos(x));
      case Kind::tangent:
        return Scalar(tan(x));
      case Kind::arc_sine:
        return Scalar(asin(x));
      case Kind::arc_cosine:
        return Scalar(acos(x));
      case Kind::arc_tangent:
        return Scalar(atan(x));
      case Kind::arc_tangent2:
        return Scalar(atan2(x, y));
      case Kind::hyperbolic_sine:
        return Scalar(sinh(x));
      case Kind::hyperbolic_cosine:
        return Scalar(cosh(x));
      case Kind::hyperbolic_tangent:
        return Scalar(tanh(x));
      case Kind::power:
        return Scalar(pow(x, step.exponent));
      case Kind::count:
        break;
    }
    return x;
  }

  std::size_t input_count_;
  std::vector<double> point_;
  std::vector<Step> steps_;
  std::vector<std::size_t> outputs_;
};

}  // namespace dmocbench::tests
