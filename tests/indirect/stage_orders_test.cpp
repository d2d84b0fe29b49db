// Orders of what is known at the stages and at the nodes, for both families of the theorems and both families of
// tableaus, against the indirect solution of the two-link manipulator (the orbit's costate is nearly constant, and its
// low-order terms are too small to be seen).

#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/diagnostics/trajectory_error.hpp"
#include "methods/indirect/control_from_costate.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/judgement/polish.hpp"
#include "problems/registry.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

/// Orders that are expected of a tableau.
struct Orders {
  std::string family;
  int stages;
  double nodes;       ///< q, p, ψ, u(x, ψ)
  double collocated;  ///< Q_i, Ψ^p_i and U_i, which the first half of the pair computes
  double conjugate;   ///< P_i and Ψ^q_i, which the other half computes
};

std::ostream& operator<<(std::ostream& out, const Orders& orders) { return out << orders.family << orders.stages; }

class StageOrders : public testing::TestWithParam<std::tuple<std::string, Orders>> {
 protected:
  static const Problem& problem() {
    static const auto two_link = make_problem("two_link_manipulator");
    return *two_link;
  }
  /// Solved once.
  static const IndirectSolution& exact() {
    static const IndirectSolution solution = solve_indirect(
        problem(), tests::solve(problem(), {"dmoc", 1}, Grid::uniform(96), tests::common_start(problem())).trajectory);
    return solution;
  }
  static Trajectory polished(const tests::Scheme& scheme, Eigen::Index intervals) {
    tests::Solved solved =
        tests::solve(problem(), scheme, Grid::uniform(intervals), smooth_motion(exact().trajectory()));
    polish(*solved.transcription, solved.solution);
    return read_trajectory(*solved.transcription, solved.solution.primal, solved.solution.multipliers);
  }
  static std::map<std::string, double> errors_of(const tests::Scheme& scheme, Eigen::Index intervals) {
    const Trajectory trajectory = polished(scheme, intervals);
    const Trajectory reference = exact().sampled_like(trajectory);
    const TrajectoryError error = trajectory_error(trajectory, reference);
    EXPECT_TRUE(error.stages.has_value());
    const StageError stages = error.stages.value_or(StageError());
    return {{"q", error.state},
            {"p", error.momentum},
            {"psi", error.costate.value_or(0.0)},
            {"u(x, psi)", node_control_error(problem(), trajectory, reference)},
            {"Q", stages.configuration},
            {"Psi_p", stages.costate_p.value_or(0.0)},
            {"U", error.control},
            {"P", stages.momentum},
            {"Psi_q", stages.costate_q.value_or(0.0)}};
  }
};

void expect_order(const std::map<std::string, std::vector<GridError>>& errors,
                  const std::vector<std::string>& quantities, double order) {
  for (const std::string& quantity : quantities) {
    const double slope = fit_order(errors.at(quantity)).value_or(FittedOrder()).order;
    EXPECT_NEAR(slope, order, 0.35) << quantity;
  }
}

TEST_P(StageOrders, AreLowerThanThatOfTheNodes) {
  const auto& [method, expected] = GetParam();
  std::map<std::string, std::vector<GridError>> errors;
  for (const Eigen::Index intervals : {64, 96, 128, 192}) {
    for (const auto& [quantity, error] : errors_of({method, expected.stages, expected.family}, intervals)) {
      errors[quantity].push_back({1.0 / static_cast<double>(intervals), error});
    }
  }
  expect_order(errors, {"q", "p", "psi", "u(x, psi)"}, expected.nodes);
  expect_order(errors, {"Q", "Psi_p", "U"}, expected.collocated);
  expect_order(errors, {"P", "Psi_q"}, expected.conjugate);
}

// Gauss is its own conjugate: s + 1 for all. Lobatto: min(2s - 2, s + 1) and s - 1.
INSTANTIATE_TEST_SUITE_P(
    All, StageOrders,
    testing::Combine(testing::Values("dmoc", "hamiltonian"),
                     testing::Values(Orders{"gauss", 1, 2.0, 2.0, 2.0}, Orders{"gauss", 2, 4.0, 3.0, 3.0},
                                     Orders{"gauss", 3, 6.0, 4.0, 4.0}, Orders{"lobatto", 2, 2.0, 2.0, 1.0},
                                     Orders{"lobatto", 3, 4.0, 4.0, 2.0}, Orders{"lobatto", 4, 6.0, 5.0, 3.0})),
    [](const auto& instance) {
      const Orders& orders = std::get<1>(instance.param);
      return std::get<0>(instance.param) + "_" + orders.family + "_" + std::to_string(orders.stages);
    });

}  // namespace
}  // namespace dmocbench
