// A program that was made once and is given other values is the program that is made anew for them.

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/mechanics/parameter_scope.hpp"
#include "methods/transcription/derivatives/back_ends.hpp"
#include "problems/registry.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

using tests::RandomPoints;

std::vector<std::string> varying_parameters(const Problem& problem) {
  return TracedProblem(problem).varying_parameters();
}

std::unique_ptr<Transcription> transcribe(const Problem& problem, const tests::Scheme& scheme,
                                          const std::vector<std::string>& open,
                                          const std::string& derivatives = "tape") {
  return std::make_unique<Transcription>(problem, *make_element(scheme.method), scheme.tableau(), Grid::uniform(9),
                                         OpenParameters{open}, derivatives);
}

/// Everything that solvers see of a program at a point.
struct Numbers {
  std::vector<Eigen::VectorXd> bounds;
  Eigen::VectorXd all;

  Numbers(Transcription& program, const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers)
      : bounds{program.variable_lower(), program.variable_upper(), program.constraint_lower(),
               program.constraint_upper()} {
    Eigen::VectorXd gradient(x.size());
    Eigen::VectorXd rows(multipliers.size());
    Eigen::VectorXd jacobian(static_cast<Eigen::Index>(program.jacobian_structure().size()));
    Eigen::VectorXd hessian(static_cast<Eigen::Index>(program.hessian_structure().size()));
    const double cost = program.objective(x);
    program.gradient(x, gradient);
    program.constraints(x, rows);
    program.jacobian(x, jacobian);
    program.hessian(x, 1.0, multipliers, hessian);
    // Dense, because entries that vanish for some values of the parameters only are entries of an open trace.
    const Eigen::MatrixXd first = dense(program.jacobian_structure(), jacobian, rows.size(), x.size());
    const Eigen::MatrixXd second = dense(program.hessian_structure(), hessian, x.size(), x.size());
    all.resize(1 + gradient.size() + rows.size() + first.size() + second.size());
    all << cost, gradient, rows, first.reshaped(), second.reshaped();
  }

 private:
  static Eigen::MatrixXd dense(const BlockPattern& pattern, const Eigen::VectorXd& values, Eigen::Index rows,
                               Eigen::Index columns) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, columns);
    pattern.for_each([&](Eigen::Index e, int row, int column) { matrix(row, column) = values[e]; });
    return matrix;
  }
};

/// The cost is divided by its scale: that of a program stays the one of its first values.
void expect_equal(Transcription& changed, Transcription& anew, double tolerance, const std::string& label) {
  ASSERT_EQ(changed.variable_count(), anew.variable_count()) << label;
  ASSERT_EQ(changed.cost_scale(), anew.cost_scale()) << label;
  RandomPoints random;
  const Motion guess = guessed_motion(anew.problem());
  const Eigen::VectorXd start = sample(anew, guess);
  EXPECT_TRUE(start.isApprox(sample(changed, guessed_motion(changed)), 1e-12)) << label;
  const Eigen::VectorXd x = start + random.vector(start.size(), -0.05, 0.05);
  const Eigen::VectorXd multipliers = random.vector(static_cast<Eigen::Index>(anew.constraint_count()));
  const Numbers ours(changed, x, multipliers);
  const Numbers theirs(anew, x, multipliers);
  for (std::size_t i = 0; i < ours.bounds.size(); ++i) {
    for (Eigen::Index j = 0; j < ours.bounds[i].size(); ++j) {
      const bool is_same = ours.bounds[i][j] == theirs.bounds[i][j];
      const double size = std::max(1.0, std::abs(theirs.bounds[i][j]));
      EXPECT_TRUE(is_same || std::abs(ours.bounds[i][j] - theirs.bounds[i][j]) <= 1e-13 * size) << label;
    }
  }
  const double size = std::max(1.0, theirs.all.lpNorm<Eigen::Infinity>());
  EXPECT_LE((ours.all - theirs.all).lpNorm<Eigen::Infinity>(), tolerance * size) << label;
}

/// Moves a parameter by some percent, within its range.
double moved(const Parameter& parameter, double share) {
  const double value = parameter.value == 0.0 ? share : parameter.value * (1.0 + share);
  return std::clamp(value, parameter.lower, parameter.upper);
}

std::vector<tests::Scheme> schemes() {
  return {{"dmoc", 1},
          {"hamiltonian", 1},
          {"tangent", 1},
          {"dmoc", 2, "lobatto"},
          {"hamiltonian", 2, "lobatto"},
          {"tangent", 2, "lobatto"}};
}

TEST(VaryingParameters, AreThoseOfThePapersManipulatorAndOfMostOfTheLibrary) {
  EXPECT_EQ(
      varying_parameters(*make_problem("two_link_manipulator")),
      (std::vector<std::string>{"mass_1", "mass_2", "length_1", "length_2", "inertia_1", "inertia_2", "gravity"}));
  std::size_t problems = 0;
  for (const std::string& name : problem_names()) problems += varying_parameters(*make_problem(name)).empty() ? 0 : 1;
  EXPECT_GE(problems, 13U);
}

TEST(VaryingParameters, GiveTheProgramThatIsTracedAnew) {
  for (const std::string& name : problem_names()) {
    const auto problem = make_problem(name);
    const std::vector<std::string> open = varying_parameters(*problem);
    if (open.empty()) continue;
    for (const tests::Scheme& scheme : schemes()) {
      if (!tests::takes_constraints(*problem, scheme)) continue;
      const auto program = transcribe(*problem, scheme, open);
      // Which components of the ends holonomic constraints determine is chosen when a program is set up.
      if (program->traced_problem().holonomic_count() > 0) continue;
      const auto other = make_problem(name);
      RandomPoints random;
      for (const std::string& parameter : open) {
        const Parameter& known = problem->parameters()[parameter_number(*problem, parameter)];
        other->set_parameter(parameter, moved(known, random.number(-0.1, 0.1)));
      }
      program->set_parameters(parameter_values(*other));
      const auto anew = transcribe(*other, scheme, {});
      if (anew->cost_scale() != program->cost_scale()) continue;  // judged by their own test
      expect_equal(*program, *anew, 1e-12, name + " " + scheme.label());
    }
  }
}

TEST(VaryingParameters, AndTheOldValuesGiveTheOldProgramBitByBit) {
  const auto problem = make_problem("two_link_manipulator");
  const auto program = transcribe(*problem, {"dmoc", 1}, varying_parameters(*problem));
  const Eigen::VectorXd x = sample(*program, guessed_motion(*problem));
  const Eigen::VectorXd multipliers = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(program->constraint_count()));
  const Numbers before(*program, x, multipliers);
  program->set_parameter("mass_1", 3.0);
  EXPECT_NE(Numbers(*program, x, multipliers).all, before.all);
  program->set_parameter("mass_1", 1.0);
  EXPECT_EQ(Numbers(*program, x, multipliers).all, before.all);
}

TEST(VaryingParameters, AreInputsOfEveryBackEnd) {
  const auto problem = make_problem("two_link_manipulator");
  const auto other = make_problem("two_link_manipulator");
  other->set_parameter("mass_2", 1.3);
  other->set_parameter("gravity", 3.7);
  for (const std::string& back_end : derivative_back_end_names()) {
    const auto program = transcribe(*problem, {"dmoc", 1}, {"gravity", "mass_2"}, back_end);
    program->set_parameters(parameter_values(*other));
    const auto anew = transcribe(*other, {"dmoc", 1}, {}, back_end);
    expect_equal(*program, *anew, back_end.ends_with("differences") ? 1e-3 : 1e-12, back_end);
  }
}

TEST(NumericData, IsReadAgainWithoutOpenParameters) {
  const auto problem = make_problem("orbital_transfer");
  const auto other = make_problem("orbital_transfer");
  other->set_parameter("target_altitude", 500.0);
  for (const tests::Scheme& scheme : schemes()) {
    const auto program = transcribe(*problem, scheme, {});
    program->set_parameter("target_altitude", 500.0);
    expect_equal(*program, *transcribe(*other, scheme, {}), 0.0, scheme.label());
  }
}

TEST(NumericData, CanBeSetOnTheProgram) {
  const auto problem = make_problem("two_link_manipulator");
  const auto program = transcribe(*problem, {"dmoc", 1}, {});
  const BoundaryState state{Eigen::Vector2d(-1.2, -1.4), Eigen::Vector2d(0.3, -0.2)};
  program->set_initial_state(state);
  EXPECT_EQ(program->bounds().first.q.lower, state.q);
  EXPECT_EQ(program->bounds().first.v.upper, state.v);
  EXPECT_EQ(program->variable_lower()[0], -1.2);
  program->set_horizon(1.5);
  EXPECT_EQ(program->horizon(sample(*program, guessed_motion(*program))), 1.5);
  EXPECT_DOUBLE_EQ(program->step_inputs().sum(), 1.5);
  program->set_parameters(parameter_values(*problem));
  EXPECT_EQ(program->bounds().first.q.lower, problem->initial_state().q);
  EXPECT_EQ(program->guessed_horizon(), 1.0);
}

TEST(OtherValues, ThatChangeTheStructureAreRefusedAndChangeNothing) {
  const auto problem = make_problem("cart_pole");
  const auto program = transcribe(*problem, {"dmoc", 1}, {"length"});
  const Eigen::VectorXd lower = program->variable_lower();
  tests::expect_error_naming({"cart_pole", "cart_mass", "keep it open"},
                             [&] { program->set_parameter("cart_mass", 2.0); });
  tests::expect_error_naming({"cart_pole", "bound", "create a new transcription"},
                             [&] { program->set_parameter("bounded", 0.0); });
  tests::expect_error_naming({"length", "nan"}, [&] { program->set_parameter("length", std::nan("")); });
  tests::expect_error_naming({"no parameter", "weight"}, [&] { program->set_parameter("weight", 1.0); });
  tests::expect_error_naming({"parameters", "got 1"}, [&] { program->set_parameters(Eigen::VectorXd::Ones(1)); });
  tests::expect_error_naming({"initial_state", "2 numbers"},
                             [&] { program->set_initial_state(BoundaryState::at_rest(Eigen::VectorXd::Zero(3))); });
  tests::expect_error_naming({"horizon"}, [&] { program->set_horizon(std::nan("")); });
  tests::expect_error_naming({"horizon"}, [&] { program->set_horizon(0.0); });
  EXPECT_EQ(program->variable_lower(), lower);
  EXPECT_EQ(program->parameter_values(), parameter_values(*problem));
}

TEST(ParametersToKeepOpen, AreRefusedWhereFormulasReadThemAsNumbers) {
  const auto oscillator = make_problem("double_oscillator");
  const auto chain = make_problem("link_chain");
  const tests::Scheme dmoc{"dmoc", 1};
  tests::expect_error_naming({"acrobot", "whole number"},
                             [&] { static_cast<void>(transcribe(*make_problem("acrobot"), dmoc, {"physical"})); });
  tests::expect_error_naming({"link_chain", "whole number"},
                             [&] { static_cast<void>(transcribe(*chain, dmoc, {"links"})); });
  tests::expect_error_naming({"no parameter", "colour"},
                             [&] { static_cast<void>(transcribe(*oscillator, dmoc, {"colour"})); });
  tests::expect_error_naming({"mass_1", "twice"}, [&] {
    static_cast<void>(transcribe(*oscillator, dmoc, {"mass_1", "mass_1"}));
  });
}

TEST(ParameterScopes, ChangeWhatOneThreadSees) {
  const auto problem = make_problem("two_link_manipulator");
  Eigen::VectorXd values = parameter_values(*problem);
  values[static_cast<Eigen::Index>(parameter_number(*problem, "horizon"))] = 2.5;
  {
    const ParameterScope scope(*problem, values);
    EXPECT_EQ(problem->horizon(), 2.5);
    EXPECT_EQ(make_problem("two_link_manipulator")->horizon(), 1.0);
  }
  EXPECT_EQ(problem->horizon(), 1.0);
}

}  // namespace
}  // namespace dmocbench
