// The count of minor iterations: every one is replayed by dense linear algebra from the sets that the trace tells, and
// the law behind the paper's figures is compared with the counts that come out.
#include <algorithm>
#include <set>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "methods/solvers/solver.hpp"
#include "methods/solvers/sqp/quadratic/quadratic_solver.hpp"
#include "methods/solvers/sqp/sqp_solver.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"
#include "tests/solvers/sqp/control_bounds.hpp"
#include "tests/solvers/sqp/random_quadratic_program.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/value_of.hpp"

namespace dmocbench::sqp {
namespace {

using dmocbench::tests::value_of;

/// Follows a trace with dense matrices, knowing the quadratic program and the slack start only.
class Replay {
 public:
  Replay(const QuadraticProgram& program, Eigen::MatrixXd hessian)
      : program_(program), hessian_(std::move(hessian)), columns_(program.row_count(), program.column_count()) {
    const Eigen::Index n = program.variable_count();
    columns_ << Eigen::MatrixXd(program.columns).leftCols(n),
        -Eigen::MatrixXd::Identity(program.row_count(), program.row_count());
    for (Eigen::Index j = n; j < program.column_count(); ++j) moving_.insert(j);
    point_ = Eigen::VectorXd::Zero(program.column_count());
  }

  void follow(const MinorIteration& minor) {
    const double before = minor.phase == MinorPhase::feasibility ? infeasibility() : objective();
    if (minor.entering) {
      EXPECT_FALSE(moving_.contains(*minor.entering)) << "enters but moved already";
      moving_.insert(*minor.entering);
    }
    const bool first_phase = minor.phase == MinorPhase::feasibility;
    point_ += minor.step * (first_phase ? along(value_of(minor.entering)) : to_minimiser());
    if (minor.leaving) {
      EXPECT_EQ(moving_.erase(*minor.leaving), 1U) << "leaves but did not move";
      EXPECT_NEAR(distance_to_bound(*minor.leaving), 0.0, accuracy);
    } else {
      EXPECT_EQ(minor.step, 1.0) << "a step cut short by nothing";
    }
    if (minor.into_basis) {
      EXPECT_TRUE(moving_.contains(*minor.into_basis));
    }
    EXPECT_NEAR(infeasibility(), minor.infeasibility, accuracy);
    EXPECT_NEAR(objective(), minor.objective, accuracy * std::max(1.0, std::abs(minor.objective)));
    EXPECT_EQ(static_cast<Eigen::Index>(moving_.size()), program_.row_count() + minor.superbasics);
    const double after = first_phase ? infeasibility() : objective();
    EXPECT_LE(after, before + accuracy * std::max(1.0, std::abs(before)));
    ++count_;
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const Eigen::VectorXd& point() const { return point_; }

 private:
  static constexpr double accuracy = 1e-6;

  [[nodiscard]] double violation(Eigen::Index j) const {
    return std::max({0.0, program_.lower[j] - point_[j], point_[j] - program_.upper[j]});
  }
  [[nodiscard]] double distance_to_bound(Eigen::Index j) const {
    return std::min(std::abs(point_[j] - program_.lower[j]), std::abs(point_[j] - program_.upper[j]));
  }
  [[nodiscard]] double infeasibility() const {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < point_.size(); ++j) sum += violation(j) > 1e-8 ? violation(j) : 0.0;
    return sum;
  }
  [[nodiscard]] double objective() const {
    const Eigen::VectorXd d = point_.head(program_.variable_count());
    return program_.gradient.dot(d) + 0.5 * d.dot(hessian_ * d);
  }
  [[nodiscard]] std::vector<Eigen::Index> moving() const { return {moving_.begin(), moving_.end()}; }

  /// The only direction in which the moving columns can go, scaled to 1 in `entering`, and signed so that the sum of
  /// infeasibilities falls.
  [[nodiscard]] Eigen::VectorXd along(Eigen::Index entering) const {
    const std::vector<Eigen::Index> others = [&] {
      std::vector<Eigen::Index> all = moving();
      std::erase(all, entering);
      return all;
    }();
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(point_.size());
    direction[entering] = 1.0;
    const Eigen::MatrixXd basis = columns_(Eigen::all, others);
    direction(others) = -basis.fullPivLu().solve(columns_.col(entering));
    double derivative = 0.0;
    for (const Eigen::Index j : others) {
      if (point_[j] < program_.lower[j] - 1e-8) derivative -= direction[j];
      if (point_[j] > program_.upper[j] + 1e-8) derivative += direction[j];
    }
    return derivative > 0.0 ? Eigen::VectorXd(-direction) : direction;
  }

  /// From the point to the minimiser of the objective over the moving columns, by a dense system for all conditions.
  [[nodiscard]] Eigen::VectorXd to_minimiser() const {
    const std::vector<Eigen::Index> free = moving();
    const auto size = static_cast<Eigen::Index>(free.size());
    const Eigen::Index m = program_.row_count();
    const Eigen::Index n = program_.variable_count();
    Eigen::MatrixXd curvature = Eigen::MatrixXd::Zero(point_.size(), point_.size());
    curvature.topLeftCorner(n, n) = hessian_;
    Eigen::VectorXd gradient = curvature * point_;
    gradient.head(n) += program_.gradient;
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(size + m, size + m);
    system.topLeftCorner(size, size) = curvature(free, free);
    system.bottomLeftCorner(m, size) = columns_(Eigen::all, free);
    system.topRightCorner(size, m) = system.bottomLeftCorner(m, size).transpose();
    Eigen::VectorXd right_hand_side = Eigen::VectorXd::Zero(size + m);
    right_hand_side.head(size) = -gradient(free);
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(point_.size());
    direction(free) = system.fullPivLu().solve(right_hand_side).head(size);
    return direction;
  }

  const QuadraticProgram& program_;
  Eigen::MatrixXd hessian_;
  Eigen::MatrixXd columns_;  // (A, -I)
  std::set<Eigen::Index> moving_;
  Eigen::VectorXd point_;
  int count_ = 0;
};

/// Solves the first quadratic program of a problem from its guess and replays every minor iteration.
void replay_first_program(NonlinearProgram& program, const Eigen::VectorXd& start) {
  Linearisation at = values_at(program, start.cwiseMax(program.variable_lower()).cwiseMin(program.variable_upper()));
  differentiate(program, at);
  const Eigen::VectorXd no_multipliers = Eigen::VectorXd::Zero(at.constraints.size());
  const Eigen::SparseMatrix<double> exact = hessian_at(program, at.point, no_multipliers);
  Eigen::MatrixXd hessian = Eigen::MatrixXd(exact).selfadjointView<Eigen::Lower>();
  hessian.diagonal().array() += 1e-3;
  const QuadraticProgram quadratic =
      quadratic_program_at(program, at, [&](const auto& vectors) { return hessian * vectors; });
  Replay replay(quadratic, hessian);
  QuadraticSolver solver({}, Pricing(), [&](const MinorIteration& minor) {
    replay.follow(minor);
    return !::testing::Test::HasFailure();
  });
  const QuadraticSolution solution = solver.solve(quadratic);
  ASSERT_EQ(solution.status, QuadraticStatus::optimal);
  EXPECT_GT(replay.count(), 0);
  EXPECT_LT((replay.point().head(start.size()) - solution.step).lpNorm<Eigen::Infinity>(), 1e-6);
}

TEST(MinorIterations, EveryOneCanBeReplayedFromItsSets) {
  for (const std::string& name : paper_problem_names()) {
    for (const std::string& method : paper_families()) {
      const auto problem = make_problem(name);
      Transcription program(*problem, *make_element(method), gauss_tableau(1), Grid::uniform(8));
      SCOPED_TRACE(testing::Message() << name << ' ' << method);
      replay_first_program(program, sample(program, guessed_motion(*problem)));
    }
  }
}

TEST(MinorIterations, WithActiveControlBoundsCanBeReplayedToo) {
  const auto problem = make_problem("two_link_manipulator");
  for (const std::string& method : paper_families()) {
    Transcription program(*problem, *make_element(method), gauss_tableau(1), Grid::uniform(8));
    auto bounded = tests::with_control_bound(program, 60.0);
    SCOPED_TRACE(method);
    replay_first_program(bounded, sample(program, guessed_motion(*problem)));
  }
}

TEST(MinorIterations, OfRandomProgramsWithBoundsCanBeReplayed) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto problem = tests::random_program(20, 8, 0.4, seed);
    Replay replay(problem.program, problem.dense_hessian);
    QuadraticSolver solver({}, Pricing(), [&](const MinorIteration& minor) {
      replay.follow(minor);
      return true;
    });
    ASSERT_EQ(solver.solve(problem.program).status, QuadraticStatus::optimal);
  }
}

SolverOptions with_tolerance(double tolerance) {
  SolverOptions options;
  options.tolerance = tolerance;
  return options;
}

/// Both problems, all methods, several grids, from the guess.
struct Count {
  std::string label;
  Solution solution;
  int free_variables = 0;
  int rows = 0;
};

std::vector<Count> counts(const SequentialOptions& choices, const std::vector<Eigen::Index>& grids) {
  std::vector<Count> result;
  for (const std::string& name : paper_problem_names()) {
    for (const std::string& method : paper_families()) {
      for (const Eigen::Index intervals : grids) {
        const auto problem = make_problem(name);
        Transcription program(*problem, *make_element(method), gauss_tableau(1), Grid::uniform(intervals));
        const SqpSolver solver(with_tolerance(1e-8), choices);
        result.push_back({.label = (testing::Message() << name << ' ' << method << " N = " << intervals).GetString(),
                          .solution = solver.solve(program, sample(program, guessed_motion(*problem))),
                          .free_variables = static_cast<int>(free_variable_count(program)),
                          .rows = static_cast<int>(program.constraint_count())});
        EXPECT_EQ(result.back().solution.status, Status::solved) << result.back().label;
      }
    }
  }
  return result;
}

TEST(MinorIterations, FromTheSlackBasisAreOnePerFreeVariableAndOnePerLaterMajorIteration) {
  for (const Count& count : counts({}, {8, 16, 31, 64})) {
    EXPECT_EQ(value_of(count.solution.minor_iterations),
              count.free_variables + value_of(count.solution.major_iterations) - 1)
        << count.label;
  }
}

TEST(MinorIterations, FromACrashBasisAreOnePerDegreeOfFreedomInstead) {
  for (const Count& count : counts({.crash = Crash::basis}, {8, 16, 31, 64})) {
    EXPECT_EQ(value_of(count.solution.phase_one_minor_iterations), 0) << count.label;
    EXPECT_EQ(value_of(count.solution.minor_iterations),
              count.free_variables - count.rows + value_of(count.solution.major_iterations) - 1)
        << count.label;
  }
}

TEST(MinorIterations, DoNotDependOnPricing) {
  const std::vector<Count> expected = counts({}, {12, 40});
  for (const SequentialOptions& choices :
       {SequentialOptions{.pricing = PricingRule::lowest}, SequentialOptions{.pricing = PricingRule::last},
        SequentialOptions{.pricing = PricingRule::random, .seed = 17}}) {
    const std::vector<Count> found = counts(choices, {12, 40});
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(value_of(found[i].solution.minor_iterations), value_of(expected[i].solution.minor_iterations))
          << found[i].label;
      EXPECT_EQ(value_of(found[i].solution.major_iterations), value_of(expected[i].solution.major_iterations))
          << found[i].label;
    }
  }
}

TEST(MinorIterations, AreMoreThanTheLawSaysWhereControlBoundsAreActive) {
  const auto problem = make_problem("two_link_manipulator");
  Transcription program(*problem, *make_element("dmoc"), gauss_tableau(1), Grid::uniform(32));
  auto bounded = tests::with_control_bound(program, 16.0);
  const SolverOptions options = with_tolerance(1e-8);
  const Solution solution = make_solver("sqp", options)->solve(bounded, sample(program, guessed_motion(*problem)));
  ASSERT_EQ(solution.status, Status::solved);
  EXPECT_NEAR((solution.primal.array().abs() - 16.0).abs().minCoeff(), 0.0, 1e-9);  // a bound is active
  EXPECT_GT(value_of(solution.minor_iterations),
            static_cast<int>(free_variable_count(bounded)) + value_of(solution.major_iterations) - 1);
}

TEST(MinorIterations, AreAsManyAsTheObserverSaw) {
  const auto problem = make_problem("two_link_manipulator");
  Transcription program(*problem, *make_element("dmoc"), gauss_tableau(1), Grid::uniform(16));
  std::vector<MinorIteration> seen;
  const SqpSolver solver(with_tolerance(1e-8),
                         {.on_minor_iteration = [&](const MinorIteration& minor) { seen.push_back(minor); }});
  const Solution solution = solver.solve(program, sample(program, guessed_motion(*problem)));
  EXPECT_EQ(static_cast<int>(seen.size()), value_of(solution.minor_iterations));
  EXPECT_EQ(std::count_if(seen.begin(), seen.end(),
                          [](const MinorIteration& minor) { return minor.phase == MinorPhase::feasibility; }),
            value_of(solution.phase_one_minor_iterations));
  EXPECT_EQ(seen.back().major, value_of(solution.major_iterations));
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end(),
                             [](const MinorIteration& a, const MinorIteration& b) { return a.major < b.major; }));
}

}  // namespace
}  // namespace dmocbench::sqp
