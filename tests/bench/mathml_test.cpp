#include "bench/report/mathml.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/report/model.hpp"
#include "bench/report/stated_problem.hpp"
#include "methods/expression/replay.hpp"
#include "problems/registry.hpp"
#include "tests/bench/mathml_value.hpp"
#include "tests/expression/random_program.hpp"
#include "tests/support/problems_for_tests.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench {
namespace {

using tests::RandomPoints;
using tests::value_of_mathml;

std::string in_one_row(const MathTerms& terms) {
  std::string row;
  for (const std::string& term : terms) row += term;
  return row;
}

/// What is written, as text without markup; multiplication shows as a blank.
std::string plain(const std::string& markup) {
  std::string text;
  bool is_tag = false;
  for (const char letter : markup) {
    if (letter == '<') is_tag = true;
    if (!is_tag) text += letter;
    if (letter == '>') is_tag = false;
  }
  for (const std::string sign : {"\u2062", "\u2061"}) {
    for (std::size_t at = text.find(sign); at != std::string::npos; at = text.find(sign))
      text.replace(at, sign.size(), " ");
  }
  return text;
}

const std::vector<std::string> abc{"<mi>a</mi>", "<mi>b</mi>", "<mi>c</mi>"};

std::string plain_formula(const Expression& formula) {
  return plain(in_one_row(typeset(std::vector{formula}, abc, 0, "w").formulas.front()));
}

/// Evaluates what is written, shared parts first, and compares with the traced formulas themselves.
void expect_equal_values(const std::vector<Expression>& formulas, const std::vector<std::string>& inputs,
                         std::size_t parameters, const std::vector<double>& point, const std::string& whose) {
  const TypesetFormulas written = typeset(formulas, inputs, parameters, "w");
  const std::vector<double> values = replay<double>(Schedule(formulas), std::span<const double>(point));
  std::map<std::string, double> names;
  for (std::size_t i = 0; i < inputs.size(); ++i) names[inputs[i]] = point.at(i);
  for (const auto& [name, terms] : written.shared) names[name] = value_of_mathml(in_one_row(terms), names);
  ASSERT_EQ(written.formulas.size(), formulas.size());
  for (std::size_t i = 0; i < formulas.size(); ++i) {
    ASSERT_TRUE(std::isfinite(values[i])) << whose;
    const std::string row = in_one_row(written.formulas[i]);
    EXPECT_NEAR(value_of_mathml(row, names), values[i], 1e-9 * std::max(1.0, std::abs(values[i])))
        << whose << ": " << plain(row);
  }
}

TEST(Mathml, HasTheValuesOfRandomFormulas) {
  RandomPoints random;
  std::size_t shared = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const tests::RandomProgram program(random, 3, 25, 4);
    std::vector<Expression> inputs;
    for (std::size_t i = 0; i < 3; ++i) inputs.push_back(Expression::input(i));
    const std::vector<Expression> formulas = program.run<Expression>(inputs);
    expect_equal_values(formulas, abc, static_cast<std::size_t>(trial % 3), program.point(),
                        "formula " + std::to_string(trial));
    shared += typeset(formulas, abc, 0, "w").shared.size();
  }
  EXPECT_GT(shared, 0U);
}

std::vector<Expression> values_of(const std::vector<StatedFormula>& formulas) {
  std::vector<Expression> values;
  values.reserve(formulas.size());
  for (const StatedFormula& formula : formulas) values.push_back(formula.value);
  return values;
}

TEST(Mathml, HasTheValuesOfEveryProblemsFormulas) {
  RandomPoints random;
  for (const std::string& name : problem_names()) {
    const auto problem = make_problem(name);
    const StatedProblem statement = stated(*problem);
    const auto point_of = [&](std::size_t size) {
      std::vector<double> point(size);
      for (double& value : point) value = random.number(0.4, 1.4);
      for (std::size_t i = 0; i < statement.letters.size(); ++i) point[i] = statement.letters[i].parameter->value;
      return point;
    };
    for (int trial = 0; trial < 5; ++trial) {
      expect_equal_values(values_of(statement.along), statement.inputs, statement.letters.size(),
                          point_of(statement.inputs.size()), name);
      if (statement.at_ends.empty()) continue;
      expect_equal_values(values_of(statement.at_ends), statement.end_inputs, statement.letters.size(),
                          point_of(statement.end_inputs.size()), name);
    }
  }
}

TEST(Mathml, GivesEveryInputOfAProblemANameOfItsOwn) {
  for (const std::string& name : problem_names()) {
    const auto problem = make_problem(name);
    const StatedProblem statement = stated(*problem);
    for (std::vector<std::string> inputs : {statement.inputs, statement.end_inputs}) {
      std::ranges::sort(inputs);
      EXPECT_EQ(std::ranges::adjacent_find(inputs), inputs.end()) << name;
    }
  }
}

TEST(Mathml, WritesFormulasAsReadersKnowThem) {
  const Expression a = Expression::input(0);
  const Expression b = Expression::input(1);
  const Expression c = Expression::input(2);
  EXPECT_EQ(plain_formula(0.5 * a * a), "12 a2");
  EXPECT_EQ(plain_formula(a - (b - c)), "a+c−b");
  EXPECT_EQ(plain_formula(-(a + b)), "−a−b");
  EXPECT_EQ(plain_formula(a * (b + c)), "a (b+c)");
  EXPECT_EQ(plain_formula(cos(a) * b), "b cos (a)");
  EXPECT_EQ(plain(in_one_row(
                typeset(std::vector{a * (b + c)}, {"<mi>drag</mi>", "<mi>b</mi>", "<mi>c</mi>"}, 1, "w").formulas[0])),
            "drag·(b+c)");
  EXPECT_EQ(plain_formula(sin(a - b) * sin(a - b)), "sin2 (a−b)");
  EXPECT_NE(typeset(std::vector{(a + b) / (a * c)}, abc, 0, "w").formulas[0][0].find("<mfrac>"), std::string::npos);
  EXPECT_EQ(typeset(std::vector{a + b - c}, abc, 0, "w").formulas[0].size(), 3U);
}

TEST(Mathml, NamesWhatIsLongAndReadTwice) {
  const Expression a = Expression::input(0);
  const Expression b = Expression::input(1);
  const Expression air = sqrt(a * a + (b - sin(a)) * (b - sin(a)) + 3.0 * cos(b));
  const TypesetFormulas written = typeset(std::vector{a * air, b * air}, abc, 0, "w");
  ASSERT_EQ(written.shared.size(), 1U);
  EXPECT_EQ(plain(written.shared[0].first), "w1");
  EXPECT_EQ(plain(in_one_row(written.formulas[1])), "b w1");
  EXPECT_TRUE(typeset(std::vector{a * sin(b), b * sin(b)}, abc, 0, "w").shared.empty());
}

TEST(Mathml, TellsTheLengthOfWhatIsTooLongToRead) {
  const Expression a = Expression::input(0);
  Expression sum = a;
  Expression nested = a;
  for (int i = 0; i < 100000; ++i) {
    sum += sin(Expression(1.0 + i) * a);
    nested = sin(nested);
  }
  const TypesetFormulas written = typeset(std::vector{sum, a * a, nested}, abc, 0, "w");
  EXPECT_EQ(plain(in_one_row(written.formulas[0])), "a formula of 299999 operations");
  EXPECT_EQ(plain(in_one_row(written.formulas[1])), "a2");
  EXPECT_EQ(plain(in_one_row(written.formulas[2])), "a formula of 100000 operations");
  EXPECT_TRUE(written.shared.empty());
}

TEST(Mathml, TypesetsTheLongestFormulasThatItTakes) {
  const Expression a = Expression::input(0);
  Expression nested = a;
  for (std::size_t i = 0; i < most_typeset_operations; ++i) nested = sin(nested);
  EXPECT_NE(typeset(std::vector{nested}, abc, 0, "w").formulas[0][0].find("sin"), std::string::npos);
}

TEST(Mathml, TakesNoLongerWhereFewOperationsMakeALongFormula) {
  const Expression a = Expression::input(0);
  const Expression b = Expression::input(1);
  Expression power = a;
  Expression angle = a;
  for (int i = 0; i < 50; ++i) {
    power = power * power;
    angle = atan2(angle, angle);
  }
  EXPECT_EQ(plain_formula(power), "a1125899906842624");
  EXPECT_LT(plain_formula(angle).size(), 1000U);
  std::vector<Expression> each_reads_the_one_before{a + b};
  for (int i = 0; i < 60; ++i)
    each_reads_the_one_before.push_back(sin(each_reads_the_one_before.back()) * cos(each_reads_the_one_before.back()));
  std::size_t size = 0;
  for (const MathTerms& terms : typeset(each_reads_the_one_before, abc, 0, "w").formulas)
    size += in_one_row(terms).size();
  EXPECT_LT(size, 1000000U);
}

/// A mass whose unit is said in any way.
class MassInUnit : public tests::SmallProblem {
 public:
  explicit MassInUnit(const std::string& unit)
      : SmallProblem("mass_in_unit", at(0.0, 0.0), at(1.0, 0.0), 1.0, 1,
                     {{.name = "mass", .value = 2.0, .unit = unit, .meaning = "that is pushed"}}) {}
  [[nodiscard]] std::vector<std::string> configuration_names() const override { return {"x"}; }
  [[nodiscard]] std::vector<std::string> control_names() const override { return {"push"}; }
  [[nodiscard]] Expression lagrangian(const State& x) const override { return 0.5 * varying("mass") * x.v[0] * x.v[0]; }
};

TEST(Statement, RaisesTheExponentsOfUnits) {
  const auto unit_of = [](const std::string& unit) {
    return statement_model(MassInUnit(unit))["letters"][0]["unit"].get<std::string>();
  };
  EXPECT_EQ(unit_of("m/s^2"), "m/s²");
  EXPECT_EQ(unit_of("kg m^-12 s^3/x"), "kg m⁻¹² s³/x");
  EXPECT_EQ(unit_of("^, m^, m^-, <^^2"), "^, m^, m^-, <^²");
  const std::size_t many = 1000000;  // a regular expression would overflow the stack
  EXPECT_EQ(unit_of("m^" + std::string(many, '1')).size(), 1 + 2 * many);
}

TEST(Mathml, SetsNamesAndNumbers) {
  EXPECT_EQ(mathml_of_name("theta_1"), "<msub><mi>θ</mi><mn>1</mn></msub>");
  EXPECT_EQ(mathml_of_name("u_phi"), "<msub><mi>u</mi><mi>φ</mi></msub>");
  EXPECT_EQ(plain(mathml_of_rate("x")), "x˙");
  EXPECT_EQ(mathml_of_name("<b>"), "<mi>&lt;b&gt;</mi>");
  EXPECT_EQ(mathml_of_number(0.5), "<mfrac><mn>1</mn><mn>2</mn></mfrac>");
  EXPECT_EQ(mathml_of_number(9.81), "<mn>9.81</mn>");
  EXPECT_EQ(plain(mathml_of_number(-std::numbers::pi / 2.0)), "−π2");
  EXPECT_EQ(plain(mathml_of_number(1e9)), "109");
  for (const double value :
       {1.0 / 12.0, -0.1, 398600.0, 3e20, 1.2345678901234567e-8, -7.0 * std::numbers::pi / 3.0, 0.0})
    EXPECT_NEAR(value_of_mathml(mathml_of_number(value), {}), value, 1e-15 * std::abs(value)) << value;
}

}  // namespace
}  // namespace dmocbench
