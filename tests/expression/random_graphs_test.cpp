// Random formulas: what folding, sharing and differentiation make of them, against the same program
// run on plain numbers and on ADOL-C's.

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "methods/expression/derivatives.hpp"
#include "methods/expression/replay.hpp"
#include "tests/expression/adolc_reference.hpp"
#include "tests/expression/random_program.hpp"
#include "tests/expression/terms.hpp"

namespace dmocbench {
namespace {

using tests::AdolcReference;
using tests::RandomPoints;
using tests::RandomProgram;
using tests::Terms;

constexpr int graphs = 600;
constexpr std::size_t input_count = 4;
constexpr std::size_t output_count = 3;

RandomProgram next_program(RandomPoints& random, int number) {
  const auto steps = static_cast<std::size_t>(10 + number % 21);
  return {random, input_count, steps, output_count};
}

ExpressionVector traced(const RandomProgram& program) {
  const ExpressionVector x = input_vector(0, input_count);
  const std::vector<Expression> outputs = program.run(std::span<const Expression>(x.data(), input_count));
  return Eigen::Map<const ExpressionVector>(outputs.data(), output_count);
}

template <class Scalar>
std::vector<Scalar> at(const ExpressionMatrix& table, const std::vector<double>& point) {
  const std::vector<Scalar> inputs(point.begin(), point.end());
  const std::span<const Expression> entries(table.data(), static_cast<std::size_t>(table.size()));
  return replay<Scalar>(Schedule(entries), std::span<const Scalar>(inputs));
}

void expect_folded_near(const ExpressionMatrix& table, const Eigen::MatrixXd& expected,
                        const std::vector<double>& point) {
  const std::vector<Terms> found = at<Terms>(table, point);
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    const Terms& entry = found[static_cast<std::size_t>(i)];
    // Where folding leaves a structural zero, ADOL-C keeps the rounding of terms of size 1.
    const double scale = entry.magnitude > 0.0 ? entry.magnitude : 1.0;
    EXPECT_NEAR(entry.value, expected.data()[i], 1e-12 * scale) << "entry " << i;
  }
}

TEST(RandomGraphs, JacobiansAgreeWithAdolc) {
  RandomPoints random(1);
  for (int number = 0; number < graphs; ++number) {
    SCOPED_TRACE(number);
    const RandomProgram program = next_program(random, number);
    const AdolcReference reference([&](std::span<const adouble> x) { return program.run(x); }, program.point());
    expect_folded_near(jacobian(traced(program), input_vector(0, input_count)), reference.first_derivatives(),
                       program.point());
  }
}

TEST(RandomGraphs, GradientsAndHessiansAgreeWithAdolc) {
  RandomPoints random(2);
  for (int number = 0; number < graphs; ++number) {
    SCOPED_TRACE(number);
    const RandomProgram program = next_program(random, number);
    const ExpressionVector x = input_vector(0, input_count);
    // A sum of all outputs, as a Lagrange function is: everything shared is read more than once.
    const ExpressionVector outputs = traced(program);
    const Expression f = outputs[0] - 2.0 * outputs[1] + outputs[1] * outputs[2];
    const AdolcReference reference(
        [&](std::span<const adouble> inputs) {
          const std::vector<adouble> y = program.run(inputs);
          return std::vector<adouble>{adouble(y[0] - 2.0 * y[1] + y[1] * y[2])};
        },
        program.point());
    expect_folded_near(gradient(f, x).transpose(), reference.first_derivatives(), program.point());
    expect_folded_near(hessian(f, x), reference.second_derivatives(), program.point());
  }
}

TEST(RandomGraphs, FoldingDoesNotChangeValues) {
  RandomPoints random(3);
  for (int number = 0; number < graphs; ++number) {
    SCOPED_TRACE(number);
    const RandomProgram program = next_program(random, number);
    const std::vector<double>& point = program.point();
    const std::vector<double> folded = at<double>(traced(program), point);
    const std::vector<Terms> inputs(point.begin(), point.end());
    const std::vector<Terms> plain = program.run(std::span<const Terms>(inputs));
    for (std::size_t j = 0; j < output_count; ++j) {
      EXPECT_NEAR(folded[j], plain[j].value, 1e-14 * plain[j].magnitude);
    }
  }
}

TEST(RandomGraphs, SubstitutingTheInputsThemselvesGivesTheSameNodes) {
  RandomPoints random(4);
  for (int number = 0; number < graphs; ++number) {
    const ExpressionVector f = traced(next_program(random, number));
    const ExpressionVector x = input_vector(0, input_count);
    const std::vector<Expression> again =
        replay<Expression>(Schedule(f), std::span<const Expression>(x.data(), input_count));
    for (std::size_t j = 0; j < output_count; ++j) {
      EXPECT_TRUE(again[j].is_same(f[static_cast<Eigen::Index>(j)])) << number;
    }
  }
}

TEST(RandomGraphs, NanPassesWhereverTheFoldedGraphReadsItsInput) {
  RandomPoints random(5);
  for (int number = 0; number < graphs; ++number) {
    SCOPED_TRACE(number);
    const RandomProgram program = next_program(random, number);
    const ExpressionVector f = traced(program);
    for (const Expression& output : f) {
      const Schedule schedule(std::span(&output, 1));
      for (const Schedule::Step& step : schedule.steps()) {
        if (step.operation != Operation::input) continue;
        std::vector<double> point = program.point();
        point[step.input_index] = std::numeric_limits<double>::quiet_NaN();
        EXPECT_TRUE(std::isnan(replay<double>(schedule, std::span<const double>(point))[0]));
      }
    }
  }
}

}  // namespace
}  // namespace dmocbench
