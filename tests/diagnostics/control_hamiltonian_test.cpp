#include <cmath>

#include <gtest/gtest.h>

#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/transcription/elements/families.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Restated;
using tests::Scheme;
using Statement = Restated::Statement;

Trajectory solved_on_uniform_grid(const Problem& problem, const Scheme& scheme, Eigen::Index intervals) {
  return tests::solve(problem, scheme, Grid::uniform(intervals), guessed_motion(problem)).trajectory;
}

TEST(ControlHamiltonian, OfTheDoubleIntegratorIsItsClosedForm) {
  // u = 6 - 12t, ψ_p = -u, ψ_q = -12: H = ½u² + ψ_q v + ψ_p u = -½u² - 12v = -18 at all times.
  for (const std::string& method : paper_families()) {
    const Eigen::VectorXd hamiltonian = control_hamiltonian(
        tests::DoubleIntegrator(), solved_on_uniform_grid(tests::DoubleIntegrator(), {method, 2}, 8));
    EXPECT_LT((hamiltonian.array() + 18.0).abs().maxCoeff(), 1e-8) << method;
  }
}

TEST(ControlHamiltonian, IsConstantUpToTheOrderWhereNothingDependsOnTime) {
  const tests::Pendulum pendulum;
  for (const std::string& method : paper_families()) {
    const auto spread = [&](Eigen::Index intervals) {
      const Eigen::VectorXd hamiltonian =
          control_hamiltonian(pendulum, solved_on_uniform_grid(pendulum, {method, 1}, intervals));
      return hamiltonian.maxCoeff() - hamiltonian.minCoeff();
    };
    const double order = std::log2(spread(32) / spread(64));
    EXPECT_GT(order, 1.7) << method;
    EXPECT_LT(order, 2.3) << method;
  }
}

TEST(FreeHorizonResidual, VanishesAtTheBestHorizonAndNotAtAnother) {
  // Effort and time: min ∫ ½u² dt + 18 T from 0 to 1 at rest, J = 6/T³ + 18T, best T = 1.
  const tests::DoubleIntegrator base;
  const auto priced = [&](double price, bool free) {
    return Restated(base, [=](Statement& s) {
      if (free) s.horizon = {0.2, 5.0};
      s.final_cost = [price](const State& last) { return price * last.t; };
    });
  };
  for (const std::string& method : paper_families()) {
    const Restated best = priced(18.0, true);
    const Trajectory trajectory = solved_on_uniform_grid(best, {method, 2}, 8);
    EXPECT_NEAR(trajectory.node_times[8], 1.0, 1e-7) << method;
    EXPECT_NEAR(free_horizon_residual(best, trajectory), 0.0, 1e-6) << method;
    const Restated fixed = priced(10.0, false);
    EXPECT_NEAR(free_horizon_residual(fixed, solved_on_uniform_grid(fixed, {method, 2}, 8)), -8.0, 1e-6) << method;
  }
}

/// L = ½(v + t)², so that the momentum of a given velocity grows with time; q̈ = u - 1. Cost ½u² + 1 from 0 to 1 at
/// rest, T free: J = 3T/2 + 6/T³ + const, hence T⁴ = 12.
class GrowingMomentum final : public tests::SmallProblem {
 public:
  GrowingMomentum() : SmallProblem("growing_momentum", at(0.0, 0.0), at(1.0, 0.0), 1.5, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    const Expression sum = x.v[0] + x.t;
    return 0.5 * sum * sum;
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u[0] * x.u[0] + 1.0; }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    bounds.horizon = {0.5, 5.0};
    return bounds;
  }
};

TEST(FreeHorizonResidual, KnowsMomentaThatGrowWithTime) {
  for (const std::string& method : paper_families()) {
    const Trajectory trajectory = solved_on_uniform_grid(GrowingMomentum(), {method, 2}, 8);
    EXPECT_NEAR(std::pow(trajectory.node_times[8], 4), 12.0, 1e-6) << method;
    EXPECT_NEAR(free_horizon_residual(GrowingMomentum(), trajectory), 0.0, 1e-6) << method;
  }
}

TEST(ControlHamiltonian, NeedsCostates) {
  Trajectory trajectory = solved_on_uniform_grid(tests::DoubleIntegrator(), {"dmoc", 1}, 8);
  trajectory.psi_q.resize(0, 0);
  tests::expect_error_naming({"costates"},
                             [&] { static_cast<void>(control_hamiltonian(tests::DoubleIntegrator(), trajectory)); });
}

}  // namespace
}  // namespace dmocbench
