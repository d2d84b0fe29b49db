// Direct methods converge to the indirect solution with their orders: two roads to one truth.

#include <gtest/gtest.h>

#include "methods/diagnostics/trajectory_error.hpp"
#include "methods/indirect/control_from_costate.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "problems/registry.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

/// Errors of one method on one grid.
struct Errors {
  TrajectoryError direct;
  double node_control = 0.0;  // recomputed from the costates
};

class DirectMethod : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  Errors on(int stages, long long intervals) {
    const Trajectory trajectory = tests::solve(*problem_, {std::get<1>(GetParam()), stages}, Grid::uniform(intervals),
                                               smooth_motion(exact_.trajectory()), 1e-11)
                                      .trajectory;
    const Eigen::MatrixXd controls = ControlFromCostate(*problem_).at_nodes(trajectory);
    Errors errors{.direct = trajectory_error(trajectory, exact_.sampled_like(trajectory))};
    for (Eigen::Index k = 0; k < controls.rows(); ++k) {
      const Eigen::VectorXd u = exact_.at(trajectory.node_times[k]).u;
      errors.node_control = std::max(errors.node_control, (controls.row(k).transpose() - u).norm());
    }
    return errors;
  }
  static double order(double coarse, double fine) { return std::log2(coarse / fine); }

  std::unique_ptr<Problem> problem_ = make_problem(std::get<0>(GetParam()));
  IndirectSolution exact_ = solve_indirect(
      *problem_, tests::solve(*problem_, {"dmoc", 1}, Grid::uniform(96), tests::common_start(*problem_)).trajectory);
};

TEST_P(DirectMethod, ConvergesToTheIndirectSolutionWithOrderTwiceItsStages) {
  const bool orbit = std::get<0>(GetParam()) == "orbital_transfer";
  for (const int stages : {1, 2, 3}) {
    const long long coarse = orbit ? (stages == 3 ? 16 : 32) : 128;  // where the asymptotics begin
    const Errors a = on(stages, coarse);
    const Errors b = on(stages, 2 * coarse);
    const double expected = 2.0 * stages;
    constexpr double margin = 0.3;
    EXPECT_NEAR(order(a.direct.state, b.direct.state), expected, margin) << stages;
    EXPECT_NEAR(order(a.direct.momentum, b.direct.momentum), expected, margin) << stages;
    EXPECT_NEAR(order(*a.direct.costate, *b.direct.costate), expected, margin) << stages;
    EXPECT_NEAR(order(a.node_control, b.node_control), expected, margin) << stages;
    if (!orbit) {
      EXPECT_NEAR(order(a.direct.control, b.direct.control), stages + 1.0, margin) << stages;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, DirectMethod,
                         testing::Combine(testing::Values("orbital_transfer", "two_link_manipulator"),
                                          testing::Values("dmoc", "tangent")),
                         [](const auto& instance) {
                           return std::get<0>(instance.param) + "_" + std::get<1>(instance.param);
                         });

}  // namespace
}  // namespace dmocbench
