#include "methods/solvers/solver.hpp"

#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

TEST(Solvers, AreMadeByNameAndUnknownNamesListThem) {
  const std::vector<std::string> names = solver_names();
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(names.front(), "ipopt");
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const std::string& name : names) {
    EXPECT_EQ(make_solver(name)->name(), name);
    EXPECT_FALSE(make_solver(name)->description().empty());
    tests::expect_error_naming({"simplex", name}, [] { static_cast<void>(make_solver("simplex")); });
  }
}

TEST(SolverOptions, AreValidByDefault) { EXPECT_NO_THROW(SolverOptions().validate()); }

TEST(SolverOptions, RefuseTolerancesThatAreNotBetweenZeroAndOne) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double tolerance : {0.0, -1e-8, 1.0, 10.0, nan}) {
    SolverOptions options;
    options.tolerance = tolerance;
    tests::expect_error_naming({"tolerance"}, [&] { options.validate(); });
    tests::expect_error_naming({"tolerance"}, [&] { static_cast<void>(make_solver("ipopt", options)); });
  }
}

TEST(SolverOptions, RefuseIterationAndTimeLimitsThatMakeNoSense) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  SolverOptions options;
  options.most_iterations = 0;
  tests::expect_error_naming({"iterations", "0"}, [&] { options.validate(); });
  for (const double seconds : {-1.0, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    SolverOptions timed;
    timed.most_seconds = seconds;
    tests::expect_error_naming({"time limit"}, [&] { timed.validate(); });
  }
}

}  // namespace
}  // namespace dmocbench
