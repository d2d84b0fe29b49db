#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "methods/expression/expression.hpp"

/// Eigen's traits of a traced number.
template <>
struct Eigen::NumTraits<dmocbench::Expression> : Eigen::GenericNumTraits<dmocbench::Expression> {
  using Real = dmocbench::Expression;        ///< required by Eigen: of a real number, itself
  using NonInteger = dmocbench::Expression;  ///< required by Eigen: type of quotients
  using Nested = dmocbench::Expression;      ///< required by Eigen: how operands are kept
  using Literal = double;                    ///< required by Eigen: type of constants in its code
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

/// Numbers and traced numbers may meet: 0.5 * x.v, Eigen::VectorXd + x.q.
template <class Operation>
struct Eigen::ScalarBinaryOpTraits<double, dmocbench::Expression, Operation> {
  using ReturnType = dmocbench::Expression;
};
template <class Operation>
struct Eigen::ScalarBinaryOpTraits<dmocbench::Expression, double, Operation> {
  using ReturnType = dmocbench::Expression;
};

namespace dmocbench {

namespace detail {
/// Throws `Error` with the sizes unless the factors of a product fit.
void require_factors(Eigen::Index rows, Eigen::Index columns, Eigen::Index other_rows, Eigen::Index other_columns);
/// Throws `Error` that names the vector, its size and the entry.
[[noreturn]] void throw_no_entry(char name, Eigen::Index entry, Eigen::Index size);
}  // namespace detail

/// A vector of traced numbers.
using ExpressionVector = Eigen::Matrix<Expression, Eigen::Dynamic, 1>;
/// A matrix of traced numbers; an entry that is the constant 0 is a structural zero.
using ExpressionMatrix = Eigen::Matrix<Expression, Eigen::Dynamic, Eigen::Dynamic>;

/// The two factors of a product of matrices or vectors, one of them traced, the other traced too or of numbers.
template <class Left, class Right>
concept TracedFactors = requires(const Left& a, const Right& b) {
  []<class A, class B>(const Eigen::MatrixBase<A>&, const Eigen::MatrixBase<B>&) {}(a, b);
  requires std::same_as<typename Left::Scalar, Expression> || std::same_as<typename Right::Scalar, Expression>;
  requires std::same_as<typename Left::Scalar, Expression> || std::same_as<typename Left::Scalar, double>;
  requires std::same_as<typename Right::Scalar, Expression> || std::same_as<typename Right::Scalar, double>;
};

/// The product of matrices, of a matrix and a vector, or of a row and a column, which is a number. (Eigen's own product
/// compares numbers, which traced numbers cannot.) Throws `Error` if the sizes do not fit.
template <class Left, class Right>
  requires TracedFactors<Left, Right>
[[nodiscard]] auto operator*(const Left& a, const Right& b) {
  constexpr int rows = Left::RowsAtCompileTime;
  constexpr int columns = Right::ColsAtCompileTime;
  detail::require_factors(a.rows(), a.cols(), b.rows(), b.cols());
  // Factors that are formulas themselves are computed once, not once for every entry.
  const auto& left = a.derived().eval();
  const auto& right = b.derived().eval();
  Eigen::Matrix<Expression, rows, columns> product(a.rows(), b.cols());
  for (Eigen::Index i = 0; i < product.rows(); ++i) {
    for (Eigen::Index j = 0; j < product.cols(); ++j) {
      Expression& entry = product(i, j);
      for (Eigen::Index k = 0; k < left.cols(); ++k) entry += left(i, k) * right(k, j);
    }
  }
  if constexpr (rows == 1 && columns == 1) {
    return Expression(product(0, 0));
  } else {
    return product;
  }
}

/// A vector whose name appears in errors: an entry that it does not have is an `Error`, not a read of foreign memory.
template <char name>
class NamedVector : public ExpressionVector {
 public:
  /// No entries.
  NamedVector() = default;
  /// Anything with entries: vectors, and Eigen's formulas of vectors.
  NamedVector(const ExpressionVector& entries) : ExpressionVector(entries) {}  // NOLINT(*-explicit-*)
  /// These entries.
  NamedVector(ExpressionVector&& entries) noexcept : ExpressionVector(std::move(entries)) {}  // NOLINT(*-explicit-*)
  /// These entries.
  template <class Derived>
  NamedVector(const Eigen::MatrixBase<Derived>& entries) : ExpressionVector(entries) {}  // NOLINT(*-explicit-*)

  /// The entry of that number, from 0. Throws `Error` that names the vector, the entry and the size if there is none.
  [[nodiscard]] const Expression& operator[](Eigen::Index entry) const { return coeffRef(checked(entry)); }
  /// An entry. Throws as the one above.
  [[nodiscard]] Expression& operator[](Eigen::Index entry) { return coeffRef(checked(entry)); }
  /// The same by parentheses.
  [[nodiscard]] const Expression& operator()(Eigen::Index entry) const { return coeffRef(checked(entry)); }
  /// The same by parentheses.
  [[nodiscard]] Expression& operator()(Eigen::Index entry) { return coeffRef(checked(entry)); }

 private:
  [[nodiscard]] Eigen::Index checked(Eigen::Index entry) const {
    if (entry < 0 || entry >= size()) detail::throw_no_entry(name, entry, size());
    return entry;
  }
};

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

/// One vector below the other.
[[nodiscard]] ExpressionVector stacked(const std::vector<ExpressionVector>& parts);

/// Appends the entries, column by column.
inline void append(std::vector<Expression>& outputs, const ExpressionMatrix& entries) {
  outputs.insert(outputs.end(), entries.data(), entries.data() + entries.size());
}

/// The solution x of A x = b as formulas of the entries of A (n × n, symmetric) and b (n entries).
///
/// The factors L D Lᵀ are taken without an exchange of rows, since a formula cannot depend on the size of a number.
/// Every leading minor of A must therefore be nonzero where the formulas are evaluated; the minors of a mass matrix are
/// positive. Throws `Error` with the sentence `singular` if a pivot is a structural zero.
[[nodiscard]] ExpressionVector solve_symmetric(
    const ExpressionMatrix& a, const ExpressionVector& b,
    const char* singular = "a system of linear equations has a pivot that is zero for all values of the inputs");

}  // namespace dmocbench
