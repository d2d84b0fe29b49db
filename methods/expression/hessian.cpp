#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <vector>

#include "methods/expression/affine_arguments.hpp"
#include "methods/expression/derivatives.hpp"

namespace dmocbench {

namespace {

using detail::Node;

/// The products of the entries of a matrix A in pairs. Its entries repeat, so a product is made once.
class PairProducts {
 public:
  explicit PairProducts(const ExpressionMatrix& a) : a_(a), numbers_(a.rows(), a.cols()) {
    std::unordered_map<const Node*, Eigen::Index> number_of;
    for (Eigen::Index i = 0; i < a.size(); ++i) {
      numbers_.data()[i] =
          number_of.try_emplace(a.data()[i].node(), static_cast<Eigen::Index>(number_of.size())).first->second;
    }
    const auto count = static_cast<Eigen::Index>(number_of.size());
    is_known_ = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>::Zero(count, count);
    products_.resize(count, count);
  }

  /// A_ia A_jb
  const Expression& operator()(Eigen::Index i, Eigen::Index a, Eigen::Index j, Eigen::Index b) {
    const Eigen::Index left = numbers_(i, a);
    const Eigen::Index right = numbers_(j, b);
    if (!is_known_(left, right)) {
      products_(left, right) = products_(right, left) = a_(i, a) * a_(j, b);
      is_known_(left, right) = is_known_(right, left) = true;
    }
    return products_(left, right);
  }

 private:
  const ExpressionMatrix& a_;
  Eigen::Matrix<Eigen::Index, Eigen::Dynamic, Eigen::Dynamic> numbers_;  // of the distinct entries
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> is_known_;
  ExpressionMatrix products_;
};

/// Aᵀ g A for a symmetric g, entry by entry of the lower triangle of g.
class Congruence {
 public:
  explicit Congruence(const ExpressionMatrix& a)
      : products_(a), columns_(static_cast<std::size_t>(a.rows())), sum_(a.cols(), a.cols()) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      for (Eigen::Index k = 0; k < a.cols(); ++k) {
        if (!a(i, k).is_zero()) columns_[static_cast<std::size_t>(i)].push_back(k);
      }
    }
  }

  /// Adds (A_ik A_jl + A_jk A_il) g_ij to entry (k, l), without the second product where i = j. The factor comes first:
  /// many of these sums cancel.
  void add(Eigen::Index i, Eigen::Index j, const Expression& entry) {
    const auto& of_i = columns_[static_cast<std::size_t>(i)];
    const auto& of_j = columns_[static_cast<std::size_t>(j)];
    std::vector<Eigen::Index> both;
    std::ranges::set_union(of_i, of_j, std::back_inserter(both));
    shares_.clear();
    for (std::size_t a = 0; a < both.size(); ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        const Expression factor = factor_of(i, j, both[a], both[b]);
        if (factor.is_zero()) continue;
        sum_(both[a], both[b]) += share(factor, entry);
      }
    }
  }

  [[nodiscard]] ExpressionMatrix symmetric_sum() && {
    for (Eigen::Index a = 0; a < sum_.rows(); ++a) {
      for (Eigen::Index b = 0; b < a; ++b) sum_(b, a) = sum_(a, b);
    }
    return std::move(sum_);
  }

 private:
  /// Few factors differ.
  Expression share(const Expression& factor, const Expression& entry) {
    const auto known = std::ranges::find_if(shares_, [&](const auto& share) { return share.first.is_same(factor); });
    if (known != shares_.end()) return known->second;
    return shares_.emplace_back(factor, factor * entry).second;
  }

  Expression factor_of(Eigen::Index i, Eigen::Index j, Eigen::Index k, Eigen::Index l) {
    const Expression& straight = products_(i, k, j, l);
    if (i == j) return straight;
    const Expression& crossed = products_(j, k, i, l);
    if (crossed.is_zero()) return straight;
    return straight.is_zero() ? crossed : straight + crossed;
  }

  PairProducts products_;
  std::vector<std::vector<Eigen::Index>> columns_;         // nonzero columns of every row of A
  std::vector<std::pair<Expression, Expression>> shares_;  // a factor, and its product with the entry
  ExpressionMatrix sum_;
};

}  // namespace

DefinedDerivatives gradient_and_hessian(const Expression& f, const ExpressionVector& x) {
  const AffineArguments arguments(std::span(&f, 1), x);
  const ExpressionVector& y = arguments.definitions().inputs;
  const ExpressionVector by_arguments = gradient(arguments.formulas().front(), y);
  const ExpressionMatrix twice = symmetric_jacobian(by_arguments, y);
  const ExpressionMatrix& a = arguments.coefficients();
  Congruence second(a);
  ExpressionVector first(x.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      if (!a(i, k).is_zero()) first[k] += a(i, k) * by_arguments[i];
    }
    for (Eigen::Index j = 0; j <= i; ++j) {
      if (!twice(i, j).is_zero()) second.add(i, j, twice(i, j));
    }
  }
  return {.gradient = first, .hessian = std::move(second).symmetric_sum(), .definitions = arguments.definitions()};
}

ExpressionMatrix hessian(const Expression& f, const ExpressionVector& x) {
  const DefinedDerivatives derivatives = gradient_and_hessian(f, x);
  const ExpressionMatrix& entries = derivatives.hessian;
  const std::vector<Expression> result = replaced({entries.data(), static_cast<std::size_t>(entries.size())},
                                                  derivatives.definitions.inputs, derivatives.definitions.formulas);
  return Eigen::Map<const ExpressionMatrix>(result.data(), x.size(), x.size());
}

}  // namespace dmocbench
