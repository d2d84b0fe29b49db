// First-order states, unknown parameters and integrals against the coordinates that would have to stand for them: the
// same costs, and never more unknowns.
#include <cmath>
#include <memory>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "problems/registry.hpp"
#include "tests/support/solving.hpp"
#include "tests/support/substituted_problems.hpp"

namespace dmocbench {
namespace {

using tests::Scheme;

struct StatedPair {
  std::string name;
  std::shared_ptr<const Problem> stated;
  std::shared_ptr<const Problem> substituted;
  double unit;      ///< of the substituted cost
  double accuracy;  ///< relative, of the cost with two stages on 48 intervals; kinks of the control limit it
  bool saves_dmoc;  ///< DMOC has fewer unknowns too
};

std::ostream& operator<<(std::ostream& stream, const StatedPair& pair) { return stream << pair.name; }

std::vector<StatedPair> stated_pairs() {
  using namespace tests;  // NOLINT(google-build-using-namespace): in this function
  return {
      {"control_rate", make_problem("control_rate"), std::make_shared<SubstitutedControlRate>(), 1.0, 1e-5, false},
      {"hanging_chain", make_problem("hanging_chain"), std::make_shared<SubstitutedHangingChain>(), 1.0, 1e-5, true},
      {"cannonball", make_problem("cannonball"), std::make_shared<SubstitutedCannonball>(), 1000.0, 1e-7, true},
      {"ducted_fan", std::make_shared<DuctedFan>(false), std::make_shared<DuctedFan>(true), 1.0, 1e-5, false}};
}

class SubstitutedStatements : public testing::TestWithParam<std::tuple<StatedPair, std::string>> {};

TEST_P(SubstitutedStatements, HaveTheSameCostAndNeverFewerUnknowns) {
  const auto& [pair, method] = GetParam();
  const Scheme scheme{method, 2};
  const auto cost_of = [&](const Problem& problem) {
    const auto program = tests::transcribe(problem, scheme, Grid::uniform(48));
    const Solution solution = make_solver("ipopt")->solve(*program, sample(*program, guessed_motion(problem)));
    // The cost of a rate of a force, and of the bend of a chain, hardly determines them.
    EXPECT_LT(solution.kkt_residual.value_or(1.0), 1e-7) << solution.message;
    EXPECT_LT(solution.constraint_violation.value_or(1.0), 1e-8) << solution.message;
    return solution.objective / program->cost_scale();
  };
  const double cost = cost_of(*pair.stated);
  EXPECT_NEAR(pair.unit * cost_of(*pair.substituted), cost, pair.accuracy * std::abs(cost));
  const auto per_interval = [&](const Problem& problem) {
    const auto unknowns = [&](Eigen::Index intervals) {
      return static_cast<long>(tests::transcribe(problem, scheme, Grid::uniform(intervals))->variable_count());
    };
    return unknowns(9) - unknowns(8);
  };
  const long saved = per_interval(*pair.substituted) - per_interval(*pair.stated);
  if (method != "dmoc" || pair.saves_dmoc) {
    EXPECT_GT(saved, 0);
  } else {
    EXPECT_EQ(saved, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SubstitutedStatements,
                         testing::Combine(testing::ValuesIn(stated_pairs()),
                                          testing::Values("dmoc", "hamiltonian", "tangent")),
                         [](const auto& instance) {
                           return std::get<0>(instance.param).name + "_" + std::get<1>(instance.param);
                         });

}  // namespace
}  // namespace dmocbench
