#include "methods/mechanics/problem_check.hpp"

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "methods/mechanics/column_names.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using tests::expect_error_naming;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// All that a problem says of itself, to be spoilt.
struct Words {
  std::vector<Parameter> parameters{{.name = "mass", .value = 1.0, .unit = "kg", .meaning = "that is pushed"}};
  std::vector<std::string> q{"x", "y"};
  std::vector<std::string> u{"f", "g"};
  BoundaryState first = BoundaryState::at_rest(Eigen::Vector2d(0.0, 0.0));
  BoundaryState last = BoundaryState::at_rest(Eigen::Vector2d(1.0, 1.0));
  double horizon = 1.0;
  std::function<void(ProblemBounds&)> bound = [](ProblemBounds& /*bounds*/) {};
  MotionPoint guess{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  double cost_scale = 1.0;
  ProblemCard card;
  std::string throwing;  ///< the function that throws
};

/// A mass in a plane that says those words.
class Spoken final : public Problem {
 public:
  explicit Spoken(Words words) : Problem(words.parameters), words_(std::move(words)) {}
  [[nodiscard]] std::string name() const override { return "spoken"; }
  [[nodiscard]] ProblemCard card() const override { return told("card", words_.card); }
  [[nodiscard]] std::vector<std::string> configuration_names() const override {
    return told("configuration_names", words_.q);
  }
  [[nodiscard]] std::vector<std::string> control_names() const override { return told("control_names", words_.u); }
  [[nodiscard]] Expression lagrangian(const State& x) const override {
    return told("lagrangian", Expression(0.5 * (x.v[0] * x.v[0] + x.v[1] * x.v[1])));
  }
  [[nodiscard]] ExpressionVector force(const ControlledState& x) const override {
    return told("force", ExpressionVector(x.u));
  }
  [[nodiscard]] Expression running_cost(const ControlledState& x) const override {
    return told("running_cost", Expression(x.u[0] * x.u[0] + x.u[1] * x.u[1]));
  }
  [[nodiscard]] ExpressionVector path_constraints(const ControlledState& /*x*/) const override {
    return told("path_constraints", ExpressionVector());
  }
  [[nodiscard]] ExpressionVector boundary_conditions(const State& /*first*/, const State& /*last*/) const override {
    return told("boundary_conditions", ExpressionVector());
  }
  [[nodiscard]] Expression final_cost(const State& /*last*/) const override { return told("final_cost", Expression()); }
  [[nodiscard]] std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const override {
    return told("symmetry", std::optional<ExpressionVector>());
  }
  [[nodiscard]] BoundaryState initial_state() const override { return told("initial_state", words_.first); }
  [[nodiscard]] BoundaryState final_state() const override { return told("final_state", words_.last); }
  [[nodiscard]] double horizon() const override { return told("horizon", words_.horizon); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Problem::bounds();
    words_.bound(bounds);
    return told("bounds", bounds);
  }
  [[nodiscard]] MotionPoint guess(double /*t*/) const override { return told("guess", words_.guess); }
  [[nodiscard]] double cost_scale() const override { return told("cost_scale", words_.cost_scale); }

 private:
  template <class Value>
  [[nodiscard]] Value told(const char* function, Value value) const {
    if (words_.throwing == function) throw std::out_of_range("no such entry");
    return value;
  }

  Words words_;
};

/// The problem that is spoilt like this is refused with these words and its name.
void expect_refused(std::initializer_list<std::string> parts, const std::function<void(Words&)>& spoil) {
  Words words;
  spoil(words);
  const std::string sentence = tests::sentence_of_error([&] { check_problem(Spoken(words)); });
  EXPECT_TRUE(sentence.starts_with("spoken: ")) << sentence;
  EXPECT_FALSE(has_control_character(sentence)) << sentence;
  for (const std::string& part : parts) EXPECT_NE(sentence.find(part), std::string::npos) << part << ": " << sentence;
}

TEST(ProblemCheck, PassesEveryProblemOfTheSuite) {
  EXPECT_NO_THROW(check_problem(Spoken(Words())));
  for (const auto& problem : tests::problems()) EXPECT_NO_THROW(check_problem(*problem)) << problem->name();
}

TEST(ProblemCheck, TellsWhichFunctionThrowsWhateverItThrows) {
  for (const char* const function :
       {"card", "configuration_names", "control_names", "lagrangian", "force", "running_cost", "path_constraints",
        "boundary_conditions", "final_cost", "symmetry", "initial_state", "final_state", "horizon", "bounds", "guess",
        "cost_scale"}) {
    expect_refused({function, "no such entry"}, [&](Words& words) { words.throwing = function; });
  }
  expect_refused({"card().picture", "no such entry"}, [](Words& words) {
    words.card.picture = [](const ControlledState& /*x*/) -> Picture { throw std::out_of_range("no such entry"); };
  });
  expect_refused({"card().picture", "not a std::exception"}, [](Words& words) {
    words.card.picture = [](const ControlledState& /*x*/) -> Picture { throw 7; };  // NOLINT(hicpp-exception-baseclass)
  });
  expect_refused({"card().picture", "q[2]"}, [](Words& words) {
    words.card.picture = [](const ControlledState& x) -> Picture { return {{"z", "", x.q[2]}}; };
  });
}

TEST(ProblemCheck, RefusesEverySizeThatIsNotThatOfItsQuantity) {
  for (const Eigen::Index size : {1, 3}) {
    const Bounds wrong = Bounds::all(size, -1.0, 1.0);
    expect_refused({"bounds().q", "expected 2"}, [&](Words& words) { words.bound = [=](auto& b) { b.q = wrong; }; });
    expect_refused({"bounds().v", "expected 2"}, [&](Words& words) { words.bound = [=](auto& b) { b.v = wrong; }; });
    expect_refused({"bounds().u", "expected 2"}, [&](Words& words) { words.bound = [=](auto& b) { b.u = wrong; }; });
    expect_refused({"bounds().u", "expected 2"},
                   [&](Words& words) { words.bound = [=](auto& b) { b.u.lower = wrong.lower; }; });
    expect_refused({"first.q"}, [&](Words& words) { words.bound = [=](auto& b) { b.first.q = wrong; }; });
    expect_refused({"last.v"}, [&](Words& words) { words.bound = [=](auto& b) { b.last.v = wrong; }; });
    const Eigen::VectorXd zeros = Eigen::VectorXd::Zero(size);
    expect_refused({"initial_state", "expected 2"}, [&](Words& words) { words.first.q = zeros; });
    expect_refused({"final_state", "expected 2"}, [&](Words& words) { words.last.v = zeros; });
    expect_refused({"guess", "q has"}, [&](Words& words) { words.guess.q = zeros; });
    expect_refused({"guess", "v has"}, [&](Words& words) { words.guess.v = zeros; });
    expect_refused({"guess", "u has"}, [&](Words& words) { words.guess.u = zeros; });
  }
}

TEST(ProblemCheck, RefusesBoundsThatLeaveNoValueAndNumbersThatAreNone) {
  const auto bounded = [](double lower, double upper) {
    return [=](Words& words) { words.bound = [=](auto& b) { b.u = Bounds::all(2, lower, upper); }; };
  };
  expect_refused({"bounds().u", "above"}, bounded(1.0, -1.0));
  expect_refused({"bounds().u", "not a number"}, bounded(nan, 1.0));
  expect_refused({"bounds().u", "infinite"}, bounded(infinity, infinity));
  expect_refused({"bounds().u", "infinite"}, bounded(-infinity, -infinity));
  for (const double horizon : {0.0, -1.0, nan, infinity}) {
    expect_refused({"horizon"}, [&](Words& words) { words.horizon = horizon; });
  }
  for (const double scale : {0.0, -1.0, nan, infinity}) {
    expect_refused({"cost_scale"}, [&](Words& words) { words.cost_scale = scale; });
    expect_refused({"time_unit"}, [&](Words& words) { words.card.time_unit.factor = scale; });
  }
  expect_refused({"initial_state", "finite"}, [](Words& words) { words.first.q[1] = nan; });
  expect_refused({"configuration_units", "3 entries, expected 2"}, [](Words& words) {
    words.card.configuration_units = {"m", "m", "rad"};
  });
}

TEST(ProblemCheck, RefusesColumnsThatWouldShareAName) {
  for (const char* const other : {"v_x", "p_x", "psi_q_x", "psi_p_x"}) {
    expect_refused({"\"x\"", other}, [&](Words& words) { words.q = {"x", other}; });
    expect_refused({"\"x\"", other}, [&](Words& words) { words.q = {other, "x"}; });
    expect_refused({"\"x\"", other}, [&](Words& words) { words.u = {"f", other}; });
  }
  expect_refused({"\"x\"", "twice"}, [](Words& words) { words.u = {"x", "g"}; });
  expect_refused({"time"}, [](Words& words) { words.q = {"t", "x"}; });
  const auto pictured = [](std::vector<std::pair<std::string, std::string>> quantities) {
    return [=](Words& words) {
      words.card.picture = [=](const ControlledState& x) {
        Picture picture;
        for (const auto& [name, unit] : quantities) picture.push_back({name, unit, x.q[0]});
        return picture;
      };
    };
  };
  expect_refused({"picture", "\"a\"", "twice"}, pictured({{"a", ""}, {"a", ""}}));
  expect_refused({"picture", "a_in_m"}, pictured({{"a", "m"}, {"a_in_m", ""}}));
  expect_refused({"picture", "time"}, pictured({{"t", ""}}));
  expect_refused({"picture", "time"}, pictured({{"t", "s"}}));
  expect_refused({"picture", "time"}, pictured({{"t_in_s", ""}}));
  expect_refused({"picture", "cannot name a column"}, pictured({{"", "m"}}));
  expect_refused({"unit", "control"}, pictured({{"a", "m\n"}}));
}

TEST(ProblemCheck, RefusesNamesThatAreNotPlain) {
  for (const char* const name : {"", "a,b", "a\"b", "a\nb", "a\x1b[31m", " a", "a ", "\x7f", "a\xc2\x9b"}) {
    expect_refused({"configuration_names"}, [&](Words& words) { words.q = {name, "y"}; });
    expect_refused({"control_names"}, [&](Words& words) { words.u = {name, "g"}; });
  }
  for (const char* const name : {"", "a=b", "a b", "a,b", "a\nb", "\x1b[31m"}) {
    expect_refused({"parameter"}, [&](Words& words) { words.parameters[0].name = name; });
  }
}

TEST(ProblemCheck, RefusesTextsThatATerminalWouldObey) {
  const std::vector<std::pair<std::string, std::function<std::string&(Words&)>>> texts{
      {"unit", [](Words& words) -> std::string& { return words.parameters[0].unit; }},
      {"meaning", [](Words& words) -> std::string& { return words.parameters[0].meaning; }},
      {"description", [](Words& words) -> std::string& { return words.card.description; }},
      {"title", [](Words& words) -> std::string& { return words.card.title; }},
      {"axis_units", [](Words& words) -> std::string& { return words.card.axis_units.momentum; }},
      {"source", [](Words& words) -> std::string& { return words.card.source; }},
      {"guess", [](Words& words) -> std::string& { return words.card.guess; }},
      {"time_unit", [](Words& words) -> std::string& { return words.card.time_unit.name; }},
      {"control_units",
       [](Words& words) -> std::string& {
         words.card.control_units.resize(2);
         return words.card.control_units[1];
       }},
      {"certificate", [](Words& words) -> std::string& { return words.card.reference.emplace().certificate; }},
      {"remark", [](Words& words) -> std::string& { return words.card.reference.emplace().remark; }},
      {"published",
       [](Words& words) -> std::string& { return words.card.reference.emplace().published.emplace_back().source; }}};
  for (const auto& [name, text] : texts) {
    for (const char* const hostile : {"two\nlines", "\x1b[2J", "\r", "\x9", "\xc2\x9b\x32J"}) {
      expect_refused({name, "control character"}, [&, &text = text](Words& words) { text(words) = hostile; });
    }
    Words words;
    text(words) = "ψ̇, 10 µs – “é”";
    EXPECT_NO_THROW(check_problem(Spoken(words))) << name;
  }
}

TEST(ProblemCheck, RefusesDigitsThatADoubleHasNot) {
  for (const int digits : {-5, -1, 18, std::numeric_limits<int>::max()}) {
    expect_refused({"digits"}, [&](Words& words) { words.card.reference.emplace().digits = digits; });
  }
  expect_refused({"objective"}, [](Words& words) { words.card.reference.emplace().objective = nan; });
  for (const int digits : {0, 17}) {
    Words words;
    words.card.reference.emplace().digits = digits;
    EXPECT_NO_THROW(check_problem(Spoken(words)));
  }
}

}  // namespace
}  // namespace dmocbench
