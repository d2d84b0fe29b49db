// Joining segments against eliminating them as one, on random linear-quadratic problems worked out densely.

#include "methods/kkt/intervals/segment_chain.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/support/random_points.hpp"

namespace dmocbench::kkt {
namespace {

using tests::RandomPoints;

/// x' = Ax + Bu + c at the cost ½xᵀQx + qᵀx + ½uᵀRu.
struct LinearQuadraticStep {
  Eigen::MatrixXd A;
  Eigen::MatrixXd B;
  Eigen::VectorXd c;
  Eigen::MatrixXd Q;
  Eigen::VectorXd q;
  Eigen::MatrixXd R;
};
using LinearQuadraticSteps = std::vector<LinearQuadraticStep>;

Eigen::MatrixXd random_block(RandomPoints& random, Eigen::Index rows, Eigen::Index columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&](auto, auto) { return random.number(); });
}

/// `convexity` is added to the diagonal of Q, which is small and indefinite without it.
LinearQuadraticSteps random_steps(RandomPoints& random, Eigen::Index states, Eigen::Index controls, int count,
                                  double convexity) {
  LinearQuadraticSteps steps;
  for (int k = 0; k < count; ++k) {
    const Eigen::MatrixXd Q = 0.2 * random_block(random, states, states);
    const Eigen::MatrixXd R = random_block(random, controls, controls);
    steps.push_back({.A = Eigen::MatrixXd::Identity(states, states) + 0.3 * random_block(random, states, states),
                     .B = random_block(random, states, controls),
                     .c = random.vector(states),
                     .Q = Q + Q.transpose() + convexity * Eigen::MatrixXd::Identity(states, states),
                     .q = random.vector(states),
                     .R = R * R.transpose() + Eigen::MatrixXd::Identity(controls, controls)});
  }
  return steps;
}

/// A quadratic form where its derivative with respect to all controls vanishes.
struct StationaryValue {
  SegmentValue value;
  Eigen::Index negative = 0;  ///< eigenvalues in the controls
  double smallest = 0.0;      ///< magnitude of these eigenvalues
};

/// Of steps begin .. end - 1 with the weights ρ at their end, from one dense quadratic form in (u, X, 1).
StationaryValue dense_stationary(const LinearQuadraticSteps& steps, std::size_t begin, std::size_t end,
                                 const Eigen::VectorXd& weights) {
  const Eigen::Index n = weights.size();
  const Eigen::Index m = steps[begin].B.cols();
  const Eigen::Index controls = m * static_cast<Eigen::Index>(end - begin);
  const Eigen::Index columns = controls + n + 1;
  Eigen::MatrixXd state = Eigen::MatrixXd::Zero(n, columns);  // as a function of (u, X, 1)
  state.block(0, controls, n, n).setIdentity();
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(columns, columns);
  for (std::size_t k = begin; k < end; ++k) {
    const LinearQuadraticStep& step = steps[k];
    const Eigen::Index u = m * static_cast<Eigen::Index>(k - begin);
    const Eigen::RowVectorXd linear = step.q.transpose() * state;
    form += state.transpose() * step.Q * state;
    form.row(columns - 1) += linear;
    form.col(columns - 1) += linear.transpose();
    form.block(u, u, m, m) += step.R;
    state = (step.A * state).eval();
    state.middleCols(u, m) += step.B;
    state.col(columns - 1) += step.c;
  }
  form += state.transpose() * weights.asDiagonal() * state;
  const Eigen::MatrixXd hessian = form.topLeftCorner(controls, controls);
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(hessian).eigenvalues();
  const Eigen::PartialPivLU<Eigen::MatrixXd> factor(hessian);
  const Eigen::MatrixXd mixed = form.block(controls, 0, n, controls);
  const Eigen::MatrixXd reached = state.leftCols(controls);
  const Eigen::VectorXd constant = form.col(columns - 1).head(controls);
  return {{.P = form.block(controls, controls, n, n) - mixed * factor.solve(mixed.transpose()),
           .p = form.col(columns - 1).segment(controls, n) - mixed * factor.solve(constant),
           .Phi = (state.middleCols(controls, n) - reached * factor.solve(mixed.transpose())).transpose(),
           .Gamma = reached * factor.solve(reached.transpose()),
           .gamma = state.col(columns - 1) - reached * factor.solve(constant)},
          (eigenvalues.array() < 0.0).count(),
          eigenvalues.cwiseAbs().minCoeff()};
}

/// The value of steps begin .. end - 1; none if it has no minimum in the controls.
std::optional<SegmentValue> dense_value(const LinearQuadraticSteps& steps, std::size_t begin, std::size_t end,
                                        const Eigen::VectorXd& weights) {
  const StationaryValue stationary = dense_stationary(steps, begin, end, weights);
  return stationary.negative == 0 ? std::optional(stationary.value) : std::nullopt;
}

SegmentValue dense_minimum(const LinearQuadraticSteps& steps, std::size_t begin, std::size_t end,
                           const Eigen::VectorXd& weights) {
  const auto value = dense_value(steps, begin, end, weights);
  if (!value) throw std::logic_error("these steps have no minimum");
  return *value;
}

void expect_same_value(const SegmentValue& found, const SegmentValue& wanted, double relative = 1e-11) {
  const auto expect_close = [&](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const char* name) {
    EXPECT_LT((a - b).lpNorm<Eigen::Infinity>(), relative * (1.0 + b.lpNorm<Eigen::Infinity>())) << name;
  };
  expect_close(found.P, wanted.P, "P");
  expect_close(found.p, wanted.p, "p");
  expect_close(found.Phi, wanted.Phi, "Phi");
  expect_close(found.Gamma, wanted.Gamma, "Gamma");
  expect_close(found.gamma, wanted.gamma, "gamma");
}

TEST(SegmentChain, OfTwoSegmentsIsOneOfDoubleLength) {
  RandomPoints random;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Index n = 1 + i % 4;
    const Eigen::Index m = 1 + i % 3;
    const auto steps = random_steps(random, n, m, 6, 1.0);
    const Eigen::VectorXd weights = random.vector(n, 0.5, 5.0);
    SegmentChain chain;
    chain.start(dense_minimum(steps, 3, 6, weights), weights);
    ASSERT_TRUE(chain.join(dense_minimum(steps, 0, 3, weights)));
    expect_same_value(chain.total(), dense_minimum(steps, 0, 6, weights));
  }
}

/// A single step reaches fewer directions than there are states where there are fewer controls: Γ is singular.
TEST(SegmentChain, OfManySegmentsOfAnyLengthIsTheWholeHorizon) {
  RandomPoints random;
  const std::vector<std::size_t> cuts{0, 1, 2, 5, 7, 12};
  for (int i = 0; i < 50; ++i) {
    const Eigen::Index n = 1 + i % 4;
    const auto steps = random_steps(random, n, 1, 12, 0.5);
    const Eigen::VectorXd weights = random.vector(n, 0.5, 5.0);
    std::vector<SegmentValue> values;
    for (std::size_t s = 0; s + 1 < cuts.size(); ++s) {
      values.push_back(dense_minimum(steps, cuts[s], cuts[s + 1], weights));
    }
    SegmentChain chain;
    chain.start(values.back(), weights);
    for (std::size_t s = values.size() - 1; s-- > 0;) ASSERT_TRUE(chain.join(values[s]));
    expect_same_value(chain.total(), dense_minimum(steps, 0, 12, weights));

    const Eigen::VectorXd first = random.vector(n);
    const Eigen::VectorXd multiplier = random.vector(n);
    Eigen::MatrixXd states;
    Eigen::MatrixXd multipliers;
    chain.back_substitute(first, multiplier, states, multipliers);
    EXPECT_EQ(states.col(0), first);
    EXPECT_EQ(multipliers.rightCols(1), multiplier);
    for (std::size_t s = 0; s + 1 < values.size(); ++s) {
      const auto column = static_cast<Eigen::Index>(s);
      const Eigen::VectorXd reached =
          values[s].Phi.transpose() * states.col(column) + values[s].gamma - values[s].Gamma * multipliers.col(column);
      EXPECT_LT((reached - states.col(column + 1)).lpNorm<Eigen::Infinity>(), 1e-10) << "segment " << s;
    }
    // The multiplier of a segment's end is the gradient of all that follows, less that of the weights.
    for (std::size_t s = 0; s + 1 < values.size(); ++s) {
      const auto column = static_cast<Eigen::Index>(s);
      const SegmentValue rest = dense_minimum(steps, cuts[s + 1], 12, weights);
      const Eigen::VectorXd gradient = rest.P * states.col(column + 1) + rest.p + rest.Phi * multiplier -
                                       weights.cwiseProduct(states.col(column + 1));
      EXPECT_LT((gradient - multipliers.col(column)).lpNorm<Eigen::Infinity>(), 1e-10) << "segment " << s;
    }
  }
}

TEST(SegmentChain, RefusesToJoinExactlyWhereTheWholeHasNoMinimum) {
  RandomPoints random;
  int minima = 0;
  int refusals = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Index n = 1 + i % 3;
    const auto steps = random_steps(random, n, 1, 4, random.number(-1.0, 0.2));
    const Eigen::VectorXd weights = random.vector(n, 0.1, 2.0);
    const auto first = dense_value(steps, 0, 2, weights);
    const auto last = dense_value(steps, 2, 4, weights);
    if (!first || !last) continue;
    SegmentChain chain;
    chain.start(*last, weights);
    const bool is_minimum = dense_value(steps, 0, 4, weights).has_value();
    EXPECT_EQ(chain.join(*first), is_minimum) << "number " << i;
    ++(is_minimum ? minima : refusals);
  }
  EXPECT_GT(minima, 100);
  EXPECT_GT(refusals, 100);
}

/// Three segments, of which any may be a saddle: the negative eigenvalues of all parts are those of the whole.
TEST(SegmentChain, CountsTheNegativeEigenvaluesOfSaddles) {
  constexpr double far_from_zero = 1e-3;
  RandomPoints random;
  int saddles = 0;
  int counts = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Index n = 1 + i % 3;
    const auto steps = random_steps(random, n, 1, 6, random.number(-2.0, 0.5));
    const Eigen::VectorXd weights = random.vector(n, 0.1, 2.0);
    const StationaryValue first = dense_stationary(steps, 0, 2, weights);
    const StationaryValue middle = dense_stationary(steps, 2, 4, weights);
    const StationaryValue last = dense_stationary(steps, 4, 6, weights);
    const StationaryValue end = dense_stationary(steps, 2, 6, weights);
    const StationaryValue whole = dense_stationary(steps, 0, 6, weights);
    if (std::min({first.smallest, middle.smallest, last.smallest, end.smallest, whole.smallest}) < far_from_zero)
      continue;
    SegmentChain chain;
    chain.start(last.value, weights);
    ASSERT_TRUE(chain.join_and_count(middle.value)) << "number " << i;
    ASSERT_TRUE(chain.join_and_count(first.value)) << "number " << i;
    EXPECT_EQ(first.negative + middle.negative + last.negative + chain.negative(), whole.negative) << "number " << i;
    expect_same_value(chain.total(), whole.value, 1e-6);
    if (whole.negative > 0) ++saddles;
    if (chain.negative() != 0) ++counts;
  }
  EXPECT_GT(saddles, 500);
  EXPECT_GT(counts, 100);
}

TEST(SegmentChain, DoesNotCountWhereAnEigenvalueOfAJoinIsZero) {
  const Eigen::VectorXd weights = Eigen::VectorXd::Ones(1);
  const auto segment = [](double stiffness, double reachability) {
    const auto one = [](double number) { return Eigen::MatrixXd::Constant(1, 1, number); };
    return SegmentValue{.P = one(stiffness),
                        .p = Eigen::VectorXd::Zero(1),
                        .Phi = one(1.0),
                        .Gamma = one(reachability),
                        .gamma = Eigen::VectorXd::Zero(1)};
  };
  // 1 + (P - ρ) Γ = 0.
  SegmentChain chain;
  chain.start(segment(-1.0, 0.5), weights);
  EXPECT_FALSE(chain.join_and_count(segment(1.0, 0.5)));
  EXPECT_TRUE(chain.join_and_count(segment(1.0, 0.25)));
}

}  // namespace
}  // namespace dmocbench::kkt
