#include "methods/runtime/lane_loops.hpp"

#include <limits>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "tests/support/random_points.hpp"

namespace dmocbench::lane_loops_test {
namespace {

constexpr auto lanes = static_cast<Eigen::Index>(instance_lanes);
constexpr Eigen::Index entries = 13;
constexpr double rounding = 1e-14;

using Interleaved = Eigen::Matrix<double, lanes, Eigen::Dynamic>;  // a row per lane
using OfLanes = Eigen::Array<double, lanes, 1>;

Interleaved random_lanes(tests::RandomPoints& random) {
  return random.vector(lanes * entries).reshaped(lanes, entries);
}

double largest(const OfLanes& numbers) { return numbers.abs().maxCoeff(); }

TEST(LaneLoops, AreThoseOfTheDefinitionsLaneByLaneOnEveryInstructionSet) {
  tests::RandomPoints random;
  for (const InstructionSet set : available_instruction_sets()) {
    const LaneLoops& loops = lane_loops_of(set);
    const Interleaved x = random_lanes(random);
    const Interleaved y = random_lanes(random);
    OfLanes result;
    OfLanes second;
    loops.sum(x.data(), entries, result.data());
    EXPECT_LE(largest(result - x.rowwise().sum().array()), rounding);
    loops.magnitudes(x.data(), entries, result.data(), second.data());
    EXPECT_LE(largest(result - x.cwiseAbs().rowwise().sum().array()), rounding);
    EXPECT_TRUE((second == x.cwiseAbs().rowwise().maxCoeff().array()).all());
    loops.largest(x.data(), entries, result.data());
    EXPECT_TRUE((result == second).all());
    loops.dot(x.data(), y.data(), entries, result.data());
    EXPECT_LE(largest(result - x.cwiseProduct(y).rowwise().sum().array()), rounding);
    loops.sum_of_reciprocals(x.data(), y.data(), 0.5, entries, result.data());
    EXPECT_LE(largest(result - ((x + y).array().abs() + 0.5).inverse().rowwise().sum()), entries * rounding);
    Interleaved rest = x;
    loops.subtract(rest.data(), y.data(), entries, result.data(), second.data());
    EXPECT_EQ(rest, x - y);
    EXPECT_LE(largest(result - (x - y).cwiseAbs().rowwise().sum().array()), rounding);
    EXPECT_TRUE((second == (x - y).cwiseAbs().rowwise().maxCoeff().array()).all());
  }
}

TEST(LaneLoops, LeaveALaneWhoseFactorIsZeroAsItIsWhateverTheStepIs) {
  tests::RandomPoints random;
  for (const InstructionSet set : available_instruction_sets()) {
    const Interleaved x = random_lanes(random);
    Interleaved step = random_lanes(random);
    step.row(2).setConstant(std::numeric_limits<double>::quiet_NaN());
    OfLanes factor = random.vector(lanes).array();
    factor[2] = 0.0;
    Interleaved moved;
    moved.resize(lanes, entries);
    lane_loops_of(set).set_to_sum(moved.data(), x.data(), factor.data(), step.data(), entries);
    EXPECT_EQ(moved.row(2), x.row(2));
    for (Eigen::Index lane = 3; lane < lanes; ++lane) {
      EXPECT_LE((moved.row(lane) - x.row(lane) - factor[lane] * step.row(lane)).lpNorm<Eigen::Infinity>(), rounding);
    }
  }
}

TEST(LaneLoops, LetANumberThatIsNotFiniteBeSeenInItsLaneOnly) {
  tests::RandomPoints random;
  for (const InstructionSet set : available_instruction_sets()) {
    Interleaved x = random_lanes(random);
    x(5, 7) = std::numeric_limits<double>::quiet_NaN();
    OfLanes sum;
    OfLanes most;
    lane_loops_of(set).magnitudes(x.data(), entries, sum.data(), most.data());
    for (Eigen::Index lane = 0; lane < lanes; ++lane) EXPECT_EQ(std::isfinite(sum[lane]), lane != 5);
  }
}

}  // namespace
}  // namespace dmocbench::lane_loops_test
