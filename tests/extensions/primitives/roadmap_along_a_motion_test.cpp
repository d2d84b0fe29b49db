// Lattices of states whose sizes come from a first motion.

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "bench/extensions/primitives/planned_motion.hpp"
#include "problems/registry.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

/// One configuration and several, with bounds and without.
TEST(RoadmapAlongAMotion, LeadsToTheCertifiedOptimumOfProblemsWithOneMinimum) {
  for (const std::string name : {"double_integrator", "forced_oscillator", "hypersensitive", "beam"}) {
    const std::shared_ptr<const Problem> problem = make_problem(name);
    const RoadmapSystem& system = roadmap_system(name);
    const PlannedMotion planned = plan_and_refine(
        problem, system, {.stored = system.build(*problem, {}), .seconds = 0.0, .is_read = false}, {.repeats = 1}, {});
    ASSERT_TRUE(planned.before) << name << ": " << planned.status;
    ASSERT_TRUE(planned.after) << name << ": " << planned.status;
    const double optimum = problem->card().reference->objective;
    EXPECT_GT(planned.before->cost, optimum) << name;
    EXPECT_NEAR(planned.after->cost / optimum, 1.0, 1e-2) << name;
  }
}

TEST(RoadmapAlongAMotion, NeedsFixedEndsAndHorizon) {
  const auto problem = make_problem("brachistochrone");
  tests::expect_error_naming({"brachistochrone", "horizon"},
                             [&] { static_cast<void>(roadmap_along_a_motion(*problem, {})); });
}

}  // namespace
}  // namespace dmocbench
