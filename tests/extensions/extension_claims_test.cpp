// Claims of extensions: each false number flips the row it should, and a build without extensions withholds all of
// them.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/extensions/claims_of_extensions.hpp"
#include "bench/programs.hpp"
#include "tests/bench/false_number.hpp"

namespace dmocbench {
namespace {

using tests::has;

std::vector<std::string> ids_of(const std::vector<JudgedClaim>& claims) {
  std::vector<std::string> ids;
  for (const JudgedClaim& claim : claims) ids.push_back(claim.id());
  return ids;
}

/// The claims that the extensions add, once in this program.
const std::vector<std::string>& added_ids() {
  static const std::vector<std::string> added = [] {
    const std::vector<std::string> before = ids_of(judge_claims({}));
    register_extensions();
    std::vector<std::string> ids = ids_of(judge_claims({}));
    std::erase_if(ids, [&](const std::string& id) { return std::ranges::find(before, id) != before.end(); });
    return ids;
  }();
  return added;
}

TEST(ExtensionClaims, AreTheOnesThatABuildWithoutExtensionsWithholds) {
  std::vector<std::string> withheld;
  for (const auto& [problem, name] : claims_of_extensions) withheld.push_back(fmt::format("{}/{}", problem, name));
  EXPECT_EQ(added_ids(), withheld);
}

TEST(ExtensionClaims, DifferByOneFalseNumberOfTheirTables) {
  ASSERT_FALSE(added_ids().empty());
  const std::string on_orbit = "orbital_transfer/";
  tests::expect_to_differ({
      {"low_thrust", has("method", "multiple_shooting_midpoint_1"), "state_error", 0.9e-4,
       on_orbit + "low_thrust_structure_pays_beside_explicit"},
      {"low_thrust", has("method", "multiple_shooting_rk4_1"), "cost_error", 2e-4,
       on_orbit + "low_thrust_order_pays_more"},
      {"step_control_symplecticity", has("rule", "variational"), "defect", 1e-3,
       "simulations/variational_steps_symplectic"},
      {"step_control_symplecticity", has("rule", "imposed"), "defect", 1e-15,
       "simulations/variational_steps_symplectic"},
      {"step_control_momentum", has("rule", "imposed"), "defect", 1e-6,
       "simulations/steps_by_the_motion_keep_momentum"},
      {"step_control_momentum", has("rule", "imposed"), "work", 0.0, "simulations/steps_by_the_motion_keep_momentum"},
      {"step_control_energy_behaviour", has("rule", "variational"), "range", 0.1,
       "simulations/variational_steps_energy"},
      {"step_control_energy_behaviour", has("rule", "from_left"), "change", 1e-6,
       "simulations/variational_steps_energy"},
      {"step_control", has("rule", "imposed"), "state_error", 0.9e-3, "simulations/variational_steps_accuracy"},
      {"step_control_transfer", has("rule", "imposed"), "cost_error", 0.9e-3, "simulations/variational_steps_accuracy"},
  });
}

}  // namespace
}  // namespace dmocbench
