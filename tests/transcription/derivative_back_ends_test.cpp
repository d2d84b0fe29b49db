// Every back end against the symbolic derivatives: the same entries, each as exact as its method can be.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "methods/transcription/derivatives/back_ends.hpp"
#include "methods/transcription/derivatives/finite_differences.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/restated_problems.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::RandomPoints;
using tests::Scheme;

struct FilledDerivatives {
  Eigen::VectorXd gradient;
  Eigen::VectorXd jacobian;
  Eigen::VectorXd hessian;
};

/// Largest differences relative to the largest entry.
struct Differences {
  double gradient;
  double jacobian;
  double hessian;
};

double relative(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / b.lpNorm<Eigen::Infinity>();
}

Differences operator-(const FilledDerivatives& a, const FilledDerivatives& b) {
  return {relative(a.gradient, b.gradient), relative(a.jacobian, b.jacobian), relative(a.hessian, b.hessian)};
}

void expect_below(const Differences& found, double limit) {
  EXPECT_LT(found.gradient, limit);
  EXPECT_LT(found.jacobian, limit);
  EXPECT_LT(found.hessian, limit);
}

bool offers(const std::string& name) {
  const auto names = derivative_back_end_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The derivatives of one back end at a point near the guess, where both problems are regular; the arrays start as NaN,
/// so that an entry that is not written shows.
FilledDerivatives derivatives_by(const std::string& back_end, const Problem& problem, const Scheme& scheme,
                                 const Grid& grid, double distance = 0.2) {
  Transcription program(problem, *make_element(scheme.method), gauss_tableau(scheme.stages), grid, back_end);
  RandomPoints random;
  // By the tape for all, because a start of a mechanism is fitted by derivatives.
  Transcription by_tape(problem, *make_element(scheme.method), gauss_tableau(scheme.stages), grid);
  Eigen::VectorXd x = sample(by_tape, guessed_motion(problem));
  x += random.vector(x.size(), -distance, distance);
  const Eigen::VectorXd multipliers = random.vector(static_cast<Eigen::Index>(program.constraint_count()));
  const auto array = [](std::size_t size) {
    return Eigen::VectorXd::Constant(static_cast<Eigen::Index>(size), std::nan("")).eval();
  };
  FilledDerivatives result{array(program.variable_count()), array(program.jacobian_structure().size()),
                           array(program.hessian_structure().size())};
  // Twice: nothing may be left behind by an evaluation elsewhere.
  for (const Eigen::VectorXd& point : {(x.array() + 0.5 * distance).matrix().eval(), x}) {
    program.gradient(point, result.gradient);
    program.jacobian(point, result.jacobian);
    program.hessian(point, 0.7, multipliers, result.hessian);
  }
  return result;
}

class BackEnds : public testing::TestWithParam<std::tuple<std::string, std::string, int>> {
 protected:
  [[nodiscard]] FilledDerivatives by(const std::string& back_end) const {
    return derivatives_by(back_end, *problem_, scheme_, grid_);
  }
  [[nodiscard]] Differences from_exact(const std::string& back_end) const { return by(back_end) - by("tape"); }

  static std::shared_ptr<const Problem> problem_named(const std::string& name) {
    if (name == "moving_frame") return std::make_shared<tests::MovingFrame>();
    if (name != "everything") return make_problem(name);
    const auto everything = std::make_shared<tests::Everything>();
    return {everything, &everything->problem()};
  }

  std::shared_ptr<const Problem> problem_ = problem_named(std::get<0>(GetParam()));
  Scheme scheme_{std::get<1>(GetParam()), std::get<2>(GetParam())};
  Grid grid_ = tests::graded_grid(7);
};

TEST_P(BackEnds, AdolcAgreesToRoundingIntervalByIntervalAndAsAWhole) {
  if (!offers("adolc")) GTEST_SKIP() << "ADOL-C is not in this build";
  for (const char* const back_end : {"adolc", "adolc_whole"}) {
    SCOPED_TRACE(back_end);
    expect_below(from_exact(back_end), 1e-13);
  }
}

TEST_P(BackEnds, CentralDifferencesHaveTwoThirdsOfTheDigitsAndHalfOfThemInTheHessian) {
  const Differences found = from_exact("finite_differences");
  EXPECT_LT(found.gradient, 1e-8);
  EXPECT_LT(found.jacobian, 1e-8);
  EXPECT_LT(found.hessian, 1e-6);
}

TEST_P(BackEnds, ForwardDifferencesHaveHalfOfTheDigitsAndAThirdInTheHessianDenseOrNot) {
  for (const char* const back_end : {"forward_differences", "dense_differences"}) {
    SCOPED_TRACE(back_end);
    const Differences found = from_exact(back_end);
    EXPECT_LT(found.gradient, 1e-6);
    EXPECT_GT(found.jacobian, 1e-10);
    EXPECT_LT(found.jacobian, 1e-6);
    EXPECT_LT(found.hessian, 1e-3);
  }
}

TEST_P(BackEnds, ForwardDifferencesAreWorseThanCentralOnes) {
  const Differences central = from_exact("finite_differences");
  const Differences forward = from_exact("forward_differences");
  EXPECT_GT(forward.jacobian, 10.0 * central.jacobian);
  EXPECT_GT(forward.hessian, 10.0 * central.hessian);
}

INSTANTIATE_TEST_SUITE_P(All, BackEnds,
                         testing::Combine(testing::Values("orbital_transfer", "two_link_manipulator", "moving_frame",
                                                          "everything"),
                                          testing::ValuesIn(paper_families()), testing::Values(1, 2)),
                         [](const auto& instance) {
                           return std::get<0>(instance.param) + "_" + std::get<1>(instance.param) + "_" +
                                  std::to_string(std::get<2>(instance.param));
                         });

TEST(DifferenceStep, BalancesTruncationAndRounding) {
  // Truncation step^p against rounding ε / step^d: p + d is the root.
  const double epsilon = std::numeric_limits<double>::epsilon();
  EXPECT_NEAR(std::pow(difference_step(DifferenceKind::forward, 1), 2) / epsilon, 1.0, 1e-12);
  EXPECT_NEAR(std::pow(difference_step(DifferenceKind::central, 1), 3) / epsilon, 1.0, 1e-12);
  EXPECT_NEAR(std::pow(difference_step(DifferenceKind::forward, 2), 3) / epsilon, 1.0, 1e-12);
  EXPECT_NEAR(std::pow(difference_step(DifferenceKind::central, 2), 4) / epsilon, 1.0, 1e-12);
}

TEST(BackEndRegistry, BeginsWithTheTapeAndDescribesAll) {
  const auto names = derivative_back_end_names();
  EXPECT_EQ(names.front(), "tape");
  for (const std::string& name : names) EXPECT_FALSE(derivative_back_end_description(name).empty()) << name;
}

TEST(BackEndRegistry, RefusesAnUnknownNameAndListsThoseThereAre) {
  const auto problem = make_problem("orbital_transfer");
  const auto with = [&](const std::string& name) {
    Transcription(*problem, *make_element("dmoc"), gauss_tableau(1), Grid::uniform(8), name);
  };
  tests::expect_error_naming({"magic", "tape", "finite_differences", "forward_differences", "dense_differences"},
                             [&] { with("magic"); });
  if (!offers("adolc")) tests::expect_error_naming({"adolc", "install", "tape"}, [&] { with("adolc"); });
}

/// A table in the Lagrangian and one in the force, erf and asinh: what the library's problems do without.
class Tabulated final : public tests::SmallProblem {
 public:
  Tabulated() : SmallProblem("tabulated", at(-0.5, 0.2), at(1.5, 0.1), 1.0, 1) {}
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return 0.5 * x.v.squaredNorm() - potential_(x.q[0]) - erf(x.q[0]);
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return one(x.u[0] - potential_(x.v[0]) * asinh(x.v[0]));
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override { return x.u.squaredNorm(); }

 private:
  Spline potential_{{-1.0, 0.0, 0.4, 1.1, 2.0}, {0.2, 1.0, -0.7, 0.5, 0.3}};
};

TEST(BackEndsOfTables, AdolcAgreesOnTablesErrorFunctionsAndInverseHyperbolicSines) {
  if (!offers("adolc")) GTEST_SKIP() << "ADOL-C is not in this build";
  const Tabulated problem;
  for (const std::string& method : paper_families()) {
    SCOPED_TRACE(method);
    const auto by = [&](const std::string& name) {
      return derivatives_by(name, problem, {method, 2}, Grid::uniform(16), 0.1);
    };
    expect_below(by("adolc") - by("tape"), 1e-13);
  }
}

/// All problems, one method: free horizons without a running cost, ends without conditions, path constraints.
class BackEndsOfTheLibrary : public testing::TestWithParam<std::string> {};

TEST_P(BackEndsOfTheLibrary, AdolcAgreesToRounding) {
  if (!offers("adolc")) GTEST_SKIP() << "ADOL-C is not in this build";
  const auto problem = make_problem(GetParam());
  const Scheme scheme{"dmoc", 1};
  const Grid grid = Grid::uniform(16);
  const auto by = [&](const std::string& name) { return derivatives_by(name, *problem, scheme, grid, 0.01); };
  for (const char* const back_end : {"adolc", "adolc_whole"}) {
    SCOPED_TRACE(back_end);
    expect_below(by(back_end) - by("tape"), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(All, BackEndsOfTheLibrary, testing::ValuesIn(problem_names()),
                         [](const auto& instance) { return instance.param; });

TEST(BackEndRegistry, ManyAdolcProgramsLiveSideBySide) {
  if (!offers("adolc")) GTEST_SKIP() << "ADOL-C is not in this build";
  const auto problem = make_problem("two_link_manipulator");
  const auto make = [&](const std::string& method) {
    return std::make_unique<Transcription>(*problem, *make_element(method), gauss_tableau(1), Grid::uniform(6),
                                           "adolc");
  };
  const auto jacobian_of = [&](Transcription& program) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(program.jacobian_structure().size()));
    program.jacobian(sample(program, guessed_motion(*problem)), values);
    return values;
  };
  const auto first = make("dmoc");
  const Eigen::VectorXd before = jacobian_of(*first);
  for (int i = 0; i < 3; ++i) {
    const auto other = make("tangent");
    static_cast<void>(jacobian_of(*other));
  }
  EXPECT_EQ(jacobian_of(*first), before);
}

}  // namespace
}  // namespace dmocbench
