#include "methods/transcription/elements/dmoc_element.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "methods/expression/replay.hpp"
#include "methods/transcription/interval_functions.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::problems;
using tests::RandomPoints;
using Long = long double;
using LongVector = Eigen::Matrix<Long, Eigen::Dynamic, 1>;

/// A formula of a point (q, v, u, t), evaluated in long double: L, f and C as the problem states them, not one
/// derivative.
class PlainFormulas {
 public:
  explicit PlainFormulas(const Problem& problem) : n_(problem.configuration_size()), m_(problem.control_size()) {
    const auto n = static_cast<std::size_t>(n_);
    const ControlledState x{input_vector(0, n_), input_vector(n, n_), input_vector(2 * n, m_),
                            Expression::input(2 * n + static_cast<std::size_t>(m_))};
    ExpressionVector outputs(n_ + 2);
    outputs << problem.lagrangian(x.state()), problem.force(x), problem.running_cost(x);
    schedule_ = Schedule(outputs);
  }
  /// L, then f, then C.
  [[nodiscard]] LongVector at(const LongVector& q, const LongVector& v, const LongVector& u, Long t) const {
    std::vector<Long> inputs(q.begin(), q.end());
    inputs.insert(inputs.end(), v.begin(), v.end());
    inputs.insert(inputs.end(), u.begin(), u.end());
    inputs.push_back(t);
    const std::vector<Long> outputs = replay<Long>(schedule_, std::span<const Long>(inputs));
    return Eigen::Map<const LongVector>(outputs.data(), static_cast<Eigen::Index>(outputs.size()));
  }

 private:
  Eigen::Index n_;
  Eigen::Index m_;
  Schedule schedule_;
};

/// The principle itself, (eq:varmech_dldap), on one vector of unknowns: nothing of the element's code, nothing of its
/// derivatives; only the layout's columns are shared.
class DiscretePrinciple {
 public:
  DiscretePrinciple(const Problem& problem, const Transcription& program)
      : program_(program), formulas_(problem), n_(problem.configuration_size()) {}

  /// Σ_k h Σ_i b_i L(Q_i, Q̇_i).
  [[nodiscard]] Long action(const LongVector& x) const {
    Long sum = 0.0L;
    visit(x, [&](Long weight, const LongVector& q, const LongVector& v, const LongVector& u, Long t) {
      sum += weight * formulas_.at(q, v, u, t)[0];
    });
    return sum;
  }

  /// Σ_k h Σ_i b_i f(Q_i, Q̇_i, U_i)·δQ_i, where δQ_i = (Q_i(x + δ) - Q_i(x - δ))/2: Q_i is affine in x.
  [[nodiscard]] Long work(const LongVector& x, const LongVector& variation) const {
    std::vector<LongVector> forward;
    std::vector<LongVector> backward;
    const auto collect = [&](const LongVector& y, std::vector<LongVector>& list) {
      visit(y, [&](Long, const LongVector& q, const LongVector&, const LongVector&, Long) { list.push_back(q); });
    };
    collect(x + variation, forward);
    collect(x - variation, backward);
    Long sum = 0.0L;
    std::size_t stage = 0;
    visit(x, [&](Long weight, const LongVector& q, const LongVector& v, const LongVector& u, Long t) {
      const LongVector moved = (forward[stage] - backward[stage]) / 2.0L;
      sum += weight * formulas_.at(q, v, u, t).segment(1, n_).dot(moved);
      ++stage;
    });
    return sum;
  }

 private:
  template <class Visitor>
  void visit(const LongVector& x, const Visitor& visitor) const {
    const ProgramBlocks& blocks = program_.blocks();
    const Tableau& tableau = program_.tableau();
    const Eigen::Index s = tableau.stages();
    const Eigen::Index m = program_.traced_problem().control_size();
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(blocks.intervals()); ++k) {
      const Long h = program_.step_inputs()[k];
      const auto read = [&](const auto& column, Eigen::Index size, Eigen::Index node) {
        LongVector entries(size);
        for (Eigen::Index i = 0; i < size; ++i) {
          entries[i] = x[static_cast<Eigen::Index>(column(i)) + node];
        }
        return entries;
      };
      const auto q_column = [&](Eigen::Index i) { return blocks.unknown(Quantity::configuration).at(i); };
      const LongVector left = read(q_column, n_, k);
      const LongVector right = read(q_column, n_, k + 1);
      std::vector<LongVector> slopes;
      LongVector last = (right - left) / h;
      for (Eigen::Index j = 0; j + 1 < s; ++j) {
        slopes.push_back(read([&](Eigen::Index i) { return blocks.unknown(Quantity::rate, j).at(i); }, n_, k));
        last -= Long(tableau.b[j]) * slopes.back();
      }
      slopes.emplace_back(last / Long(tableau.b[s - 1]));
      for (Eigen::Index i = 0; i < s; ++i) {
        LongVector q = left;
        for (Eigen::Index j = 0; j < s; ++j) {
          q += h * Long(tableau.a(i, j)) * slopes[static_cast<std::size_t>(j)];
        }
        const LongVector u = read([&](Eigen::Index c) { return blocks.unknown(Quantity::control, i).at(c); }, m, k);
        visitor(h * Long(tableau.b[i]), q, slopes[static_cast<std::size_t>(i)], u,
                Long(program_.time_inputs()[k]) + Long(tableau.c[i]) * h);
      }
    }
  }

  const Transcription& program_;
  PlainFormulas formulas_;
  Eigen::Index n_;
};

/// Any point of the program: not a solution.
Eigen::VectorXd arbitrary_point(const Problem& problem, Transcription& program) {
  Eigen::VectorXd x = sample(program, guessed_motion(problem));
  return x + RandomPoints(3).vector(x.size(), -0.02, 0.02);
}

TEST(DmocElement, RowsAreTheVariationOfTheDiscreteActionPlusVirtualWork) {
  constexpr double tolerance = 1e-10;
  for (const auto& problem : problems()) {
    for (const int s : {1, 2, 3}) {
      SCOPED_TRACE(problem->name() + ", s = " + std::to_string(s));
      const auto program = tests::transcribe(*problem, {"dmoc", s}, tests::graded_grid(4));
      const ProgramBlocks& blocks = program->blocks();
      const Eigen::VectorXd x = arbitrary_point(*problem, *program);
      Eigen::VectorXd rows(static_cast<Eigen::Index>(program->constraint_count()));
      program->constraints(x, rows);
      const DiscretePrinciple principle(*problem, *program);
      const LongVector at = x.cast<Long>();
      const auto variation = [&](std::size_t unknown) {
        LongVector direction = LongVector::Zero(x.size());
        direction[static_cast<Eigen::Index>(unknown)] = 1.0L;
        const auto central = [&](Long e) {
          return (principle.action(at + e * direction) - principle.action(at - e * direction)) / (2.0L * e);
        };
        constexpr Long e = 2e-5L;  // Richardson: error O(e⁴), rounding 1e-19/e
        const Long by_action = (4.0L * central(e / 2.0L) - central(e)) / 3.0L;
        return static_cast<double>(by_action + principle.work(at, direction));
      };
      const auto intervals = blocks.intervals();
      const auto n = static_cast<std::size_t>(problem->configuration_size());
      for (std::size_t i = 0; i < n; ++i) {
        const auto component = static_cast<Eigen::Index>(i);
        for (std::size_t k = 0; k <= intervals; ++k) {  // (DEL), boundary nodes included
          const auto row = static_cast<Eigen::Index>(blocks.row(Equation::euler_lagrange).at(component) + k);
          EXPECT_NEAR(rows[row], variation(blocks.unknown(Quantity::configuration).at(component) + k), tolerance);
        }
        for (Eigen::Index j = 0; j + 1 < s; ++j) {
          for (std::size_t k = 0; k < intervals; ++k) {
            const double unit = program->steps(x)[static_cast<Eigen::Index>(k)] * program->tableau().b[j];
            const auto row =
                static_cast<Eigen::Index>(blocks.row_places()[2 * n + static_cast<std::size_t>(j) * n + i].at(k));
            EXPECT_NEAR(rows[row], variation(blocks.unknown(Quantity::rate, j).at(component) + k) / unit, tolerance);
          }
        }
      }
    }
  }
}

/// Section 4.1 of the paper, by hand for the orbit: L_d = h L(q̄, q̄̇), f_d^± = h/2 f(q̄, u), with q̄ the midpoint.
class MidpointByHand : public testing::Test {
 protected:
  struct Ends {
    Eigen::Vector2d d1;  // D₁L_d + f_d^-
    Eigen::Vector2d d2;  // D₂L_d + f_d^+
    double cost;         // C_d
  };
  static Ends ends(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double u, double h) {
    const double r = 0.5 * (a[0] + b[0]);
    const Eigen::Vector2d v = (b - a) / h;
    const Eigen::Vector2d momentum(v[0], r * r * v[1]);
    const Eigen::Vector2d l_q(r * v[1] * v[1] - 1.0 / (r * r), 0.0);
    const Eigen::Vector2d f(0.0, r * u);
    return {0.5 * h * (l_q + f) - momentum, 0.5 * h * (l_q + f) + momentum, h * u * u};
  }
  [[nodiscard]] Eigen::Vector2d node(Eigen::Index k) const { return {x_[entry(0, k)], x_[entry(1, k)]}; }
  [[nodiscard]] Ends interval(Eigen::Index k) const {
    const auto column = program_->blocks().unknown(Quantity::control, 0).index(0);
    return ends(node(k), node(k + 1), x_[column + k], program_->steps(x_)[k]);
  }
  [[nodiscard]] Eigen::Index entry(Eigen::Index i, Eigen::Index k) const {
    return program_->blocks().unknown(Quantity::configuration).index(i) + k;
  }

  static constexpr Eigen::Index intervals = 6;
  std::unique_ptr<Problem> problem_ = make_problem("orbital_transfer");
  std::unique_ptr<Transcription> program_ = tests::transcribe(*problem_, {"dmoc", 1}, tests::graded_grid(intervals));
  Eigen::VectorXd x_ = arbitrary_point(*problem_, *program_);
};

TEST_F(MidpointByHand, GivesTheRowsOfTheInnerNodes) {
  Eigen::VectorXd rows(static_cast<Eigen::Index>(program_->constraint_count()));
  program_->constraints(x_, rows);
  for (Eigen::Index k = 1; k < intervals; ++k) {
    const Eigen::Vector2d expected = interval(k - 1).d2 + interval(k).d1;
    EXPECT_NEAR(rows[entry(0, k)], expected[0], 1e-13);
    EXPECT_NEAR(rows[entry(1, k)], expected[1], 1e-13);
  }
}

TEST_F(MidpointByHand, GivesTheBoundaryRowsWithThePrescribedMomentaOnTheRightSide) {
  Eigen::VectorXd rows(static_cast<Eigen::Index>(program_->constraint_count()));
  program_->constraints(x_, rows);
  const BoundaryState first = problem_->initial_state();
  const BoundaryState last = problem_->final_state();
  const Eigen::Vector2d p0(first.v[0], first.q[0] * first.q[0] * first.v[1]);
  const Eigen::Vector2d pT(last.v[0], last.q[0] * last.q[0] * last.v[1]);
  // (eq:gDLOCP3): p⁰ + D₁L_d + f_d^- = 0; (rem:inifinalvel): -p^T + D₂L_d + f_d^+ = 0.
  const Eigen::Vector2d at_start = p0 + interval(0).d1;
  const Eigen::Vector2d at_end = interval(intervals - 1).d2 - pT;
  EXPECT_EQ(program_->constraint_lower(), program_->constraint_upper());
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Eigen::Index start = entry(i, 0);
    const Eigen::Index end = entry(i, intervals);
    EXPECT_NEAR(rows[start] - program_->constraint_lower()[start], at_start[i], 1e-13);
    EXPECT_NEAR(rows[end] - program_->constraint_lower()[end], at_end[i], 1e-13);
    EXPECT_EQ(program_->variable_lower()[start], first.q[i]);
    EXPECT_EQ(program_->variable_upper()[start], first.q[i]);
    EXPECT_EQ(program_->variable_lower()[end], last.q[i]);
    EXPECT_EQ(program_->variable_upper()[end], last.q[i]);
  }
}

TEST_F(MidpointByHand, GivesTheDiscreteCostTimesItsScale) {
  double cost = 0.0;
  for (Eigen::Index k = 0; k < intervals; ++k) cost += interval(k).cost;
  EXPECT_NEAR(program_->objective(x_), problem_->cost_scale() * cost, 1e-13 * problem_->cost_scale() * cost);
}

TEST_F(MidpointByHand, GivesTheForcedDiscreteLegendreTransforms) {
  const Trajectory trajectory = read_trajectory(*program_, x_, Eigen::VectorXd());
  for (Eigen::Index k = 0; k < intervals; ++k) {
    EXPECT_LT((trajectory.p.row(k).transpose() + interval(k).d1).norm(), 1e-13);
  }
  EXPECT_LT((trajectory.p.row(intervals).transpose() - interval(intervals - 1).d2).norm(), 1e-13);
}

// Sharing and folding decide what derivatives cost: the Hessian of the Lagrangian of one interval has few operations.

std::size_t hessian_operations(const char* name, int stages) {
  const auto problem = make_problem(name);
  const TracedProblem traced(*problem);
  return trace_interval(traced, *make_element("dmoc"), make_tableau("gauss", stages),
                        {.cost_scale = problem->cost_scale()})
      .hessian.schedule.operation_count();
}

TEST(OperationCount, MidpointHessianOfTheOrbitNeedsAtMostFifty) {
  EXPECT_LE(hessian_operations("orbital_transfer", 1), 50U);
}

TEST(OperationCount, MidpointHessianOfTheTwoLinkNeedsAtMostOneHundredAndThirty) {
  EXPECT_LE(hessian_operations("two_link_manipulator", 1), 130U);
}

TEST(OperationCount, StagesShareNothingThatGrowsFasterThanTheirPairs) {
  // Every entry of the Hessian sums over the stages; there are O(s^2) entries.
  const std::size_t one = hessian_operations("two_link_manipulator", 1);
  EXPECT_LT(hessian_operations("two_link_manipulator", 3), 27 * one);
}

}  // namespace
}  // namespace dmocbench
