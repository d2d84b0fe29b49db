// ψ is the gradient of the optimal cost-to-go: held against differences of optimal costs of neighbouring problems, not
// against another formula for costates.

#include "methods/transcription/costates.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "methods/mechanics/legendre_transform.hpp"
#include "methods/transcription/elements/families.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::problem_named;
using tests::Scheme;
using tests::Solved;

struct NamedTableau {
  std::string family;
  int stages;
};

class CostatesOf : public testing::TestWithParam<std::tuple<std::string, std::string, NamedTableau>> {
 protected:
  std::unique_ptr<Problem> problem_ = problem_named(std::get<0>(GetParam()));
  Scheme scheme_{std::get<1>(GetParam()), std::get<2>(GetParam()).stages, std::get<2>(GetParam()).family};
  Grid grid_ = tests::graded_grid(24);
  Solved solved_ = tests::solve(*problem_, scheme_, grid_, tests::common_start(*problem_), 1e-11);
};

/// The optimal cost if the motion starts at (q, p) instead; `end_too` moves the final state as well.
class OptimalCost {
 public:
  OptimalCost(const Problem& problem, Scheme scheme, Grid grid, const Trajectory& near)
      : problem_(problem),
        scheme_(std::move(scheme)),
        grid_(std::move(grid)),
        start_(smooth_motion(near)),
        legendre_(TracedProblem(problem)) {}

  double from(const Eigen::VectorXd& q, const Eigen::VectorXd& p) {
    const Eigen::VectorXd v = legendre_.velocity(q, p, 0.0, problem_.initial_state().v);
    return of(tests::WithEnds(problem_, {q, v}, problem_.final_state()));
  }
  double to(const Eigen::VectorXd& q, const Eigen::VectorXd& p) {
    const Eigen::VectorXd v = legendre_.velocity(q, p, problem_.horizon(), problem_.final_state().v);
    return of(tests::WithEnds(problem_, problem_.initial_state(), {q, v}));
  }

 private:
  double of(const Problem& neighbour) { return tests::solve(neighbour, scheme_, grid_, start_, 1e-11).trajectory.cost; }
  const Problem& problem_;
  Scheme scheme_;
  Grid grid_;
  Motion start_;
  LegendreTransform legendre_;
};

/// Gradient of `cost`(q, p), q first: Richardson's extrapolation of central differences.
template <class Cost>
Eigen::VectorXd gradient_of(const Eigen::VectorXd& q, const Eigen::VectorXd& p, const Cost& cost) {
  const Eigen::Index n = q.size();
  Eigen::VectorXd slopes(2 * n);
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const auto moved = [&](double e) {
      Eigen::VectorXd at_q = q;
      Eigen::VectorXd at_p = p;
      (i < n ? at_q[i] : at_p[i - n]) += e;
      return cost(at_q, at_p);
    };
    const auto central = [&](double e) { return (moved(e) - moved(-e)) / (2.0 * e); };
    constexpr double step = 2e-3;
    slopes[i] = (4.0 * central(step / 2.0) - central(step)) / 3.0;
  }
  return slopes;
}

Eigen::VectorXd costate(const Trajectory& trajectory, Eigen::Index k) {
  Eigen::VectorXd psi(2 * trajectory.q.cols());
  psi << trajectory.psi_q.row(k).transpose(), trajectory.psi_p.row(k).transpose();
  return psi;
}

TEST_P(CostatesOf, TheFirstNodeAreTheSlopeOfTheOptimalCostInTheInitialState) {
  OptimalCost optimal(*problem_, scheme_, grid_, solved_.trajectory);
  const Trajectory& trajectory = solved_.trajectory;
  const Eigen::VectorXd measured = gradient_of(trajectory.q.row(0).transpose(), trajectory.p.row(0).transpose(),
                                               [&](const auto& q, const auto& p) { return optimal.from(q, p); });
  const Eigen::VectorXd psi = costate(trajectory, 0);
  EXPECT_LT((psi - measured).norm(), 1e-4 * psi.norm()) << psi.transpose() << " against " << measured.transpose();
}

TEST_P(CostatesOf, TheLastNodeAreMinusTheSlopeOfTheOptimalCostInTheFinalState) {
  // V(x₀, x_N): the cost-to-go from node N is a multiplier of the final condition, hence the sign.
  OptimalCost optimal(*problem_, scheme_, grid_, solved_.trajectory);
  const Trajectory& trajectory = solved_.trajectory;
  const Eigen::Index end = trajectory.intervals();
  const Eigen::VectorXd measured = gradient_of(trajectory.q.row(end).transpose(), trajectory.p.row(end).transpose(),
                                               [&](const auto& q, const auto& p) { return optimal.to(q, p); });
  const Eigen::VectorXd psi = costate(trajectory, end);
  EXPECT_LT((psi + measured).norm(), 1e-4 * psi.norm()) << psi.transpose() << " against " << measured.transpose();
}

TEST_P(CostatesOf, InnerNodesAreTheSameSeenFromTheLeftAndFromTheRight) {
  // ψ_k = ∂ℓ_k/∂x_k = -∂ℓ_{k-1}/∂x_k: their sum is the stationarity of the program in x_k. Taken from the program's
  // own gradient and Jacobian split by interval, by solving the same problem cut at node k.
  Transcription& program = *solved_.transcription;
  const Eigen::Index n = program.traced_problem().configuration_size();
  const bool second = program.node_state() != NodeState::configuration;
  const Eigen::Index size = second ? 2 * n : n;
  const Eigen::MatrixXd sides = [&] {
    const Tape tape(program.functions().adjoint);
    Tape::Workspace workspace(tape);
    Eigen::MatrixXd table(static_cast<Eigen::Index>(grid_.intervals()), 2 * size);
    std::vector<double*> outputs;
    for (Eigen::Index j = 0; j < table.cols(); ++j) outputs.push_back(table.col(j).data());
    tape.evaluate(grid_.intervals(), program.bind(solved_.solution.primal, solved_.solution.multipliers, 1.0), outputs,
                  workspace);
    return table;
  }();
  const double scale = sides.lpNorm<Eigen::Infinity>();
  ASSERT_GT(scale, 0.0);
  for (Eigen::Index k = 1; k < sides.rows(); ++k) {
    EXPECT_LT((sides.row(k).head(size) + sides.row(k - 1).tail(size)).lpNorm<Eigen::Infinity>(), 1e-8 * scale);
  }
}

std::string name_of(const std::tuple<std::string, std::string, NamedTableau>& parameters) {
  const auto& [problem, method, tableau] = parameters;
  return problem + "_" + method + "_" + tableau.family + "_" + std::to_string(tableau.stages);
}

INSTANTIATE_TEST_SUITE_P(All, CostatesOf,
                         testing::Combine(testing::Values("orbital_transfer", "two_link_manipulator", "moving_frame"),
                                          testing::ValuesIn(paper_families()),
                                          testing::Values(NamedTableau{"gauss", 1}, NamedTableau{"gauss", 2})),
                         [](const auto& instance) { return name_of(instance.param); });

INSTANTIATE_TEST_SUITE_P(OfSecondOrder, CostatesOf,
                         testing::Combine(testing::Values("orbital_transfer", "moving_frame"),
                                          testing::Values("second_order"),
                                          testing::Values(NamedTableau{"gauss", 1}, NamedTableau{"lobatto", 3})),
                         [](const auto& instance) { return name_of(instance.param); });

// More stages and the pair of Lobatto for the two families of the theorem.
INSTANTIATE_TEST_SUITE_P(HighOrder, CostatesOf,
                         testing::Combine(testing::Values("orbital_transfer", "two_link_manipulator", "moving_frame"),
                                          testing::Values("dmoc", "hamiltonian"),
                                          testing::Values(NamedTableau{"gauss", 3}, NamedTableau{"lobatto", 2},
                                                          NamedTableau{"lobatto", 3})),
                         [](const auto& instance) { return name_of(instance.param); });

TEST(Costates, OfTheDoubleIntegratorApproachTheClosedForm) {
  // H = ½u² + ψ_q p + ψ_p u: u = -ψ_p = 6 - 12t, ψ_q = -ψ̇_p = -12.
  const tests::DoubleIntegrator problem;
  for (const std::string& method : paper_families()) {
    const Trajectory trajectory =
        tests::solve(problem, {method, 2}, Grid::uniform(8), guessed_motion(problem)).trajectory;
    ASSERT_TRUE(trajectory.has_costates());
    for (Eigen::Index k = 0; k <= 8; ++k) {
      EXPECT_NEAR(trajectory.psi_q(k, 0), -12.0, 1e-8) << method;
      EXPECT_NEAR(trajectory.psi_p(k, 0), 12.0 * trajectory.node_times[k] - 6.0, 1e-8) << method;
    }
  }
}

TEST(Costates, AreLeftOutWithoutMultipliers) {
  const tests::DoubleIntegrator problem;
  const auto program = tests::transcribe(problem, {"dmoc", 1}, Grid::uniform(8));
  const Trajectory trajectory = read_trajectory(*program, sample(*program, guessed_motion(problem)), Eigen::VectorXd());
  EXPECT_FALSE(trajectory.has_costates());
}

INSTANTIATE_TEST_SUITE_P(OfShooting, CostatesOf,
                         testing::Combine(testing::Values("moving_frame"), testing::Values("multiple_shooting_rk4_2"),
                                          testing::Values(NamedTableau{"gauss", 2})),
                         [](const auto& instance) { return name_of(instance.param); });

}  // namespace
}  // namespace dmocbench
