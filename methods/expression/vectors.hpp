#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "methods/expression/expression.hpp"

/// Eigen's traits of a traced number.
template <>
struct Eigen::NumTraits<dmocbench::Expression> : Eigen::GenericNumTraits<dmocbench::Expression> {
  using Real = dmocbench::Expression;        ///< as Eigen asks: of a real number, itself
  using NonInteger = dmocbench::Expression;  ///< as Eigen asks: what quotients are
  using Nested = dmocbench::Expression;      ///< as Eigen asks: how operands are kept
  using Literal = double;                    ///< as Eigen asks: what constants in its code are
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = 3,
    MulCost = 3
  };
};

namespace dmocbench {

/// A vector of traced numbers.
using ExpressionVector = Eigen::Matrix<Expression, Eigen::Dynamic, 1>;
/// A matrix of traced numbers; an entry that is the constant 0 is a structural zero.
using ExpressionMatrix = Eigen::Matrix<Expression, Eigen::Dynamic, Eigen::Dynamic>;

/// Matrix times vector. (Eigen's own product compares numbers, which traced numbers cannot.) Other products of matrices
/// of expressions: `a.lazyProduct(b)`.
[[nodiscard]] inline ExpressionVector operator*(const ExpressionMatrix& a, const ExpressionVector& x) {
  return a.lazyProduct(x);
}

/// The entries of a vector in place, while it exists.
[[nodiscard]] inline std::span<const Expression> entries_of(const ExpressionVector& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

/// The inputs `first`, `first` + 1, ..., `count` of them.
[[nodiscard]] inline ExpressionVector input_vector(std::size_t first, Eigen::Index count) {
  ExpressionVector inputs(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    inputs[i] = Expression::input(first + static_cast<std::size_t>(i));
  }
  return inputs;
}

/// Hands out consecutive inputs, from number `first` on.
class InputCounter {
 public:
  /// The first input that is taken has this number.
  explicit InputCounter(std::size_t first = 0) : taken_(first) {}

  /// The next `count` inputs as a vector.
  [[nodiscard]] ExpressionVector take(Eigen::Index count) {
    ExpressionVector inputs = input_vector(taken_, count);
    taken_ += static_cast<std::size_t>(count);
    return inputs;
  }
  /// The next input.
  [[nodiscard]] Expression take() { return Expression::input(taken_++); }
  /// The number of the next input: with `first` = 0, how many were handed out so far.
  [[nodiscard]] std::size_t taken() const noexcept { return taken_; }

 private:
  std::size_t taken_;
};

/// Appends the entries, column by column.
inline void append(std::vector<Expression>& outputs, const ExpressionMatrix& entries) {
  outputs.insert(outputs.end(), entries.data(), entries.data() + entries.size());
}

}  // namespace dmocbench
