// Elimination by intervals against dense linear algebra, on random systems with the structure of transcriptions.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "methods/solvers/interior_point/intervals/interval_kkt.hpp"
#include "tests/support/dense_kkt.hpp"
#include "tests/support/random_structured_program.hpp"

namespace dmocbench::interior_point {
namespace {

using tests::DenseKkt;
using tests::KktNumbers;
using tests::RandomPoints;
using tests::RandomShape;
using tests::RandomStructuredProgram;

/// Draws shapes of programs, and what belongs to a system with one.
class SystemChoice {
 public:
  explicit SystemChoice(unsigned seed) : random_(seed) {}

  RandomShape shape() {
    constexpr std::array roughnesses{0.0, 0.01, 0.1, 0.5};
    RandomShape shape;
    shape.node = whole(1, 4);
    shape.rows_at_nodes = chance(0.5);
    shape.slopes = chance(0.5) ? 0 : whole(1, 4);
    shape.controls = whole(1, 3);
    shape.soft = chance(0.6) ? 0 : whole(1, 3);
    shape.horizon = chance(0.3);
    for (const int end : {0, 1}) {
      shape.velocity[end] = chance(0.4);
      shape.fixed[end] = chance(0.6) ? shape.node : whole(0, shape.node);
    }
    shape.conditions = chance(0.7) ? 0 : whole(1, 2);
    shape.condition_is_soft = chance(0.3);
    shape.fixes_control = shape.controls > 1 && chance(0.1);
    shape.slopes_cost_nothing = shape.slopes > 0 && chance(0.5);
    shape.drops_entries = chance(0.3);
    shape.nearly_dependent = chance(0.05);
    shape.roughness = roughnesses.at(static_cast<std::size_t>(whole(0, 3)));
    shape.coupling = magnitude(0.05, 1.0);
    shape.hessian = static_cast<RandomShape::Hessian>(whole(0, 3));
    shape.intervals = intervals(shape);
    return shape;
  }

  KktNumbers numbers(RandomStructuredProgram& program, RandomShape::Hessian hessian) {
    const auto n = static_cast<Eigen::Index>(program.variable_count());
    const auto m = static_cast<Eigen::Index>(program.constraint_count());
    KktNumbers numbers;
    numbers.hessian.resize(static_cast<Eigen::Index>(program.hessian_structure().size()));
    numbers.jacobian.resize(static_cast<Eigen::Index>(program.jacobian_structure().size()));
    program.hessian(Eigen::VectorXd::Zero(n), 1.0, Eigen::VectorXd::Zero(m), numbers.hessian);
    program.jacobian(Eigen::VectorXd::Zero(n), numbers.jacobian);
    numbers.diagonal = shift_for(hessian) * (1.0 + random_.vector(n, 0.0, 0.5).array());
    numbers.softness.setZero(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      if (program.constraint_lower()[i] == program.constraint_upper()[i]) continue;
      numbers.softness[i] = magnitude(1e-3, 10.0);
    }
    numbers.slope = random_.vector(n);
    numbers.rows = random_.vector(m);
    return numbers;
  }

 private:
  bool chance(double probability) { return random_.number(0.0, 1.0) < probability; }
  Eigen::Index whole(Eigen::Index least, Eigen::Index most) {
    return least + static_cast<Eigen::Index>(random_.number(0.0, 1.0) * static_cast<double>(most - least + 1));
  }
  double magnitude(double smallest, double largest) {
    return smallest * std::pow(largest / smallest, random_.number(0.0, 1.0));
  }
  double shift_for(RandomShape::Hessian hessian) {
    if (hessian == RandomShape::Hessian::indefinite) return random_.number(0.0, 2.0);
    return hessian == RandomShape::Hessian::nearly_singular ? magnitude(1e-8, 1e-2) : 0.0;
  }
  /// 1 .. 40, fewer where intervals are large, so that dense linear algebra stays fast; often fewer than lanes. Where
  /// both ends have further unknowns a grid of one interval cannot tell them from a column of nodes.
  std::size_t intervals(const RandomShape& shape) {
    const Eigen::Index of_interval = 2 * (shape.node + shape.slopes) + shape.controls + shape.soft;
    const Eigen::Index most = chance(0.3) ? 8 : std::min<Eigen::Index>(40, 240 / of_interval);
    return static_cast<std::size_t>(whole(shape.velocity[0] && shape.velocity[1] ? 2 : 1, most));
  }

  RandomPoints random_;
};

/// What dense linear algebra says of a system. In between, rounding decides what one sees.
enum class DenseVerdict : unsigned char { minimum, indefinite, dependent_rows, in_between };

DenseVerdict dense_verdict(const DenseKkt& dense, double full_rank) {
  constexpr double no_rank = 1e-14;
  constexpr double smallest_curvature = 1e-11;
  const DenseKkt::Inertia inertia = dense.inertia();
  if (!(inertia.rank > no_rank)) return DenseVerdict::dependent_rows;
  if (inertia.rank < full_rank) return DenseVerdict::in_between;
  if (std::abs(inertia.smallest) < smallest_curvature * inertia.largest) return DenseVerdict::in_between;
  return inertia.smallest > 0.0 ? DenseVerdict::minimum : DenseVerdict::indefinite;
}

/// The larger of two errors relative to largest entries: of all unknowns' steps, and of all multipliers' steps.
double relative_error(const Eigen::VectorXd& found, const Eigen::VectorXd& wanted, Eigen::Index unknowns) {
  const auto error = [&](auto part) {
    const double size = part(wanted).template lpNorm<Eigen::Infinity>();
    return part(wanted).size() > 0 ? (part(found) - part(wanted)).template lpNorm<Eigen::Infinity>() / size : 0.0;
  };
  return std::max(error([&](const Eigen::VectorXd& v) { return v.head(unknowns); }),
                  error([&](const Eigen::VectorXd& v) { return v.tail(v.size() - unknowns); }));
}

/// Solves a system, and then for what the steps leave of its right-hand side, until they are right: within 1e-10 of the
/// solution or, where the system is so ill-conditioned that its solution is not known so well, exact for data that
/// differ by 1e-14 of their size. The number of corrections, or -1 if `most` are not enough.
int corrections_needed(IntervalKkt& kkt, const KktNumbers& numbers, const DenseKkt& dense, int most) {
  constexpr double promise = 1e-10;
  constexpr double backward_promise = 1e-14;
  const Eigen::Index n = numbers.slope.size();
  const Eigen::VectorXd wanted = dense.solution();
  KktNumbers left = numbers;
  Eigen::VectorXd primal = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(numbers.rows.size());
  Eigen::VectorXd primal_step(primal.size());
  Eigen::VectorXd multiplier_step(multipliers.size());
  for (int corrections = 0; corrections <= most; ++corrections) {
    if (kkt.solve(left.matrix(), left.slope, left.rows, primal_step, multiplier_step) != Verdict::solved) return -1;
    primal += primal_step;
    multipliers += multiplier_step;
    Eigen::VectorXd found(wanted.size());
    found << primal, multipliers;
    if (relative_error(found, wanted, n) <= promise) return corrections;
    if (dense.backward_error(primal, multipliers) <= backward_promise) return corrections;
    dense.residual_of(primal, multipliers, left.slope, left.rows);
  }
  return -1;
}

Verdict verdict_of(IntervalKkt& kkt, const KktNumbers& numbers) {
  Eigen::VectorXd primal(numbers.slope.size());
  Eigen::VectorXd multipliers(numbers.rows.size());
  return kkt.solve(numbers.matrix(), numbers.slope, numbers.rows, primal, multipliers);
}

TEST(RandomSystems, AreSolvedOrRefusedAsDenseLinearAlgebraSays) {
  constexpr unsigned seeds = 2000;
  constexpr int most_corrections = 2;
  std::array<int, 4> kinds{};
  std::array<int, most_corrections + 1> corrected{};
  for (unsigned seed = 0; seed < seeds; ++seed) {
    SystemChoice choice(seed);
    const RandomShape shape = choice.shape();
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + shape.label());
    RandomStructuredProgram program(shape, seed);
    std::string why;
    const auto kkt = IntervalKkt::make(program, why);
    ASSERT_NE(kkt, nullptr) << why;
    const KktNumbers numbers = choice.numbers(program, shape.hessian);
    const DenseKkt dense(program, numbers);
    const DenseVerdict wanted = dense_verdict(dense, 1e-9);
    ++kinds.at(static_cast<std::size_t>(wanted));
    if (wanted == DenseVerdict::in_between) continue;
    if (wanted != DenseVerdict::minimum) {
      const Verdict verdict = verdict_of(*kkt, numbers);
      EXPECT_TRUE(verdict == Verdict::wrong_inertia || verdict == Verdict::singular) << static_cast<int>(verdict);
      continue;
    }
    const int corrections = corrections_needed(*kkt, numbers, dense, most_corrections);
    EXPECT_GE(corrections, 0);
    if (corrections >= 0) ++corrected.at(static_cast<std::size_t>(corrections));
  }
  const auto [minima, indefinite, dependent, in_between] = kinds;
  EXPECT_GT(minima, 1400);
  EXPECT_GT(indefinite, 100);
  EXPECT_GT(dependent, 100);
  EXPECT_LE(in_between, 5);
  // What it costs that rows are not exchanged between intervals: one system in fifty may need a correction.
  EXPECT_LE(minima - corrected[0], minima / 50);
}

/// How many shifts of the Hessian too many a solver would try that raises it until the system is solved, with one
/// object for all its systems; `needs_shift` tells whether the first of them is indefinite.
int shifts_too_many(IntervalKkt& kkt, const NonlinearProgram& program, KktNumbers numbers, bool& needs_shift) {
  int too_many = 0;
  needs_shift = false;
  constexpr double full_rank = 1e-6;  // its square is what a large shift leaves of the rows
  constexpr double largest = 1e6;
  for (double shift = 1e-3; shift < largest; shift *= 8.0) {
    numbers.diagonal.setConstant(shift);
    const DenseVerdict wanted = dense_verdict(DenseKkt(program, numbers), full_rank);
    if (wanted == DenseVerdict::dependent_rows || wanted == DenseVerdict::in_between) return 0;
    const bool is_solved = verdict_of(kkt, numbers) == Verdict::solved;
    if (wanted == DenseVerdict::indefinite) {
      EXPECT_FALSE(is_solved) << "shift " << shift;
      needs_shift = true;
    } else if (is_solved) {
      return too_many;
    } else {
      ++too_many;
    }
  }
  ADD_FAILURE() << "no shift is enough";
  return too_many;
}

TEST(RandomSystems, AreSolvedOnceTheShiftOfTheHessianIsLargeEnough) {
  int sequences = 0;
  int late = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SystemChoice choice(seed);
    RandomShape shape = choice.shape();
    shape.hessian = RandomShape::Hessian::indefinite;
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + shape.label());
    RandomStructuredProgram program(shape, seed);
    std::string why;
    const auto kkt = IntervalKkt::make(program, why);
    ASSERT_NE(kkt, nullptr) << why;
    bool needs_shift = false;
    const int too_many = shifts_too_many(*kkt, program, choice.numbers(program, shape.hessian), needs_shift);
    // When no weight at the ends of segments has helped, the next failures are believed: then a system is refused that
    // another weight would have solved.
    EXPECT_LE(too_many, 1);
    if (needs_shift) ++sequences;
    if (too_many > 0) ++late;
  }
  EXPECT_GT(sequences, 150);
  EXPECT_LE(late, sequences / 8);
}

}  // namespace
}  // namespace dmocbench::interior_point
