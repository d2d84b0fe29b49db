#include "methods/transcription/lane_transcription.hpp"

#include <string>

#include <gtest/gtest.h>

#include "methods/error.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench::lane_transcription_test {
namespace {

constexpr auto lanes = static_cast<Eigen::Index>(instance_lanes);
using Interleaved = Eigen::Matrix<double, lanes, Eigen::Dynamic>;  // a row per lane

Transcription transcribed(const Problem& problem, const std::string& method, int stages,
                          const Grid& grid = Grid::uniform(5)) {
  return {problem, *make_element(method), make_tableau("gauss", stages), grid};
}

Interleaved interleaved(std::size_t size) { return Interleaved::Zero(lanes, static_cast<Eigen::Index>(size)); }

/// Every array of every lane, to the last digit.
void expect_single_values(Transcription& program, unsigned seed) {
  tests::RandomPoints random(seed);
  LaneTranscription side_by_side(program);
  Interleaved x = interleaved(program.variable_count());
  Interleaved multipliers = interleaved(program.constraint_count());
  for (double& entry : x.reshaped()) entry = random.number(0.5, 1.5);
  for (double& entry : multipliers.reshaped()) entry = random.number();
  Eigen::Array<double, lanes, 1> objective;
  Interleaved gradient = interleaved(program.variable_count());
  Interleaved rows = interleaved(program.constraint_count());
  Interleaved jacobian = interleaved(program.jacobian_structure().size());
  Interleaved hessian = interleaved(program.hessian_structure().size());
  side_by_side.objective(x.data(), objective.data());
  side_by_side.gradient(x.data(), gradient.data());
  side_by_side.constraints(x.data(), rows.data());
  side_by_side.jacobian(x.data(), jacobian.data());
  side_by_side.hessian(x.data(), multipliers.data(), hessian.data());
  for (Eigen::Index lane = 0; lane < lanes; ++lane) {
    const Eigen::VectorXd point = x.row(lane);
    const Eigen::VectorXd of_rows = multipliers.row(lane);
    Eigen::VectorXd values(gradient.cols());
    program.gradient(point, values);
    EXPECT_EQ(Eigen::VectorXd(gradient.row(lane)), values);
    values.resize(rows.cols());
    program.constraints(point, values);
    EXPECT_EQ(Eigen::VectorXd(rows.row(lane)), values);
    values.resize(jacobian.cols());
    program.jacobian(point, values);
    EXPECT_EQ(Eigen::VectorXd(jacobian.row(lane)), values);
    values.resize(hessian.cols());
    program.hessian(point, 1.0, of_rows, values);
    EXPECT_EQ(Eigen::VectorXd(hessian.row(lane)), values);
    const double single = program.objective(point);
    EXPECT_NEAR(objective[lane], single, 1e-14 * std::abs(single));
  }
}

TEST(LaneTranscription, HasInEveryLaneTheValuesAndDerivativesOfTheProgram) {
  for (const char* name : {"orbital_transfer", "two_link_manipulator", "cart_pole"}) {
    const auto problem = make_problem(name);
    for (const std::string& method : paper_families()) {
      for (const int stages : {1, 2}) {
        SCOPED_TRACE(std::string(name) + ' ' + method + ' ' + std::to_string(stages));
        Transcription program = transcribed(*problem, method, stages);
        expect_single_values(program, static_cast<unsigned>(stages));
      }
    }
  }
}

TEST(LaneTranscription, RefusesAFreeHorizon) {
  const auto problem = make_problem("brachistochrone");
  const Transcription program = transcribed(*problem, "dmoc", 1);
  ASSERT_TRUE(program.has_free_horizon());
  EXPECT_THROW(LaneTranscription{program}, Error);
}

TEST(ClampedEnds, WritesTheEndsAsTheProgramOfTheProblemItselfHasThem) {
  for (const char* name : {"orbital_transfer", "two_link_manipulator"}) {
    const auto problem = make_problem(name);
    for (const std::string& method : paper_families()) {
      SCOPED_TRACE(std::string(name) + ' ' + method);
      Transcription program = transcribed(*problem, method, 1);
      ClampedEnds ends(program);
      const Eigen::VectorXd start = sample(program, guessed_motion(*problem));
      Eigen::VectorXd x = start;
      Eigen::VectorXd rows = Eigen::VectorXd::Zero(program.constraint_lower().size());
      ends.write(problem->initial_state(), problem->final_state(), x, rows);
      EXPECT_LE((x - start).lpNorm<Eigen::Infinity>(), 1e-14);
      EXPECT_LE((rows - program.constraint_lower()).lpNorm<Eigen::Infinity>(), 1e-14);
    }
  }
}

}  // namespace
}  // namespace dmocbench::lane_transcription_test
