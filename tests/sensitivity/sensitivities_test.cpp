// Sensitivities are derivatives of answers: held against differences of answers of neighbouring programs.

#include "methods/sensitivity/sensitivities.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/judgement/polish.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"
#include "problems/two_link_manipulator.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

/// A program for every value of a parameter.
using Family = std::function<std::unique_ptr<Transcription>(double)>;

Solution answer(Transcription& program, const Eigen::VectorXd& start) {
  SolverOptions options;
  options.tolerance = 1e-12;
  Solution solution = make_solver("interior_point", options)->solve(program, start);
  EXPECT_EQ(solution.status, Status::solved) << solution.message;
  polish(program, solution);
  return solution;
}

/// The derivatives at `value`, and central differences of answers, of steps `step` and a quarter of it. Their distance
/// falls with the second power of the step.
void expect_derivatives(const Family& family, double value, double step, const Motion& start) {
  const auto program = family(value);
  const Solution here = answer(*program, sample(*program, start));
  const auto values_at = [&](double at) { return values_of(*family(at), here.primal, here.multipliers); };
  const double distance = 1e-4 * step;
  const ProgramValues rate = rate_of_change(values_at(value - distance), values_at(value + distance), 2.0 * distance);
  const Sensitivity found = Sensitivities(*program, here.primal, here.multipliers).along(rate);

  struct Errors {
    double cost;
    double motion;
    double multipliers;
  };
  const auto errors = [&](double e) {
    const auto at = [&](double moved) {
      const auto neighbour = family(moved);
      return answer(*neighbour,
                    here.primal.cwiseMax(neighbour->variable_lower()).cwiseMin(neighbour->variable_upper()));
    };
    const Solution above = at(value + e);
    const Solution below = at(value - e);
    const auto distance_of = [&](const Eigen::VectorXd& up, const Eigen::VectorXd& down, const Eigen::VectorXd& slope) {
      return ((up - down) / (2.0 * e) - slope).norm() / slope.norm();
    };
    return Errors{std::abs((above.objective - below.objective) / (2.0 * e) - found.objective) /
                      std::max(std::abs(found.objective), std::abs(here.objective)),
                  distance_of(above.primal, below.primal, found.primal),
                  distance_of(above.multipliers, below.multipliers, found.multipliers)};
  };
  const Errors coarse = errors(step);
  const Errors fine = errors(step / 4.0);
  const auto expect_order_two = [](double of_coarse, double of_fine, const char* what) {
    EXPECT_LT(of_fine, std::max(of_coarse / 8.0, 2e-6)) << what << ", coarse " << of_coarse;
    EXPECT_LT(of_fine, 1e-2) << what;
  };
  expect_order_two(coarse.cost, fine.cost, "cost");
  expect_order_two(coarse.motion, fine.motion, "motion");
  expect_order_two(coarse.multipliers, fine.multipliers, "multipliers");
}

TEST(Sensitivities, InAParameterAreTheSlopesOfAnswers) {
  for (const auto& [name, parameter] :
       {std::pair{"orbital_transfer", "target_altitude"}, std::pair{"two_link_manipulator", "mass_1"},
        std::pair{"double_integrator", "horizon"}}) {
    const double value = make_problem(name)->parameter(parameter);
    const auto base = make_problem(name);
    for (const std::string& method : paper_families()) {
      SCOPED_TRACE(std::string(name) + " " + method);
      const Family family = [&](double moved) {
        const auto problem = make_problem(name);
        problem->set_parameter(parameter, moved);
        return tests::transcribe(*problem, Scheme{method}, Grid::uniform(24));
      };
      expect_derivatives(family, value, 0.04 * value, tests::common_start(*base));
    }
  }
}

TEST(Sensitivities, InEndStatesAreTheSlopesOfAnswers) {
  const TwoLinkManipulator base;
  for (const std::string& method : paper_families()) {
    for (const bool is_first : {true, false}) {
      SCOPED_TRACE(std::string(method) + (is_first ? " first" : " last"));
      const Family family = [&](double moved) {
        BoundaryState first = base.initial_state();
        BoundaryState last = base.final_state();
        BoundaryState& end = is_first ? first : last;
        end.q[0] += moved;
        end.v[1] += 0.5 * moved;
        const tests::WithEnds problem(base, first, last);
        return tests::transcribe(problem, Scheme{method}, Grid::uniform(24));
      };
      expect_derivatives(family, 0.0, 0.02, tests::common_start(base));
    }
  }
}

TEST(Sensitivities, WhereControlsAreOnTheirBoundsMoveWithThem) {
  const TwoLinkManipulator base;
  const Motion& start = tests::common_start(base);
  const double largest =
      tests::solve(base, Scheme{"dmoc"}, Grid::uniform(24), start).trajectory.stage_u.cwiseAbs().maxCoeff();
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    const Family family = [&](double share) {
      const tests::Restated problem(base, [&](tests::Restated::Statement& statement) {
        statement.u = tests::all_between(2, -share * largest, share * largest);
      });
      return tests::transcribe(problem, Scheme{method}, Grid::uniform(24));
    };
    expect_derivatives(family, 0.85, 2e-3, start);
  }
}

/// The largest speed of the first joint along the optimum without bounds.
double largest_speed(const Problem& base, const Motion& start) {
  return tests::solve(base, Scheme{"dmoc"}, Grid::uniform(24), start).trajectory.stage_v.col(0).cwiseAbs().maxCoeff();
}

// Rows of DMOC, unknowns of tangent-space collocation.
TEST(Sensitivities, WhereVelocitiesAreOnTheirBoundsMoveWithThem) {
  const TwoLinkManipulator base;
  const Motion& start = tests::common_start(base);
  const double largest = largest_speed(base, start);
  for (const char* method : {"dmoc", "tangent"}) {
    SCOPED_TRACE(method);
    const Family family = [&](double share) {
      const tests::Restated problem(base, [&](tests::Restated::Statement& statement) {
        statement.v = Bounds{Eigen::Vector2d(-share * largest, -tests::infinity),
                             Eigen::Vector2d(share * largest, tests::infinity)};
      });
      return tests::transcribe(problem, Scheme{method}, Grid::uniform(24));
    };
    expect_derivatives(family, 0.9, 2e-3, start);
  }
}

TEST(Sensitivities, WherePathConstraintsAreActiveMoveWithThem) {
  const TwoLinkManipulator base;
  const Motion& start = tests::common_start(base);
  const double largest = largest_speed(base, start);
  for (const char* method : {"dmoc", "hamiltonian"}) {
    SCOPED_TRACE(method);
    const Family family = [&](double share) {
      const tests::Restated problem(base, [&](tests::Restated::Statement& statement) {
        statement.path_constraints = [=](const ControlledState& x) {
          return ExpressionVector::Constant(1, share * share * largest * largest - x.v[0] * x.v[0]);
        };
      });
      return tests::transcribe(problem, Scheme{method}, Grid::uniform(24));
    };
    expect_derivatives(family, 0.9, 2e-3, start);
  }
}

TEST(Sensitivities, OfTheDoubleIntegratorAreThoseOfItsClosedForm) {
  // From rest at 0 to rest at a: J = 6 a², q = a (3t² - 2t³).
  const tests::DoubleIntegrator base;
  const Family family = [&](double a) {
    const tests::WithEnds problem(base, base.initial_state(), BoundaryState::at_rest(Eigen::VectorXd::Constant(1, a)));
    return tests::transcribe(problem, Scheme{"dmoc", 2}, Grid::uniform(8));
  };
  const auto program = family(1.0);
  const Solution solution = answer(*program, sample(*program, guessed_motion(base)));
  const auto values_at = [&](double a) { return values_of(*family(a), solution.primal, solution.multipliers); };
  const Sensitivity found = Sensitivities(*program, solution.primal, solution.multipliers)
                                .along(rate_of_change(values_at(0.5), values_at(1.5), 1.0));
  EXPECT_NEAR(found.objective / program->cost_scale(), 12.0, 1e-8);
  for (Eigen::Index k = 0; k <= 8; ++k) {
    const double t = static_cast<double>(k) / 8.0;
    EXPECT_NEAR(found.primal[k], 3.0 * t * t - 2.0 * t * t * t, 1e-9);
  }
}

TEST(Sensitivities, RefuseAPointOfAnotherProgram) {
  const tests::DoubleIntegrator problem;
  const auto program = tests::transcribe(problem, Scheme{"dmoc"}, Grid::uniform(8));
  EXPECT_THROW(Sensitivities(*program, Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(2)), Error);
}

}  // namespace
}  // namespace dmocbench
