#include "methods/program/counted_program.hpp"

#include <gtest/gtest.h>

#include "methods/transcription/start.hpp"
#include "methods/transcription/transcription.hpp"
#include "tests/support/restated_problems.hpp"

namespace dmocbench {
namespace {

TEST(CountedProgram, ForwardsEverythingAndCountsEachEvaluationOnItsOwn) {
  const tests::Pendulum pendulum;
  Transcription program(pendulum, *make_element("dmoc"), make_tableau("gauss", 1), Grid::uniform(4));
  CountedProgram counted(program);
  EXPECT_EQ(&counted.uncounted(), &program);
  EXPECT_EQ(counted.variable_count(), program.variable_count());
  EXPECT_EQ(counted.constraint_count(), program.constraint_count());
  EXPECT_EQ(&counted.variable_lower(), &program.variable_lower());
  EXPECT_EQ(&counted.variable_upper(), &program.variable_upper());
  EXPECT_EQ(&counted.constraint_lower(), &program.constraint_lower());
  EXPECT_EQ(&counted.constraint_upper(), &program.constraint_upper());
  EXPECT_EQ(&counted.jacobian_structure(), &program.jacobian_structure());
  EXPECT_EQ(&counted.hessian_structure(), &program.hessian_structure());
  EXPECT_EQ(counted.interval_structure(), program.interval_structure());
  EXPECT_NE(counted.interval_structure(), nullptr);
  EXPECT_EQ(&counted.rounding_floors(), &program.rounding_floors());

  const Eigen::VectorXd x = sample(program, guessed_motion(pendulum));
  const Eigen::VectorXd multipliers = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(program.constraint_count()));
  const auto expect_same = [&](std::size_t size, const auto& evaluate) {
    Eigen::VectorXd of_counted(static_cast<Eigen::Index>(size));
    Eigen::VectorXd of_program(static_cast<Eigen::Index>(size));
    evaluate(static_cast<NonlinearProgram&>(counted), of_counted);
    evaluate(static_cast<NonlinearProgram&>(program), of_program);
    EXPECT_EQ(of_counted, of_program);
  };
  EXPECT_EQ(counted.objective(x), program.objective(x));
  for (int i = 0; i < 2; ++i) {
    expect_same(program.variable_count(), [&](NonlinearProgram& of, Eigen::VectorXd& to) { of.gradient(x, to); });
  }
  for (int i = 0; i < 3; ++i) {
    expect_same(program.constraint_count(), [&](NonlinearProgram& of, Eigen::VectorXd& to) { of.constraints(x, to); });
  }
  for (int i = 0; i < 4; ++i) {
    expect_same(program.jacobian_structure().size(),
                [&](NonlinearProgram& of, Eigen::VectorXd& to) { of.jacobian(x, to); });
  }
  for (int i = 0; i < 5; ++i) {
    expect_same(program.hessian_structure().size(),
                [&](NonlinearProgram& of, Eigen::VectorXd& to) { of.hessian(x, 0.5, multipliers, to); });
  }
  EXPECT_EQ(counted.counts().objective, 1);
  EXPECT_EQ(counted.counts().gradient, 2);
  EXPECT_EQ(counted.counts().constraints, 3);
  EXPECT_EQ(counted.counts().jacobian, 4);
  EXPECT_EQ(counted.counts().hessian, 5);
  EXPECT_EQ(counted.counts().total(), 15);
  EXPECT_GT(counted.evaluation_seconds(), 0.0);
  EXPECT_GT(counted.elapsed_seconds(), counted.evaluation_seconds());
}

}  // namespace
}  // namespace dmocbench
