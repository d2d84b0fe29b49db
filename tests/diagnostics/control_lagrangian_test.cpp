// DMOC's optimality conditions are the discrete Euler-Lagrange equations of the control Lagrangian in its forced form,
// tangent-space collocation's those of its form q'' = a (midpoint rule).
#include "methods/diagnostics/control_lagrangian.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/diagnostics/convergence_order.hpp"
#include "methods/judgement/polish.hpp"
#include "methods/transcription/elements/galerkin_element.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using enum ControlLagrangianForm;

Trajectory optimum_of(const Problem& problem, const tests::Scheme& scheme, const Grid& grid) {
  tests::Solved answer = tests::solve(problem, scheme, grid, tests::common_start(problem));
  polish(*answer.transcription, answer.solution);
  return read_trajectory(*answer.transcription, answer.solution.primal, answer.solution.multipliers);
}

constexpr double rounding_of_residuals = 1e-8;

/// L = |v|²/2 + a(q)·v with a = (0, sin²(x)/2): L_vv is constant and L_vq is not.
class Gyroscopic final : public Problem {
 public:
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return copy_of(*this); }
  [[nodiscard]] ProblemCard card() const override { return {.description = "a particle in a magnetic field"}; }
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x", "y"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"f_x", "f_y"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v.dot(x.v) + 0.5 * sin(x.q[0]) * sin(x.q[0]) * x.v[1];
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return x.u; }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return 0.5 * x.u.dot(x.u); }
  [[nodiscard]] BoundaryState initial_state() const override {
    return {.q = Eigen::Vector2d::Zero(), .v = Eigen::Vector2d::Zero()};
  }
  [[nodiscard]] BoundaryState final_state() const override {
    return {.q = Eigen::Vector2d(2.0, 1.0), .v = Eigen::Vector2d::Zero()};
  }
  [[nodiscard]] double horizon() const override { return 2.0; }
};

TEST(ControlLagrangian, EveryMethodSatisfiesTheFormWhoseVariationItIsToRounding) {
  for (const auto& problem : tests::problems()) {
    const auto left = [&](const char* method, ControlLagrangianForm form) {
      return control_lagrangian_residual(*problem, optimum_of(*problem, {method, 1}, tests::graded_grid(24)), form)
          .largest();
    };
    EXPECT_LT(left("dmoc", forced_euler_lagrange), rounding_of_residuals) << problem->name();
    EXPECT_LT(left("hamiltonian", forced_euler_lagrange), rounding_of_residuals) << problem->name();
    EXPECT_LT(left("tangent", acceleration), rounding_of_residuals) << problem->name();
  }
}

TEST(ControlLagrangian, TheOtherFormLeavesAResidualOfOrderTwo) {
  const Gyroscopic problem;
  for (const bool swapped : {false, true}) {
    std::vector<GridError> residuals;
    for (const Eigen::Index intervals : {32, 64, 128, 256}) {
      const Trajectory answer = optimum_of(problem, {swapped ? "tangent" : "dmoc", 1}, Grid::uniform(intervals));
      const auto other = swapped ? forced_euler_lagrange : acceleration;
      residuals.push_back(
          {1.0 / static_cast<double>(intervals), control_lagrangian_residual(problem, answer, other).largest()});
    }
    EXPECT_NEAR(fit_order(residuals)->order, 2.0, 0.1);
  }
}

TEST(ControlLagrangian, AConstantMassMatrixDoesNotMakeTheMethodsEqualWhereTheGyroscopicForceVaries) {
  const Gyroscopic problem;
  const Grid grid = Grid::uniform(32);
  const Trajectory dmoc = optimum_of(problem, {"dmoc", 1}, grid);
  EXPECT_LT((optimum_of(problem, {"hamiltonian", 1}, grid).stage_u - dmoc.stage_u).lpNorm<Eigen::Infinity>(),
            rounding_of_residuals);
  EXPECT_GT((optimum_of(problem, {"tangent", 1}, grid).stage_u - dmoc.stage_u).lpNorm<Eigen::Infinity>(), 1e-5);
}

TEST(ControlLagrangian, AChangedControlOrCostateIsSeen) {
  const Gyroscopic problem;
  const Trajectory answer = optimum_of(problem, {"dmoc", 1}, Grid::uniform(16));
  Trajectory other = answer;
  other.stage_u(5, 0) += 1e-3;
  EXPECT_GT(control_lagrangian_residual(problem, other, forced_euler_lagrange).control, 1e-5);
  other = answer;
  other.psi_p(5, 1) += 1e-3;
  EXPECT_GT(control_lagrangian_residual(problem, other, forced_euler_lagrange).adjoint, 1e-5);
  other = answer;
  other.q(5, 1) += 1e-3;
  EXPECT_GT(control_lagrangian_residual(problem, other, forced_euler_lagrange).motion, 1e-5);
}

TEST(ControlLagrangian, RefusesSeveralStagesAndMissingCostates) {
  const Gyroscopic problem;
  Trajectory two = optimum_of(problem, {"dmoc", 2}, Grid::uniform(8));
  tests::expect_error_naming({"one stage"}, [&] { (void)control_lagrangian_residual(problem, two, acceleration); });
  two.psi_p.resize(0, 0);
  two.psi_q.resize(0, 0);
  tests::expect_error_naming({"needs costates"},
                             [&] { (void)control_lagrangian_residual(problem, two, acceleration); });
}

/// Unknowns and multipliers that satisfy no equation: the start, and entries of either sign.
GalerkinForm form_at_a_start(const Problem& problem, const std::string& method, const Tableau& quadrature,
                             MultiplierPath path = MultiplierPath::polynomial) {
  Transcription program(problem, *make_element(method), quadrature, tests::graded_grid(12));
  const Eigen::VectorXd x = sample(program, tests::common_start(problem));
  const auto count = static_cast<Eigen::Index>(program.constraint_count());
  const Eigen::VectorXd multipliers =
      Eigen::VectorXd::NullaryExpr(count, [](Eigen::Index i) { return std::sin(1.0 + 2.0 * static_cast<double>(i)); });
  return galerkin_form(program, x, multipliers, path);
}

TEST(GalerkinForm, IsTheLagrangianOfTheProgramForEveryDegreeQuadratureAndControlSpace) {
  for (const auto& problem : tests::problems()) {
    for (const auto& [family, stages] : {std::pair("gauss", 1),
                                         {"gauss", 2},
                                         {"gauss", 3},
                                         {"gauss", 4},
                                         {"lobatto", 2},
                                         {"lobatto", 3},
                                         {"lobatto", 4}}) {
      std::vector<std::string> methods{"dmoc"};
      for (int degree = 1; degree <= std::min(stages, 3); ++degree) {
        for (int nodes = 1; nodes <= std::min(stages, 3); ++nodes) {
          for (const bool is_continuous : {false, true}) {
            if (nodes > 1 || !is_continuous) methods.push_back(galerkin_name(degree, nodes, is_continuous));
          }
        }
      }
      for (const std::string& method : methods) {
        EXPECT_LT(form_at_a_start(*problem, method, make_tableau(family, stages)).difference(), 1e-13)
            << problem->name() << ", " << method << ", " << family << " " << stages;
      }
    }
  }
}

TEST(GalerkinForm, NeedsAMultiplierOfTheDegreeOfTheConfiguration) {
  const Gyroscopic problem;
  const auto straight = [&](const char* method) {
    return form_at_a_start(problem, method, make_tableau("gauss", 3), MultiplierPath::straight).difference();
  };
  EXPECT_LT(straight("galerkin_1_2"), 1e-13);
  EXPECT_GT(straight("galerkin_2_2"), 1e-7);
  EXPECT_GT(straight("dmoc"), 1e-7);
}

TEST(GalerkinForm, RefusesCollocation) {
  tests::expect_error_naming({"dmoc or galerkin"},
                             [] { (void)form_at_a_start(Gyroscopic(), "tangent", make_tableau("gauss", 1)); });
}

}  // namespace
}  // namespace dmocbench
