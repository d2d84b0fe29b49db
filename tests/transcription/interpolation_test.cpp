#include "methods/transcription/motions/interpolation.hpp"

#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "problems/registry.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::RandomPoints;

/// A point of a program, not a solution: interpolation must not rely on being one.
Trajectory arbitrary_trajectory(const std::string& method, int stages, const Grid& grid) {
  const auto problem = make_problem("two_link_manipulator");
  const auto program = tests::transcribe(*problem, {method, stages}, grid);
  const Eigen::VectorXd x = sample(*program, guessed_motion(*problem));
  return read_trajectory(*program, x + RandomPoints().vector(x.size(), -0.1, 0.1), Eigen::VectorXd());
}

/// Samples of a smooth control at the stage times of a uniform grid on [0, 1].
Trajectory sampled_control(const Tableau& tableau, Eigen::Index intervals, double (*u)(double)) {
  Trajectory trajectory;
  trajectory.tableau = tableau;
  const Eigen::Index stages = tableau.stages();
  trajectory.node_times = Eigen::VectorXd::LinSpaced(intervals + 1, 0.0, 1.0);
  trajectory.stage_times.resize(intervals * stages);
  trajectory.stage_u.resize(intervals * stages, 1);
  for (Eigen::Index row = 0; row < trajectory.stage_times.size(); ++row) {
    const Eigen::Index interval = row / stages;
    const double t =
        (static_cast<double>(interval) + trajectory.tableau.c[row % stages]) / static_cast<double>(intervals);
    trajectory.stage_times[row] = t;
    trajectory.stage_u(row, 0) = u(t);
  }
  return trajectory;
}

TEST(ConfigurationAt, ReproducesTheNodesExactlyAndTheStagesToRounding) {
  for (const tests::Scheme& scheme : tests::all_schemes()) {
    if (scheme.method == "tangent") continue;  // off a solution its V_i are not its Q̇_i
    const Trajectory trajectory = arbitrary_trajectory(scheme.method, scheme.stages, tests::graded_grid(6));
    for (Eigen::Index k = 0; k <= 6; ++k) {
      const Eigen::VectorXd q = configuration_at(trajectory, trajectory.node_times[k]);
      EXPECT_EQ(q, trajectory.q.row(k).transpose());
    }
    for (Eigen::Index row = 0; row < trajectory.stage_times.size(); ++row) {
      const Eigen::VectorXd q = configuration_at(trajectory, trajectory.stage_times[row]);
      EXPECT_LT((q - trajectory.stage_q.row(row).transpose()).norm(), 1e-14) << scheme.label();
    }
  }
}

TEST(ConfigurationAt, IsContinuousAndOnEveryIntervalAPolynomialOfDegreeS) {
  for (const int s : {1, 2, 3}) {
    const Trajectory trajectory = arbitrary_trajectory("dmoc", s, tests::graded_grid(5));
    for (Eigen::Index k = 0; k < 5; ++k) {
      const double left = trajectory.node_times[k];
      const double h = trajectory.node_times[k + 1] - left;
      // The difference of order s + 1 over s + 2 equidistant points, ends included, vanishes; that of order s does not.
      const auto difference = [&](int order) {
        Eigen::MatrixXd values(2, order + 1);
        for (int j = 0; j <= order; ++j) {
          const double shrink = 1.0 - 1e-13;  // the last point from inside, not the node's own value
          values.col(j) = configuration_at(trajectory, left + h * shrink * j / order);
        }
        for (int o = 0; o < order; ++o) {
          for (int j = order; j > o; --j) values.col(j) -= values.col(j - 1);
        }
        return values.col(order).norm();
      };
      EXPECT_LT(difference(s + 1), 1e-12) << "s = " << s;
      EXPECT_GT(difference(s), 1e-5) << "s = " << s;
    }
  }
}

TEST(ConfigurationAt, MovesTimesOutsideTheHorizonToItsEnds) {
  const Trajectory trajectory = arbitrary_trajectory("dmoc", 2, Grid::uniform(4));
  EXPECT_EQ(configuration_at(trajectory, -1.0), trajectory.q.row(0).transpose());
  EXPECT_EQ(configuration_at(trajectory, 2.0), trajectory.q.row(4).transpose());
}

TEST(ControlAt, ReproducesTheStageControls) {
  for (const int s : {1, 2, 3}) {
    const Trajectory trajectory = arbitrary_trajectory("dmoc", s, tests::graded_grid(5));
    for (Eigen::Index row = 0; row < trajectory.stage_times.size(); ++row) {
      const double t = trajectory.stage_times[row];
      const Eigen::VectorXd u = trajectory.stage_u.row(row).transpose();
      EXPECT_LT((control_at(trajectory, t) - u).norm(), 1e-12);
      EXPECT_LT((control_on_interval(trajectory, row / s, t) - u).norm(), 1e-12);
    }
  }
}

TEST(ControlAt, IsOfOrderTwoForOneStageAndOfOrderSForMore) {
  const auto control = [](double t) { return std::sin(5.0 * t); };
  for (const int s : {1, 2, 3}) {
    std::vector<GridError> errors;
    for (const Eigen::Index intervals : {40, 80, 160}) {
      const Trajectory trajectory = sampled_control(gauss_tableau(s), intervals, control);
      double worst = 0.0;
      for (int i = 0; i <= 1000; ++i) {
        const double t = i / 1000.0;
        worst = std::max(worst, std::abs(control_at(trajectory, t)[0] - control(t)));
      }
      errors.push_back({1.0 / static_cast<double>(intervals), worst});
    }
    EXPECT_NEAR(fit_order(errors)->order, std::max(2, s), 0.1) << "s = " << s;
  }
}

TEST(ReferenceControlAt, IsOfHigherOrderThanTheStageControls) {
  const auto control = [](double t) { return std::sin(5.0 * t); };
  for (const Tableau& tableau : {gauss_tableau(1), gauss_tableau(2), gauss_tableau(3), lobatto_tableau(3)}) {
    std::vector<GridError> errors;
    for (const Eigen::Index intervals : {20, 40, 80}) {
      const Trajectory trajectory = sampled_control(tableau, intervals, control);
      const double end = 1.0 / static_cast<double>(intervals);
      double worst = 0.0;
      for (int i = 0; i <= 1000; ++i) {
        const double t = 1.5 * end + (1.0 - 3.0 * end) * i / 1000.0;
        worst = std::max(worst, std::abs(reference_control_at(trajectory, t)[0] - control(t)));
      }
      errors.push_back({end, worst});
    }
    EXPECT_NEAR(fit_order(errors)->order, static_cast<double>(tableau.stages()) + 2.0, 0.1);
  }
}

TEST(ReferenceControlAt, ReproducesTheStageControls) {
  for (const std::string tableau : {"gauss", "lobatto"}) {
    const Trajectory trajectory = sampled_control(tableau == "gauss" ? gauss_tableau(3) : lobatto_tableau(3), 5,
                                                  [](double t) { return std::exp(t); });
    for (Eigen::Index row = 0; row < trajectory.stage_times.size(); ++row) {
      const Side side = trajectory.tableau.c[row % 3] == 1.0 ? Side::left : Side::right;
      EXPECT_NEAR(reference_control_at(trajectory, trajectory.stage_times[row], side)[0], trajectory.stage_u(row, 0),
                  1e-13);
    }
  }
}

TEST(ControlAt, IsExactForLinearControlsUpToTheEndsOfTheHorizon) {
  const auto line = [](double t) { return 3.0 - 7.0 * t; };
  for (const int s : {1, 2, 3}) {
    const Trajectory trajectory = sampled_control(gauss_tableau(s), 6, line);
    for (const double t : {0.0, 0.01, 0.3, 0.5, 0.77, 0.999, 1.0}) {
      EXPECT_NEAR(control_at(trajectory, t)[0], line(t), 1e-13) << "s = " << s << ", t = " << t;
    }
  }
}

TEST(ControlOnInterval, IsConstantForOneStageAndDoesNotLookAtItsNeighbours) {
  const Trajectory one = sampled_control(gauss_tableau(1), 4, [](double t) { return t * t; });
  EXPECT_EQ(control_on_interval(one, 2, 0.5)[0], control_on_interval(one, 2, 0.75)[0]);
  Trajectory two = sampled_control(gauss_tableau(2), 4, [](double t) { return t * t; });
  const double before = control_on_interval(two, 1, 0.4)[0];
  two.stage_u.row(1).setConstant(99.0);
  two.stage_u.row(4).setConstant(99.0);
  EXPECT_EQ(control_on_interval(two, 1, 0.4)[0], before);
}

TEST(SmoothMotion, PassesThroughTheNodesWithTheirVelocities) {
  const Trajectory trajectory = arbitrary_trajectory("hamiltonian", 1, tests::graded_grid(6));
  const Motion motion = smooth_motion(trajectory);
  for (Eigen::Index k = 0; k <= 6; ++k) {
    const MotionPoint point = motion.at(trajectory.node_times[k]);
    EXPECT_LT((point.q - trajectory.q.row(k).transpose()).norm(), 1e-13);
    EXPECT_LT((point.v - trajectory.v.row(k).transpose()).norm(), 1e-12);
  }
}

TEST(SmoothMotion, HasTheVelocityThatIsTheSlopeOfItsConfiguration) {
  const Motion motion = smooth_motion(arbitrary_trajectory("dmoc", 1, Grid::uniform(6)));
  constexpr double e = 1e-6;
  for (const double t : {0.05, 0.21, 0.5001, 0.83}) {
    const Eigen::VectorXd slope = (motion.at(t + e).q - motion.at(t - e).q) / (2.0 * e);
    EXPECT_LT((slope - motion.at(t).v).norm(), 1e-7);
  }
}

TEST(SmoothMotion, ExistsOnASingleInterval) {
  const auto problem = make_problem("two_link_manipulator");
  const auto program = tests::transcribe(*problem, {"dmoc", 2}, Grid::uniform(1));
  const Trajectory trajectory =
      read_trajectory(*program, sample(*program, guessed_motion(*problem)), Eigen::VectorXd());
  EXPECT_LT((smooth_motion(trajectory).at(1.0).q - problem->final_state().q).norm(), 1e-14);
}

}  // namespace
}  // namespace dmocbench
