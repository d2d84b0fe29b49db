#include "methods/extensions/primitives/symmetry_group.hpp"

#include <algorithm>
#include <utility>

#include "methods/error.hpp"
#include "methods/mechanics/point_function.hpp"

namespace dmocbench {

Displacement Displacement::identity(Eigen::Index n) { return translation(Eigen::VectorXd::Zero(n)); }

Displacement Displacement::translation(Eigen::VectorXd b) {
  const Eigen::Index n = b.size();
  return {.linear = Eigen::MatrixXd::Identity(n, n), .shift = std::move(b)};
}

Displacement Displacement::after(const Displacement& other) const {
  return {.linear = linear * other.linear, .shift = configuration(other.shift)};
}

double Displacement::distance(const Displacement& other) const {
  return std::max((linear - other.linear).lpNorm<Eigen::Infinity>(), (shift - other.shift).lpNorm<Eigen::Infinity>());
}

namespace {

std::vector<Generator> generators_of(const Problem& problem) {
  if (!problem.symmetry(input_vector(0, problem.configuration_size()))) {
    throw Error("{} defines no symmetry, so it has no trims", problem.name());
  }
  return {[&problem](const ExpressionVector& q) { return problem.symmetry(q).value(); }};
}

/// A and b of one generator, read off at 0 and the unit vectors.
Displacement affine_parts(const Problem& problem, const Generator& generator) {
  const Eigen::Index n = problem.configuration_size();
  PointFunction function(n, problem.control_size(), [&](const ControlledState& x) { return generator(x.q); });
  const auto at = [&](const Eigen::VectorXd& q) {
    Eigen::VectorXd value(n);
    function.evaluate(q, Eigen::VectorXd::Zero(n), Eigen::VectorXd(), 0.0, value);
    return value;
  };
  Displacement parts{.linear = Eigen::MatrixXd(n, n), .shift = at(Eigen::VectorXd::Zero(n))};
  for (Eigen::Index i = 0; i < n; ++i) parts.linear.col(i) = at(Eigen::VectorXd::Unit(n, i)) - parts.shift;
  const Eigen::VectorXd elsewhere = Eigen::VectorXd::LinSpaced(n, -1.3, 2.9);
  if (!(at(elsewhere) - parts.configuration(elsewhere)).isZero(1e-12)) {
    throw Error("a generator of {} is not affine in the configuration", problem.name());
  }
  return parts;
}

/// exp(M) by Taylor's polynomial at M/2^k, squared k times. (The one that comes with Eigen takes a compiler seconds.)
Eigen::MatrixXd exponential(Eigen::MatrixXd m) {
  constexpr int degree = 12;  // enough for rounding where |M| <= 1/8
  int halvings = 0;
  for (; m.lpNorm<Eigen::Infinity>() > 0.125 && halvings < 100; ++halvings) m *= 0.5;
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(m.rows(), m.cols());
  Eigen::MatrixXd sum = identity;
  for (int k = degree; k >= 1; --k) sum = identity + (m / k) * sum;
  for (int k = 0; k < halvings; ++k) sum = Eigen::MatrixXd(sum * sum);
  return sum;
}

}  // namespace

SymmetryGroup::SymmetryGroup(const Problem& problem) : SymmetryGroup(problem, generators_of(problem)) {}

SymmetryGroup::SymmetryGroup(const Problem& problem, std::vector<Generator> generators)
    : generators_(std::move(generators)) {
  if (generators_.empty()) throw Error("a symmetry group needs at least one generator");
  for (const Generator& each : generators_) affine_.push_back(affine_parts(problem, each));
}

ExpressionVector SymmetryGroup::traced_velocity(const ExpressionVector& q, const ExpressionVector& rates) const {
  ExpressionVector sum = ExpressionVector::Constant(q.size(), Expression(0.0));
  for (Eigen::Index i = 0; i < dimension(); ++i) {
    const ExpressionVector generator = generators_[static_cast<std::size_t>(i)](q);
    for (Eigen::Index j = 0; j < q.size(); ++j) sum[j] = sum[j] + rates[i] * generator[j];
  }
  return sum;
}

Eigen::VectorXd SymmetryGroup::velocity(const Eigen::VectorXd& q, const Eigen::VectorXd& rates) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(q.size());
  for (Eigen::Index i = 0; i < dimension(); ++i)
    sum += rates[i] * affine_[static_cast<std::size_t>(i)].configuration(q);
  return sum;
}

Eigen::MatrixXd SymmetryGroup::algebra_element(const Eigen::VectorXd& rates) const {
  const Eigen::Index n = affine_.front().shift.size();
  Eigen::MatrixXd element = Eigen::MatrixXd::Zero(n + 1, n + 1);
  for (Eigen::Index i = 0; i < dimension(); ++i) {
    element.topLeftCorner(n, n) += rates[i] * affine_[static_cast<std::size_t>(i)].linear;
    element.topRightCorner(n, 1) += rates[i] * affine_[static_cast<std::size_t>(i)].shift;
  }
  return element;
}

Displacement SymmetryGroup::flow(const Eigen::VectorXd& rates, double time) const {
  const Eigen::MatrixXd moved = exponential(time * algebra_element(rates));
  const Eigen::Index n = moved.rows() - 1;
  return {.linear = moved.topLeftCorner(n, n), .shift = moved.topRightCorner(n, 1)};
}

}  // namespace dmocbench
