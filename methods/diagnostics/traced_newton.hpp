#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "methods/error.hpp"
#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "methods/numerics/dense_solve.hpp"

namespace dmocbench {

/// Newton's method with exact derivatives for traced equations: R(w, parameters) = 0, w a block of
/// consecutive inputs. `Scalar` is double or long double.
template <class Scalar>
class TracedNewton {
 public:
  /// No equations.
  TracedNewton() = default;
  /// `residual` has `count` entries; the unknowns are the inputs `first` .. `first + count - 1`.
  TracedNewton(const ExpressionVector& residual, std::size_t first, Eigen::Index count) : first_(first), count_(count) {
    if (residual.size() != count) throw Error("Newton's method needs as many equations as unknowns");
    const ExpressionMatrix derivative = jacobian(residual, input_vector(first, count));
    std::vector<Expression> outputs(residual.begin(), residual.end());
    outputs.insert(outputs.end(), derivative.data(), derivative.data() + derivative.size());
    schedule_ = Schedule(outputs);
  }

  /// The operations of one evaluation of equations and derivatives.
  [[nodiscard]] std::size_t operations() const noexcept { return schedule_.operation_count(); }

  /// Moves the unknowns among `inputs` from where they are to the root. Throws `Error` if the iteration does not
  /// converge.
  void solve(std::vector<Scalar>& inputs) const {
    using std::abs, std::isfinite, std::pow;
    using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
    if (count_ == 0) return;
    // Convergence is quadratic: a step of this size leaves an error of rounding.
    const Scalar last_step = pow(std::numeric_limits<Scalar>::epsilon(), Scalar(0.65));
    Eigen::Map<Vector> unknowns(inputs.data() + first_, count_);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const std::vector<Scalar> values = replay<Scalar>(schedule_, std::span<const Scalar>(inputs));
      const Vector residual = Eigen::Map<const Vector>(values.data(), count_);
      const Matrix derivative = Eigen::Map<const Matrix>(values.data() + count_, count_, count_);
      const Vector step = solve_square(derivative, residual);
      if (!step.allFinite()) break;
      unknowns -= step;
      if (step.template lpNorm<Eigen::Infinity>() <=
          last_step * (Scalar(1) + unknowns.template lpNorm<Eigen::Infinity>())) {
        return;
      }
    }
    throw Error("Newton's method does not converge on the equations of an interval; the step is too large");
  }

 private:
  static constexpr int most_iterations = 50;
  std::size_t first_ = 0;
  Eigen::Index count_ = 0;
  Schedule schedule_;  // outputs: R, then ∂R/∂w column by column
};

/// Hands out the outputs of a schedule as the matrices that were appended to it, one after the other.
template <class Scalar>
class OutputBlocks {
 public:
  /// A matrix of these numbers.
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  /// Evaluates all outputs at these inputs.
  OutputBlocks(const Schedule& schedule, const std::vector<Scalar>& inputs)
      : values_(replay<Scalar>(schedule, std::span<const Scalar>(inputs))), next_(values_.data()) {}

  /// The next rows × columns outputs, column by column.
  [[nodiscard]] Matrix take(Eigen::Index rows, Eigen::Index columns = 1) {
    next_ += rows * columns;
    return Eigen::Map<const Matrix>(next_ - rows * columns, rows, columns);
  }

 private:
  std::vector<Scalar> values_;
  const Scalar* next_;
};

}  // namespace dmocbench
