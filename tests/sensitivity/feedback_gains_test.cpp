// Gains are slopes of the optimal control in the state: held against differences of solves from neighbouring states.

#include "methods/sensitivity/feedback_gains.hpp"

#include <cmath>
#include <functional>
#include <utility>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/brachistochrone.hpp"
#include "problems/two_link_manipulator.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;
using tests::Solved;

/// A problem that does not depend on time, from some state on, with the time that is left.
class Remaining final : public tests::WithEnds {
 public:
  Remaining(const Problem& base, BoundaryState from, double horizon)
      : WithEnds(base, std::move(from), base.final_state()), horizon_(horizon) {}
  [[nodiscard]] double horizon() const override { return horizon_; }

 private:
  double horizon_;
};

/// What is stated of a problem besides its ends.
using Restating = std::function<void(tests::Restated::Statement&)>;

/// The controls of the first interval, one below the other, where the motion starts at (q, p) with the rest of the
/// motion `near` from node k on as its guess.
class FirstControls {
 public:
  FirstControls(const Problem& problem, Scheme scheme, const Trajectory& near, Eigen::Index k, Restating statement)
      : problem_(problem),
        scheme_(std::move(scheme)),
        near_(near),
        k_(k),
        statement_(std::move(statement)),
        legendre_(TracedProblem(problem)) {}

  Eigen::VectorXd from(const Eigen::VectorXd& q, const Eigen::VectorXd& p) {
    const double begin = near_.node_times[k_];
    const Eigen::VectorXd v = legendre_.velocity(q, p, begin, near_.v.row(k_).transpose());
    const Remaining ends(problem_, {q, v}, problem_.horizon() - begin);
    const tests::Restated remaining(ends, [&](tests::Restated::Statement& s) {
      if (statement_) statement_(s);
    });
    const Motion all = smooth_motion(near_);
    const Motion rest{[&](double t) { return all.at(begin + t); }, remaining.horizon()};
    const Grid grid = Grid::uniform(near_.intervals() - k_);
    const Eigen::MatrixXd u = tests::solve(remaining, scheme_, grid, rest, 1e-11).trajectory.stage_u;
    return Eigen::MatrixXd(u.topRows(near_.stages()).transpose()).reshaped();
  }

  /// Their derivative in (q, p) at node k, by central differences.
  Eigen::MatrixXd slope(double step) {
    const Eigen::Index n = near_.q.cols();
    Eigen::MatrixXd result(near_.stages() * near_.stage_u.cols(), 2 * n);
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
      const auto moved = [&](double e) {
        Eigen::VectorXd q = near_.q.row(k_).transpose();
        Eigen::VectorXd p = near_.p.row(k_).transpose();
        (i < n ? q[i] : p[i - n]) += e;
        return from(q, p);
      };
      result.col(i) = (moved(step) - moved(-step)) / (2.0 * step);
    }
    return result;
  }

 private:
  const Problem& problem_;
  Scheme scheme_;
  const Trajectory& near_;
  Eigen::Index k_;
  Restating statement_;
  LegendreTransform legendre_;
};

FeedbackGains gains_of(const Solved& solved) {
  return feedback_gains(*solved.transcription, solved.solution.primal, solved.solution.multipliers);
}

/// The gains of all stages of interval k, one below the other.
Eigen::MatrixXd gains_at(const Solved& solved, Eigen::Index k) {
  const FeedbackGains gains = gains_of(solved);
  const Eigen::Index s = solved.trajectory.stages();
  const Eigen::Index m = solved.trajectory.stage_u.cols();
  Eigen::MatrixXd all(s * m, 2 * solved.trajectory.q.cols());
  for (Eigen::Index i = 0; i < s; ++i) {
    all.middleRows(i * m, m) = gains.of_stages.at(static_cast<std::size_t>(k * s + i));
  }
  return all;
}

/// The differences come nearer to the gains with the second power of their step.
void expect_slopes(const Solved& solved, FirstControls controls, Eigen::Index k, double step = 4e-3) {
  const Eigen::MatrixXd gains = gains_at(solved, k);
  const double coarse = (controls.slope(step) - gains).norm() / gains.norm();
  const double fine = (controls.slope(step / 4.0) - gains).norm() / gains.norm();
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, std::max(coarse / 8.0, 1e-6)) << "coarse " << coarse;
}

TEST(FeedbackGains, AreTheSlopesOfTheOptimalControlAtTheFirstNodeAndInTheMiddle) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    for (const Scheme& scheme : {Scheme{"dmoc"}, Scheme{"hamiltonian"}, Scheme{"tangent"}, Scheme{"dmoc", 2},
                                 Scheme{"tangent", 2, "lobatto"}}) {
      const Solved solved = tests::solve(*problem, scheme, Grid::uniform(12), tests::common_start(*problem), 1e-11);
      for (const Eigen::Index k : {0, 5}) {
        SCOPED_TRACE(name + " " + scheme.label() + " node " + std::to_string(k));
        expect_slopes(solved, FirstControls(*problem, scheme, solved.trajectory, k, {}), k);
      }
    }
  }
}

TEST(FeedbackGains, AreTheSlopesWhereTheMassDependsOnTimeAndTheForceOnTheVelocity) {
  const tests::MovingFrame problem;
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    const Solved solved =
        tests::solve(problem, Scheme{method, 2}, Grid::uniform(12), tests::common_start(problem), 1e-11);
    expect_slopes(solved, FirstControls(problem, Scheme{method, 2}, solved.trajectory, 0, {}), 0);
  }
}

TEST(FeedbackGains, AreTheSlopesWhereTheEndIsFreeWithACostAndBounded) {
  const tests::MovingFrame base;
  const Restating statement = [](tests::Restated::Statement& s) {
    s.last = tests::free_end(2);
    s.last.q.lower[0] = s.last.q.upper[0] = 0.7;
    s.last.v.upper[1] = -0.05;
    s.final_cost = [](const State& last) {
      return 3.0 * last.v[0] * last.v[0] + 2.0 * (last.q[1] - 1.0) * (last.q[1] - 1.0) * last.v[0];
    };
  };
  const tests::Restated problem(base, statement);
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    const Solved solved = tests::solve(problem, Scheme{method}, Grid::uniform(16), tests::common_start(base), 1e-11);
    expect_slopes(solved, FirstControls(base, Scheme{method}, solved.trajectory, 0, statement), 0, 1e-3);
  }
}

TEST(FeedbackGains, AreZeroOfControlsOnTheirBoundsAndSlopesOfTheOthers) {
  const TwoLinkManipulator base;
  const Motion& start = tests::common_start(base);
  const Eigen::VectorXd largest = tests::solve(base, Scheme{"dmoc"}, Grid::uniform(20), start)
                                      .trajectory.stage_u.cwiseAbs()
                                      .colwise()
                                      .maxCoeff()
                                      .transpose();
  const Restating statement = [&](tests::Restated::Statement& s) { s.u = {-0.8 * largest, 0.8 * largest}; };
  const tests::Restated problem(base, statement);
  const Solved solved = tests::solve(problem, Scheme{"dmoc"}, Grid::uniform(20), start, 1e-11);
  const FeedbackGains gains = gains_of(solved);
  int on_bound = 0;
  for (Eigen::Index k = 0; k < 17; ++k) {
    for (Eigen::Index i = 0; i < 2; ++i) {
      if (std::abs(solved.trajectory.stage_u(k, i)) < 0.8 * largest[i] - 1e-7) continue;
      ++on_bound;
      EXPECT_LT(gains.of_stages[static_cast<std::size_t>(k)].row(i).norm(), 1e-5);
    }
  }
  EXPECT_GT(on_bound, 0);
  expect_slopes(solved, FirstControls(base, Scheme{"dmoc"}, solved.trajectory, 0, statement), 0, 1e-4);
}

// th:equi: one optimal control, whatever the unknowns.
TEST(FeedbackGains, OfDmocAreThoseOfHamiltonianCollocation) {
  for (const auto& problem : tests::problems()) {
    SCOPED_TRACE(problem->name());
    const Grid grid = tests::graded_grid(20);
    const Motion& start = tests::common_start(*problem);
    const FeedbackGains dmoc = gains_of(tests::solve(*problem, Scheme{"dmoc", 2}, grid, start, 1e-11));
    const FeedbackGains hamiltonian = gains_of(tests::solve(*problem, Scheme{"hamiltonian", 2}, grid, start, 1e-11));
    for (const std::size_t row : {0U, 15U, 30U}) {
      const Eigen::MatrixXd& gain = dmoc.of_stages[row];
      ASSERT_EQ(gain.rows(), hamiltonian.of_stages[row].rows());
      EXPECT_LT((gain - hamiltonian.of_stages[row]).norm(), 1e-5 * gain.norm());
    }
  }
}

TEST(FeedbackGains, OfTheDoubleIntegratorApproachTheClosedForm) {
  // From (q, p) to rest at 1 in the time τ that is left: u = 6 (1 - q)/τ² - 4 p/τ.
  const tests::DoubleIntegrator problem;
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    const Solved solved = tests::solve(problem, Scheme{method, 2}, Grid::uniform(32), guessed_motion(problem));
    const FeedbackGains gains = gains_of(solved);
    for (const std::size_t k : {0U, 16U}) {
      // The first stage of an interval lies behind its node: u moves there with the deviation's own motion.
      const double left = 1.0 - solved.trajectory.node_times[static_cast<Eigen::Index>(k)];
      const double behind = solved.trajectory.tableau.c[0] / 32.0;
      const Eigen::RowVector2d at_node(-6.0 / (left * left), -4.0 / left);
      const Eigen::RowVector2d rate(12.0 / (left * left * left), 6.0 / (left * left));
      EXPECT_LT((gains.of_stages[2 * k].row(0) - at_node - behind * rate).norm(), 1e-6 * at_node.norm());
    }
  }
}

TEST(FeedbackGains, EndWhereTheControlsThatAreLeftCannotReachThePrescribedEnd) {
  const tests::DoubleIntegrator problem;  // two intervals with a control each reach both q and p
  const FeedbackGains gains =
      gains_of(tests::solve(problem, Scheme{"dmoc"}, Grid::uniform(8), guessed_motion(problem)));
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(gains.of_stages[k].size() > 0, k < 7) << k;
}

TEST(FeedbackGains, AreRefusedWhereTheControlDoesNotFollowFromTheState) {
  const Brachistochrone free_horizon;
  const Solved solved =
      tests::solve(free_horizon, Scheme{"dmoc"}, Grid::uniform(8), guessed_motion(free_horizon), 1e-8);
  EXPECT_THROW((void)gains_of(solved), Error);
  const tests::DoubleIntegrator problem;
  const auto program = tests::transcribe(problem, Scheme{"dmoc"}, Grid::uniform(8));
  EXPECT_THROW((void)feedback_gains(*program, Eigen::VectorXd::Zero(3), Eigen::VectorXd::Zero(3)), Error);
}

}  // namespace
}  // namespace dmocbench
