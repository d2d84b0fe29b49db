#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "methods/extensions/interchange/ampl_answer.hpp"
#include "methods/extensions/interchange/ampl_model.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

const std::string answer_of_two_rows =
    "Solver 1.0:\nfound.\n\nOptions\n3\n1\n1\n0\n2\n2\n3\n3\n0.5\n-2e-3\n1\n2\n-3.25\nobjno 0 0\nsuffix 0 1 2 0 0\nx\n";

TEST(AmplSolution, IsReadWithTheSignOfOurMultipliers) {
  const AmplSolution solution = read_ampl_solution(answer_of_two_rows);
  EXPECT_EQ(solution.message, "Solver 1.0: found.");
  EXPECT_EQ(solution.primal, Eigen::Vector3d(1.0, 2.0, -3.25));
  EXPECT_EQ(solution.multipliers, Eigen::Vector2d(-0.5, 2e-3));
  EXPECT_EQ(solution.variable_count, 3);
  EXPECT_EQ(solution.constraint_count, 2);
  EXPECT_EQ(solution.status(), Status::solved);
}

TEST(AmplSolution, MayHaveAToleranceAmongItsOptions) {
  std::string text = answer_of_two_rows;
  text.replace(text.find("3\n1\n1\n0\n"), 8, "3\n1\n3\n0\n1e-6\n");
  EXPECT_EQ(read_ampl_solution(text).primal, Eigen::Vector3d(1.0, 2.0, -3.25));
}

TEST(AmplSolution, TellsWhatItsSolverThinks) {
  for (const auto& [code, status] :
       {std::pair("0", Status::solved), std::pair("102", Status::acceptable), std::pair("200", Status::infeasible),
        std::pair("300", Status::diverged), std::pair("401", Status::iteration_limit),
        std::pair("500", Status::solver_error), std::pair("-1", Status::solver_error)}) {
    std::string text = answer_of_two_rows;
    text.replace(text.find("objno 0 0"), 9, std::string("objno 0 ") + code);
    EXPECT_EQ(read_ampl_solution(text).status(), status) << code;
  }
}

TEST(AmplSolution, IsRefusedWhereverItIsCutOff) {
  const std::size_t whole = answer_of_two_rows.find("suffix");
  for (std::size_t size = 0; size < whole; ++size) {
    EXPECT_THROW(static_cast<void>(read_ampl_solution(answer_of_two_rows.substr(0, size))), Error) << size;
  }
  EXPECT_NO_THROW(static_cast<void>(read_ampl_solution(answer_of_two_rows.substr(0, whole))));
}

TEST(AmplSolution, IsRefusedIfItIsSomethingElse) {
  const auto expect_named = [](const std::string& part, const std::string& text) {
    tests::expect_error_naming({part}, [&] { static_cast<void>(read_ampl_solution(text)); });
  };
  expect_named("not a text file", std::string(6, '\0'));
  expect_named("Options", "t,q\n0,1\n");
  expect_named("truncated", "\nOptions\n0\n1000000000000\n1000000000000\n0\n0\n");
  expect_named("much", "\nOptions\n0\n1\n0\n1\n1\nmuch\nobjno 0 0\n");
  expect_named("must be 0 or 3", "\nOptions\n0\n1\n0\n3\n2\n1\n2\nobjno 0 0\n");
}

/// A particle in a force that AMPL cannot write.
class InAnErrorFunction final : public tests::SmallProblem {
 public:
  InAnErrorFunction() : SmallProblem("in_an_error_function", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1) {}
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override { return one(x.u[0] - erf(x.q[0])); }
};

class AmplAnswerOfSpring : public testing::Test {
 protected:
  std::unique_ptr<Problem> problem_ = make_problem("forced_oscillator");
  std::unique_ptr<Transcription> program_ = tests::transcribe(*problem_, {"dmoc"}, Grid::uniform(8));
  Eigen::VectorXd start_ = sample(*program_, guessed_motion(*problem_));
  Solution own_ = make_solver("ipopt")->solve(*program_, start_);
  AmplSolution answer_{.message = "found",
                       .primal = own_.primal,
                       .multipliers = own_.multipliers,
                       .variable_count = own_.primal.size(),
                       .constraint_count = own_.multipliers.size()};
};

TEST_F(AmplAnswerOfSpring, IsJudgedAsOurOwn) {
  const Solution judged = AmplAnswer(answer_).solve(*program_, start_);
  EXPECT_EQ(judged.status, Status::solved);
  EXPECT_EQ(judged.objective, own_.objective);
  EXPECT_EQ(judged.kkt_residual, own_.kkt_residual);
}

TEST_F(AmplAnswerOfSpring, MayHaveMultipliersOfTheOtherSignOrNone) {
  answer_.multipliers = -own_.multipliers;
  EXPECT_EQ(AmplAnswer(answer_).solve(*program_, start_).multipliers, own_.multipliers);
  answer_.multipliers.resize(0);
  const Solution judged = AmplAnswer(answer_).solve(*program_, start_);
  EXPECT_EQ(judged.status, Status::solved);
  EXPECT_TRUE(judged.multipliers_are_estimated);
}

TEST_F(AmplAnswerOfSpring, IsNotConfirmedIfItIsWrong) {
  answer_.primal[3] += 0.1;
  EXPECT_EQ(AmplAnswer(answer_).solve(*program_, start_).status, Status::not_confirmed);
}

TEST_F(AmplAnswerOfSpring, WithoutAPointIsNoAnswer) {
  answer_.primal.resize(0);
  EXPECT_EQ(AmplAnswer(answer_).solve(*program_, start_).status, Status::solver_error);
}

TEST_F(AmplAnswerOfSpring, IsRefusedIfItBelongsToAnotherProgram) {
  answer_.variable_count += 1;
  EXPECT_THROW(AmplAnswer(answer_).require_fit(*program_), Error);
}

TEST(AmplNames, AreOnePerUnknownAndRow) {
  for (const std::string& name : problem_names()) {
    const auto problem = make_problem(name);
    for (const tests::Scheme& scheme :
         {tests::Scheme{"dmoc", 2}, tests::Scheme{"hamiltonian", 3}, tests::Scheme{"tangent", 3, "lobatto_shared"},
          tests::Scheme{"dmoc", 3, "lobatto"}, tests::Scheme{"multiple_shooting_rk4_1"}}) {
      if (!tests::takes_constraints(*problem, scheme)) continue;
      const bool is_paper_method = family_of(scheme.method).is_of_paper;
      if (!is_paper_method && problem->first_order_size() > 0) continue;  // shooting knows no first-order states
      for (const CostForm form : {CostForm::bolza, CostForm::mayer}) {
        const Transcription program(*problem, *make_element(scheme.method), scheme.tableau(), Grid::uniform(12), "tape",
                                    form);
        std::vector<std::string> names = ampl_variable_names(program);
        EXPECT_EQ(names.size(), program.variable_count());
        std::ranges::sort(names);
        EXPECT_EQ(std::ranges::adjacent_find(names), names.end()) << name << ' ' << scheme.label();
        EXPECT_EQ(ampl_row_names(program).size(), program.constraint_count()) << name << ' ' << scheme.label();
      }
    }
  }
}

TEST(AmplModel, RefusesAnOperationThatAmplLacks) {
  const InAnErrorFunction problem;
  const auto program = tests::transcribe(problem, {"dmoc"}, Grid::uniform(2));
  const Eigen::VectorXd start = sample(*program, guessed_motion(problem));
  tests::expect_error_naming({"AMPL", "erf"}, [&] { static_cast<void>(ampl_model(*program, start)); });
}

TEST(AmplModel, IsShort) {
  constexpr std::size_t most_bytes = 20'000'000;
  for (const std::string& name : paper_problem_names()) {
    const auto problem = make_problem(name);
    for (const char* const method : {"dmoc", "tangent"}) {
      const auto program = tests::transcribe(*problem, {method}, Grid::uniform(1024));
      const AmplModel model = ampl_model(*program, sample(*program, guessed_motion(*problem)));
      EXPECT_LT(model.nl.size() + model.row.size() + model.col.size(), most_bytes) << name << ' ' << method;
      testing::Test::RecordProperty(fmt::format("{}_{}", name, method), std::to_string(model.nl.size()));
    }
  }
}

}  // namespace
}  // namespace dmocbench
