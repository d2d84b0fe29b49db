// Stage controls of Gauss s converge with order s + 1, measured without interpolating any control: a reference of order
// 6 has the coarse grid's stage times among its nodes, and there the control follows from the costate.

#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/transcription/elements/families.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

/// The coarse grid's nodes and stage times: stage i of interval k is node k (s + 1) + i + 1.
Grid grid_through_stages(Eigen::Index intervals, const Tableau& tableau) {
  const Eigen::Index s = tableau.stages();
  Eigen::VectorXd nodes(intervals * (s + 1) + 1);
  for (Eigen::Index k = 0; k < intervals; ++k) {
    nodes[k * (s + 1)] = static_cast<double>(k) / static_cast<double>(intervals);
    for (Eigen::Index i = 0; i < s; ++i) {
      nodes[k * (s + 1) + i + 1] = (static_cast<double>(k) + tableau.c[i]) / static_cast<double>(intervals);
    }
  }
  nodes[nodes.size() - 1] = 1.0;
  return Grid::from_nodes(std::move(nodes));
}

/// H_u = 0 with C_u = u + (q̇₁/10, 0) and f_u = (1, 0; q₁, 1).
Eigen::Vector2d control_from_costate(const Trajectory& trajectory, Eigen::Index node) {
  const Eigen::Vector2d psi = trajectory.psi_p.row(node).transpose();
  const double q1 = trajectory.q(node, 0);
  const double v1 = trajectory.v(node, 0);
  return {-0.1 * v1 - psi[0] - q1 * psi[1], -psi[1]};
}

class StageOrder : public testing::TestWithParam<std::tuple<std::string, int>> {};

TEST_P(StageOrder, OfTheControlsIsOneMoreThanTheNumberOfStages) {
  const tests::MovingFrame problem;
  const auto& [method, stages] = GetParam();
  const Tableau tableau = gauss_tableau(stages);
  const Motion& start = tests::common_start(problem);
  std::vector<GridError> errors;
  for (const Eigen::Index intervals : {8, 16, 32}) {
    const Trajectory coarse = tests::solve(problem, {method, stages}, Grid::uniform(intervals), start).trajectory;
    const Trajectory reference =
        tests::solve(problem, {"hamiltonian", 3}, grid_through_stages(intervals, tableau), start).trajectory;
    double worst = 0.0;
    for (Eigen::Index k = 0; k < intervals; ++k) {
      for (Eigen::Index i = 0; i < stages; ++i) {
        const Eigen::Index node = k * (stages + 1) + i + 1;
        ASSERT_NEAR(reference.node_times[node], coarse.stage_times[k * stages + i], 1e-14);
        const Eigen::Vector2d u = coarse.stage_u.row(k * stages + i).transpose();
        worst = std::max(worst, (u - control_from_costate(reference, node)).norm());
      }
    }
    errors.push_back({1.0 / static_cast<double>(intervals), worst});
  }
  const double slope = fit_order(errors)->order;
  EXPECT_GT(slope, stages + 1 - 0.2);
  EXPECT_LT(slope, stages + 1 + 0.2);
}

INSTANTIATE_TEST_SUITE_P(All, StageOrder,
                         testing::Combine(testing::ValuesIn(paper_families()), testing::Values(1, 2, 3)),
                         [](const auto& instance) {
                           return std::get<0>(instance.param) + "_" + std::to_string(std::get<1>(instance.param));
                         });

}  // namespace
}  // namespace dmocbench
