#include "methods/solvers/solver.hpp"

#include <limits>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "methods/judgement/confirm.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/small_programs.hpp"
#include "tests/support/value_of.hpp"

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

/// A program whose residuals below a thousandth are rounding.
class CoarseProgram final : public tests::SmallProgram {
 public:
  using SmallProgram::SmallProgram;
  [[nodiscard]] const RoundingFloors& rounding_floors() const override { return floors_; }

 private:
  RoundingFloors floors_{.smallest = 1e-3, .largest = 1e-3};
};

TEST(Solvers, StopWhereRoundingBegins) {
  const NamedOptions sparse{{"factorisation", "sparse"}};  // these programs have no intervals
  const std::map<std::string, NamedOptions> solvers{{"ipopt", {}}, {"interior_point", sparse}, {"sqp", {}}};
  for (const auto& [name, named] : solvers) {
    const auto solver = make_solver(name, {}, named);
    int iterations_saved = 0;
    for (const tests::KnownProgram& known : tests::hock_schittkowski()) {
      SCOPED_TRACE(name + ", HS " + std::to_string(known.number));
      tests::SmallProgram exact(known.statement);
      CoarseProgram coarse(known.statement);
      const Solution fine = solver->solve(exact, known.start);
      const Solution rough = solver->solve(coarse, known.start);
      ASSERT_EQ(rough.status, Status::solved) << rough.message;
      EXPECT_LE(scaled_residual(coarse, solver->options().tolerance, rough), 1.0);
      EXPECT_LE(tests::value_of(rough.major_iterations), tests::value_of(fine.major_iterations));
      iterations_saved += tests::value_of(fine.major_iterations) - tests::value_of(rough.major_iterations);
    }
    EXPECT_GT(iterations_saved, 0) << name;
  }
}

TEST(Solvers, TakeTypedOptions) {
  const tests::KnownProgram known = tests::hock_schittkowski().back();
  tests::SmallProgram program(known.statement);
  const InteriorPointSolver typed({}, {.factorisation = InteriorPointOptions::Factorisation::sparse});
  const Solution answer = typed.solve(program, known.start);
  EXPECT_EQ(answer.status, Status::solved);
  EXPECT_EQ(make_solver("interior_point", {}, {{"factorisation", "sparse"}})->solve(program, known.start).primal,
            answer.primal);
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
