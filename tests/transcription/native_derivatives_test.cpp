// The derivatives of every problem as machine code, against the interpreted tape.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "methods/expression/tape.hpp"
#include "methods/transcription/elements/families.hpp"
#include "methods/transcription/interval_functions.hpp"
#include "problems/registry.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench {
namespace {

/// The numbers of all outputs, one after the other.
std::vector<double> evaluate_all(const Tape& tape, const std::vector<Tape::Input>& inputs, std::size_t count) {
  std::vector<double> numbers(tape.output_count() * count);
  std::vector<double*> outputs;
  for (std::size_t j = 0; j < tape.output_count(); ++j) outputs.push_back(numbers.data() + j * count);
  Tape::Workspace workspace(tape);
  tape.evaluate(count, inputs, outputs, workspace);
  return numbers;
}

/// All derivatives of an interval, at random points.
void expect_same_derivatives(const Problem& problem, const std::string& method) {
  constexpr std::size_t count = 133;  // a full block and a part of one
  const auto are_same = [](double x, double y) {
    return (std::isnan(x) && std::isnan(y)) || std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  const TracedProblem traced(problem);
  const IntervalFunctions functions =
      trace_interval(traced, *make_element(method), make_tableau("gauss", 1), {.cost_scale = problem.cost_scale()});
  tests::RandomPoints random;
  std::vector<std::vector<double>> columns(functions.inputs.count(), std::vector<double>(count));
  std::vector<Tape::Input> inputs;
  for (std::vector<double>& column : columns) {
    std::generate(column.begin(), column.end(), [&] { return random.number(0.1, 1.1); });
    inputs.push_back({column.data(), false});
  }
  for (const Schedule* schedule : {&functions.cost, &functions.gradient.schedule, &functions.rows.schedule,
                                   &functions.jacobian.schedule, &functions.hessian.schedule}) {
    for (const InstructionSet set : available_instruction_sets()) {
      const auto by = [&](NativeCodeUse use) { return evaluate_all(Tape(*schedule, set, use), inputs, count); };
      EXPECT_TRUE(std::ranges::equal(by(NativeCodeUse::always), by(NativeCodeUse::never), are_same))
          << method << " on " << name_of(set);
    }
  }
}

TEST(NativeDerivatives, OfEveryProblemAreThoseOfTheInterpreterBitByBit) {
  for (const std::string& name : problem_names()) {
    SCOPED_TRACE(name);
    const auto problem = make_problem(name);
    for (const std::string& method : paper_families()) expect_same_derivatives(*problem, method);
  }
}

}  // namespace
}  // namespace dmocbench
