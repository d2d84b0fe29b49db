#include "methods/transcription/elements/second_order_element.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "methods/diagnostics/replay_error.hpp"
#include "methods/diagnostics/trajectory_error.hpp"
#include "methods/mechanics/equations_of_motion.hpp"
#include "methods/transcription/sample_multipliers.hpp"
#include "problems/registry.hpp"
#include "problems/two_link_manipulator.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

/// The acceleration that the equations of motion give, by formulas that no element uses.
class Accelerations {
 public:
  explicit Accelerations(const Problem& problem) : traced_(problem), motion_(traced_) {}
  Eigen::VectorXd at(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& u, double t) {
    return motion_.acceleration(q, v, u, t, Eigen::VectorXd());
  }

 private:
  TracedProblem traced_;
  EquationsOfMotion motion_;
};

TEST(SecondOrderElement, WithOneStageStepsAreParabolasWithTheAccelerationOfTheirMiddle) {
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    Accelerations accelerations(*problem);
    const Trajectory solved =
        tests::solve(*problem, {"second_order", 1}, tests::graded_grid(32), tests::common_start(*problem)).trajectory;
    for (Eigen::Index k = 0; k < solved.intervals(); ++k) {
      SCOPED_TRACE(name + ", interval " + std::to_string(k));
      const double h = solved.node_times[k + 1] - solved.node_times[k];
      const MotionPoint left = solved.node(k);
      const MotionPoint right = solved.node(k + 1);
      const Eigen::VectorXd a = (right.v - left.v) / h;
      EXPECT_LT((left.q + h * left.v + 0.5 * h * h * a - right.q).norm(), 1e-9);
      const Eigen::VectorXd middle = left.q + 0.5 * h * left.v + 0.125 * h * h * a;
      const Eigen::VectorXd expected = accelerations.at(middle, left.v + 0.5 * h * a, solved.stage_u.row(k).transpose(),
                                                        solved.node_times[k] + 0.5 * h);
      EXPECT_LT((a - expected).norm(), 1e-7 * std::max(1.0, expected.norm()));
    }
  }
}

TEST(SecondOrderElement, WithTwoLobattoStagesAccelerationsAreStraightBetweenTheNodes) {
  const auto problem = make_problem("two_link_manipulator");
  Accelerations accelerations(*problem);
  const Trajectory solved =
      tests::solve(*problem, {"second_order", 2, "lobatto"}, Grid::uniform(32), tests::common_start(*problem))
          .trajectory;
  for (Eigen::Index k = 0; k < solved.intervals(); ++k) {
    SCOPED_TRACE(k);
    const double h = solved.node_times[k + 1] - solved.node_times[k];
    const MotionPoint left = solved.node(k);
    const MotionPoint right = solved.node(k + 1);
    const Eigen::VectorXd at_left = accelerations.at(left.q, left.v, solved.stage_u.row(2 * k).transpose(), 0.0);
    const Eigen::VectorXd at_right = accelerations.at(right.q, right.v, solved.stage_u.row(2 * k + 1).transpose(), 0.0);
    EXPECT_LT((left.v + 0.5 * h * (at_left + at_right) - right.v).norm(), 1e-8);
    EXPECT_LT((left.q + h * left.v + h * h / 6.0 * (2.0 * at_left + at_right) - right.q).norm(), 1e-9);
  }
}

TEST(SecondOrderElement, HasOneRatePerIntervalMoreThanDmocAndFewerUnknownsThanCollocationForMoreStagesThanOne) {
  const TwoLinkManipulator problem;
  const Eigen::Index n = problem.configuration_size();
  const auto unknowns_of_an_interval = [&](const char* method, int stages) {
    const auto count = [&](Eigen::Index intervals) {
      return tests::transcribe(problem, {method, stages}, Grid::uniform(intervals))->variable_count();
    };
    return static_cast<Eigen::Index>(count(9) - count(8));
  };
  for (const int s : {1, 2, 3, 4}) {
    SCOPED_TRACE(s);
    const Eigen::Index ours = unknowns_of_an_interval("second_order", s);
    EXPECT_EQ(ours - unknowns_of_an_interval("dmoc", s), n);
    EXPECT_EQ(unknowns_of_an_interval("tangent", s) - ours, (s - 1) * n);
  }
}

TEST(SecondOrderElement, HasSmallerErrorsAtTheNodesThanDmocButALargerErrorOfReplay) {
  // The figures are those of a program by hand in numpy, N = 64.
  const TwoLinkManipulator problem;
  const Motion& start = tests::common_start(problem);
  const Trajectory reference = tests::solve(problem, {"dmoc", 3}, Grid::uniform(128), start, 1e-11).trajectory;
  const auto errors = [&](const char* method) {
    const Trajectory solved = tests::solve(problem, {method, 1}, Grid::uniform(64), start, 1e-11).trajectory;
    return Eigen::Vector3d(trajectory_error(solved, reference).state, solved.cost - reference.cost,
                           replay_error(problem, solved).norm());
  };
  EXPECT_LT((errors("second_order") - Eigen::Vector3d(0.00168, -0.024, 1.31)).cwiseAbs().maxCoeff(), 6e-3);
  EXPECT_NEAR(errors("second_order")[0], 0.00168, 6e-6);
  EXPECT_LT((errors("dmoc") - Eigen::Vector3d(0.00242, 0.098, 0.157)).cwiseAbs().maxCoeff(), 6e-4);
}

TEST(SecondOrderElement, MultipliersOfACoarserGridApproachThoseOfAFinerWithOrderTwo) {
  const TwoLinkManipulator problem;
  const Motion& start = tests::common_start(problem);
  for (const int s : {1, 2}) {
    const tests::Solved fine = tests::solve(problem, Scheme{"second_order", s}, Grid::uniform(256), start);
    const Eigen::VectorXd& expected = fine.solution.multipliers;
    const auto error_from = [&](Eigen::Index intervals) {
      const Trajectory coarse =
          tests::solve(problem, Scheme{"second_order", s}, Grid::uniform(intervals), start).trajectory;
      return (sample_multipliers(*fine.transcription, coarse) - expected).lpNorm<Eigen::Infinity>();
    };
    EXPECT_GT(std::log2(error_from(48) / error_from(96)), 1.7) << s;
  }
}

}  // namespace
}  // namespace dmocbench
