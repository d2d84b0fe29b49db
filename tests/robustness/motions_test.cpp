// Problems as users bring them, unlike those of the library: each row of every family, solver and grid is a motion to
// the accuracy that is stated, or says that it is none. Minima are those that all families share on finer grids (three
// Gauss stages on 96 to 320 intervals), to the digits given, unless a closed form is.
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/robustness/body_by_angles.hpp"
#include "tests/robustness/cartesian_pendulum.hpp"
#include "tests/robustness/chain_on_cart.hpp"
#include "tests/robustness/damped_pendubot.hpp"
#include "tests/robustness/earth_moon_transfer.hpp"
#include "tests/robustness/furuta_pendulum.hpp"
#include "tests/robustness/hopper_over_obstacle.hpp"
#include "tests/robustness/rigid_body_slew.hpp"
#include "tests/robustness/rows.hpp"

namespace dmocbench::tests {
namespace {

/// Every family by both solvers at 1e-2 and 2e-5, although the replay of the whole horizon is of no use.
TEST(Robustness, AnUnstableChainIsShifted) {
  const ChainOnCart problem = ChainOnCart::shifted(3);
  const std::vector<double> minima = {18.016793};
  expect_rows(problem, minima, {.stages = 1, .intervals = 40, .accuracy = 0.01, .least_at_minimum = 6});
  expect_rows(problem, minima, {.stages = 3, .intervals = 40, .accuracy = 2e-5, .least_at_minimum = 6});
}

/// On 40 intervals by one stage all are solved, from 497 on, and none is near a minimum: four of six are told apart,
/// two are a motion near 963.
TEST(Robustness, AnUnstableChainIsSwungUp) {
  const ChainOnCart problem = ChainOnCart::swung_up(3);
  const std::vector<double> minima = {687.0596, 907.4157};
  expect_rows(problem, minima, {.stages = 1, .intervals = 40, .accuracy = 0.1, .least_at_minimum = 2});
  expect_rows(problem, minima, {.stages = 3, .intervals = 60, .accuracy = 2e-4, .least_at_minimum = 6});
}

/// Six of six by three stages, although none of them starts from a motion; by one stage four of six are motions, 8 and
/// 9 % off, two are torn beyond the limit.
TEST(Robustness, AFurutaPendulumIsSwungUpByLittleTorque) {
  const FurutaPendulum problem(0.15, {0.3, 3.0});
  const std::vector<double> minima = {2.827078};
  expect_rows(problem, minima, {.stages = 1, .intervals = 40, .accuracy = 0.1, .least_at_minimum = 4});
  expect_rows(problem, minima, {.stages = 3, .intervals = 64, .accuracy = 1e-3, .least_at_minimum = 6});
}

/// The cost is near 1e-3 and nothing scales it.
TEST(Robustness, AHopperClearsAnObstacle) {
  const HopperOverObstacle problem(0.15);
  const std::vector<double> minima = {0.001049602325};
  expect_rows(problem, minima, {.stages = 1, .intervals = 32, .accuracy = 0.005, .least_at_minimum = 6});
  expect_rows(problem, minima, {.stages = 3, .intervals = 32, .accuracy = 1e-8, .least_at_minimum = 6});
}

/// Twelve intervals of one stage are solved at twelve times the cost, torn by half the range of the velocity.
TEST(Robustness, ASpacecraftGoesFromTheEarthToTheMoon) {
  const EarthMoonTransfer problem;
  const std::vector<double> minima = {0.1489327226};
  expect_rows(problem, minima, {.stages = 1, .intervals = 12, .accuracy = 0.01, .least_at_minimum = 0});
  expect_rows(problem, minima, {.stages = 3, .intervals = 60, .accuracy = 1e-7, .least_at_minimum = 6});
}

/// Twenty intervals of one stage are solved at 49 to 77, cheaper than any motion.
TEST(Robustness, ADampedPendubotIsSwungUp) {
  const DampedPendubot problem;
  const std::vector<double> minima = {84.630227, 92.565804};
  expect_rows(problem, minima, {.stages = 1, .intervals = 20, .accuracy = 0.01, .least_at_minimum = 0});
  expect_rows(problem, minima, {.stages = 3, .intervals = 60, .accuracy = 1e-4, .least_at_minimum = 6});
}

TEST(Robustness, ABodyIsTurnedByQuaternions) {
  const std::vector<double> half_turn = {6.0 * std::numbers::pi * std::numbers::pi};
  expect_rows(RigidBodySlew::roll(), half_turn,
              {.stages = 1, .intervals = 20, .accuracy = 0.01, .least_at_minimum = 6});
  expect_rows(RigidBodySlew::roll(), half_turn,
              {.stages = 3, .intervals = 20, .accuracy = 1e-8, .least_at_minimum = 6});
  const std::vector<double> slanted = {104.0866335};
  expect_rows(RigidBodySlew::slanted(), slanted,
              {.stages = 1, .intervals = 20, .accuracy = 0.01, .least_at_minimum = 6});
  expect_rows(RigidBodySlew::slanted(), slanted,
              {.stages = 3, .intervals = 20, .accuracy = 1e-8, .least_at_minimum = 6});
}

/// The costs are those of the same turns by quaternions.
TEST(Robustness, ABodyIsTurnedByAngles) {
  const std::vector<double> half_turn = {6.0 * std::numbers::pi * std::numbers::pi};
  expect_rows(BodyByAngles::roll(), half_turn, {.stages = 1, .intervals = 20, .accuracy = 0.01, .least_at_minimum = 6});
  expect_rows(BodyByAngles::roll(), half_turn, {.stages = 3, .intervals = 20, .accuracy = 1e-8, .least_at_minimum = 6});
  const std::vector<double> slanted = {104.0866335};
  expect_rows(BodyByAngles::slanted(), slanted,
              {.stages = 1, .intervals = 20, .accuracy = 0.01, .least_at_minimum = 6});
  expect_rows(BodyByAngles::slanted(), slanted,
              {.stages = 3, .intervals = 20, .accuracy = 1e-8, .least_at_minimum = 6});
}

/// The best way leads across the singularity of the angles, where nothing can be replayed: every row, though solved at
/// the right cost, says that it is no motion.
TEST(Robustness, ABodyIsPitchedAcrossTheSingularityOfItsAngles) {
  const std::vector<double> half_turn = {24.0 * std::numbers::pi * std::numbers::pi};
  expect_rows(BodyByAngles::pitch(), half_turn,
              {.stages = 1, .intervals = 21, .accuracy = 0.01, .least_at_minimum = 0});
  expect_rows(BodyByAngles::pitch(), half_turn,
              {.stages = 3, .intervals = 21, .accuracy = 1e-7, .least_at_minimum = 0});
}

/// On 20 intervals by one stage the rod's length drifts: only DMOC's rows are motions.
TEST(Robustness, APendulumIsSwungUpInCartesianCoordinates) {
  const CartesianPendulum problem;
  const std::vector<double> minima = {65.47690383};
  expect_rows(problem, minima, {.stages = 1, .intervals = 20, .accuracy = 0.02, .least_at_minimum = 2});
  expect_rows(problem, minima, {.stages = 3, .intervals = 20, .accuracy = 2e-6, .least_at_minimum = 6});
}

/// The rod's force as a control and its length as h >= 0 and -h >= 0: the gradients of the two are dependent, so
/// `interior_point` solves no row and Ipopt ends at another minimum.
TEST(Robustness, APendulumOnTwoInequalitiesIsAMotionWhereItIsSolved) {
  const PendulumOnInequalities problem;
  const std::vector<double> minima = {65.47690, 68.13060};
  expect_rows(problem, minima, {.stages = 1, .intervals = 40, .accuracy = 0.01, .least_at_minimum = 2});
  expect_rows(problem, minima, {.stages = 3, .intervals = 30, .accuracy = 1e-4, .least_at_minimum = 2});
}

/// A foot that has to be higher than the leg is long: bounds hold at nodes and rows at stages, so programs are solved.
TEST(Robustness, AHopperNeverClearsATower) {
  const HopperOverObstacle problem(2.0);
  expect_no_motion(problem, {.stages = 1, .intervals = 20});
  expect_no_motion(problem, {.stages = 3, .intervals = 20});
}

TEST(Robustness, ATorqueBelowTheLeastNeverTurnsTheBody) {
  expect_no_motion(RigidBodySlew::roll_too_weak(), {.stages = 1, .intervals = 20});
  expect_no_motion(RigidBodySlew::roll_too_weak(), {.stages = 3, .intervals = 20});
}

TEST(Robustness, AFurutaPendulumNeverSwingsUpInNoTime) {
  const FurutaPendulum problem(0.15, {0.1, 0.2});
  expect_no_motion(problem, {.stages = 1, .intervals = 20});
  expect_no_motion(problem, {.stages = 3, .intervals = 20});
}

}  // namespace
}  // namespace dmocbench::tests
