// Boundary conditions that repeat each other change no solution, and contradictions have none.
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "methods/solvers/solver.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using Conditions = std::function<ExpressionVector(const State& last)>;

ExpressionVector entries(const std::vector<Expression>& values) {
  ExpressionVector result(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) result[static_cast<Eigen::Index>(i)] = values[i];
  return result;
}

/// The pendulum to q = 2.5, with a free or a given velocity there.
tests::Restated pendulum(const Problem& base, const Conditions& conditions) {
  return tests::Restated(base, [&](tests::Restated::Statement& s) {
    s.last = tests::free_end(1);
    s.conditions = [conditions](const State&, const State& last) { return conditions(last); };
  });
}

class DependentConditions : public testing::TestWithParam<std::tuple<const char*, const char*, int>> {
 protected:
  [[nodiscard]] Solution solve(const Conditions& conditions, const std::string& solver) const {
    const auto& [method, any, stages] = GetParam();
    const tests::Restated problem = pendulum(base_, conditions);
    const auto program = tests::transcribe(problem, {method, stages}, Grid::uniform(8));
    return make_solver(solver)->solve(*program, sample(*program, guessed_motion(problem)));
  }

 private:
  tests::Pendulum base_;
};

INSTANTIATE_TEST_SUITE_P(All, DependentConditions,
                         testing::Combine(testing::Values("dmoc", "hamiltonian", "tangent"),
                                          testing::Values("auto", "interior_point", "ipopt", "sqp"),
                                          testing::Values(1, 2)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param)) + "_" + std::get<1>(test.param) + "_" +
                                  std::to_string(std::get<2>(test.param));
                         });

TEST_P(DependentConditions, ChangeNoSolution) {
  const std::string solver = std::get<1>(GetParam());
  const auto at_end = [](const State& last) { return last.q[0] - 2.5; };
  const auto speed = [](const State& last) { return last.v[0] - 0.1; };
  const Conditions one = [&](const State& last) { return entries({at_end(last)}); };
  const Conditions two = [&](const State& last) { return entries({at_end(last), speed(last)}); };
  const std::vector<std::pair<Conditions, std::vector<Conditions>>> statements{
      {one,
       {[&](const State& x) {
          return entries({at_end(x), at_end(x)});
        },
        [&](const State& x) {
          return entries({at_end(x), at_end(x), at_end(x)});
        },
        [&](const State& x) {
          return entries({at_end(x), (1.0 + 1e-9) * at_end(x)});
        },
        [&](const State& x) {
          return entries({1e-6 * at_end(x), at_end(x)});
        },
        [&](const State& x) {
          return entries({at_end(x), 1e6 * at_end(x)});
        },
        [&](const State& x) {
          return entries({at_end(x), exp(at_end(x)) - 1.0});
        },
        [&](const State& x) {
          return entries({at_end(x), at_end(x) + at_end(x) * at_end(x)});
        }}},
      {two,
       {[&](const State& x) {
          return entries({at_end(x), speed(x), at_end(x) + speed(x)});
        },
        [&](const State& x) {
          return entries({at_end(x), speed(x), at_end(x) + 1e-4 * speed(x)});
        },
        [&](const State& x) {
          return entries({at_end(x), speed(x), speed(x), at_end(x)});
        },
        [&](const State& x) {
          return entries({at_end(x), speed(x), sin(speed(x)) - at_end(x)});
        }}}};
  for (const auto& [once, repeated] : statements) {
    const Solution right = solve(once, "ipopt");
    ASSERT_EQ(right.status, Status::solved) << right.message;
    for (std::size_t i = 0; i < repeated.size(); ++i) {
      SCOPED_TRACE(i);
      const Solution found = solve(repeated[i], solver);
      if (solver == "auto") {
        EXPECT_EQ(found.status, Status::solved) << found.message;
      }
      if (!is_solved(found.status)) continue;
      EXPECT_NEAR(found.objective, right.objective, 1e-8 * right.objective) << found.message;
      EXPECT_LT((found.primal - right.primal).lpNorm<Eigen::Infinity>(), 1e-5) << found.message;
    }
  }
}

TEST_P(DependentConditions, ThatContradictEachOtherAreNotSolved) {
  for (const double gap : {1e-6, 1e-3, 0.1}) {
    const Solution found = solve(
        [gap](const State& last) {
          return entries({last.q[0] - 2.5, last.q[0] - 2.5 - gap});
        },
        std::get<1>(GetParam()));
    EXPECT_FALSE(is_solved(found.status)) << gap << ": " << found.message;
  }
}

}  // namespace
}  // namespace dmocbench
