// Tapes as machine code: what the interpreter computes, bit by bit.
#include "methods/expression/native/native_code.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "methods/expression/derivatives.hpp"
#include "methods/expression/native/late_code.hpp"
#include "methods/expression/native/register_allocation.hpp"
#include "methods/expression/native/step_order.hpp"
#include "tests/expression/operations.hpp"
#include "tests/expression/random_program.hpp"
#include "tests/expression/series_table.hpp"

namespace dmocbench {
namespace {

using tests::RandomPoints;
using tests::SeriesTable;

/// A step of a plan on single numbers.
double carried_out(VectorOperation operation, double x, double y) {
  switch (operation) {
    case VectorOperation::add:
      return x + y;
    case VectorOperation::subtract:
      return x - y;
    case VectorOperation::multiply:
      return x * y;
    case VectorOperation::divide:
      return x / y;
    case VectorOperation::square_root:
      return std::sqrt(x);
    case VectorOperation::exclusive_or:
      return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ std::bit_cast<std::uint64_t>(y));
    case VectorOperation::copy:
      return x;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// A processor on which the steps of a stage run, a number at a time. What has not been written is NaN.
class SimulatedProcessor {
 public:
  SimulatedProcessor(std::size_t registers, std::size_t stack_places, const NativePlan& plan)
      : plan_(plan), registers_(registers, nothing), stack_(stack_places, nothing) {}

  void run(const std::vector<MachineStep>& steps, std::vector<double>& series) {
    for (const MachineStep& step : steps) {
      const double left = value(step.left, series);
      const double right = operand_count(step.operation) > 1 ? value(step.right, series) : 0.0;
      place(step.result, series) = carried_out(step.operation, left, right);
    }
  }

 private:
  static constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

  double& place(const OperandPlace& where, std::vector<double>& series) {
    if (where.kind == OperandPlace::Kind::in_register) return registers_.at(where.number);
    return where.kind == OperandPlace::Kind::stack ? stack_.at(where.number) : series.at(where.number);
  }
  double value(const OperandPlace& where, std::vector<double>& series) {
    if (where.kind == OperandPlace::Kind::constant) return plan_.homes.at(where.number).constant.value();
    return place(where, series);
  }

  const NativePlan& plan_;
  std::vector<double> registers_;
  std::vector<double> stack_;
};

/// Whether numbers are the same bit by bit; one NaN is as good as another.
bool are_same(double x, double y) {
  return (std::isnan(x) && std::isnan(y)) || std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
}

void expect_same(const SeriesTable& found, const SeriesTable& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t j = 0; j < found.size(); ++j) {
    EXPECT_TRUE(std::ranges::equal(found[j], expected[j], are_same)) << "output " << j;
  }
}

/// Both ways on every instruction set; on `baseline` they are the same. A system that gives no executable memory fails
/// here, so that nothing is compared with itself.
void expect_code_like_interpreter(const Schedule& schedule, const SeriesTable& inputs) {
  for (const InstructionSet set : available_instruction_sets()) {
    SCOPED_TRACE(name_of(set));
    const Tape interpreted(schedule, set, NativeCodeUse::never);
    const Tape native(schedule, set, NativeCodeUse::always);
    EXPECT_FALSE(interpreted.is_native());
    EXPECT_EQ(native.is_native(), has_native_code(set) && schedule.operation_count() > 0);
    for (const std::size_t count : tests::interval_counts()) {
      if (count > inputs.front().size()) break;
      SCOPED_TRACE(count);
      expect_same(tests::evaluate(native, inputs, count), tests::evaluate(interpreted, inputs, count));
    }
  }
}

SeriesTable random_inputs(RandomPoints& random, std::size_t inputs, std::size_t count, double low, double high) {
  SeriesTable table(inputs, std::vector<double>(count));
  for (auto& column : table) std::generate(column.begin(), column.end(), [&] { return random.number(low, high); });
  return table;
}

struct CompareCodeWithInterpreter {
  template <class Formula>
  void operator()(const char* name, const Formula& formula, const tests::Domain& domain) const {
    SCOPED_TRACE(name);
    const ExpressionVector x = input_vector(0, 2);
    RandomPoints random;
    const SeriesTable inputs = random_inputs(random, 2, 150, domain.low, domain.high);
    const Expression f = formula(x[0], x[1]);
    expect_code_like_interpreter(Schedule(ExpressionVector{{f, f * x[0] - x[1], 2.0 / f}}), inputs);
  }
};

TEST(NativeCode, GivesWhatTheInterpreterGivesForEveryOperation) {
  tests::visit_operations(CompareCodeWithInterpreter{});
  tests::visit_powers(CompareCodeWithInterpreter{});
}

TEST(NativeCode, GivesWhatTheInterpreterGivesForRandomFormulasAndTheirSecondDerivatives) {
  RandomPoints random;
  for (int number = 0; number < 40; ++number) {
    SCOPED_TRACE(number);
    const tests::RandomProgram program(random, 3, 30, 1);
    const ExpressionVector x = input_vector(0, 3);
    const Expression f = program.run(std::span<const Expression>(x.data(), 3))[0];
    SeriesTable inputs = random_inputs(random, 3, 128, -1e-3, 1e-3);
    for (std::size_t i = 0; i < 3; ++i) {
      for (double& entry : inputs[i]) entry += program.point()[i];
    }
    expect_code_like_interpreter(Schedule(ExpressionVector(hessian(f, x).reshaped())), inputs);
  }
}

TEST(NativeCode, PassesInfinityAndNan) {
  const ExpressionVector x = input_vector(0, 2);
  const std::vector<double> special{0.0,
                                    -0.0,
                                    1.0,
                                    -1.0,
                                    std::numeric_limits<double>::infinity(),
                                    -std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::quiet_NaN(),
                                    std::numeric_limits<double>::denorm_min()};
  SeriesTable inputs(2);
  for (const double a : special) {
    for (const double b : special) {
      inputs[0].push_back(a);
      inputs[1].push_back(b);
    }
  }
  expect_code_like_interpreter(
      Schedule(ExpressionVector{{-x[0], 1.0 / x[0], x[0] / x[1], sqrt(x[0]), x[0] - x[1], x[0] * x[1], x[0] + x[1]}}),
      inputs);
}

TEST(NativeCode, WritesOutputsThatAreConstantsInputsAndRepetitions) {
  const ExpressionVector x = input_vector(0, 2);
  const Expression sum = x[0] + x[1];
  const Expression sine = sin(sum);
  RandomPoints random;
  expect_code_like_interpreter(
      Schedule(ExpressionVector{{x[1], sum, Expression(-0.0), sum, sine, cos(sum), sine, sine * x[0], x[1]}}),
      random_inputs(random, 2, 130, -2.0, 2.0));
}

/// Hundreds of values that are all alive at once: more than any processor has registers for.
Schedule crowded_formulas() {
  const ExpressionVector x = input_vector(0, 4);
  std::vector<Expression> values;
  for (Eigen::Index i = 0; i < 150; ++i) values.push_back(x[i % 4] * (1.0 + static_cast<double>(i)) - x[(i + 1) % 4]);
  Expression backwards = exp(values.front() * 1e-3);
  for (std::size_t i = values.size(); i-- > 0;) backwards = values[i] / (2.0 + backwards * backwards);
  values.push_back(backwards);
  return Schedule(values);
}

TEST(NativeCode, KeepsWhatFindsNoRegisterOnTheStack) {
  const Schedule schedule = crowded_formulas();
  RandomPoints random;
  expect_code_like_interpreter(schedule, random_inputs(random, 4, 128, 0.5, 1.5));
}

TEST(NativeCode, OneValueServesAllIntervalsWhereAnInputIsTheSameForAll) {
  const ExpressionVector x = input_vector(0, 2);
  const Tape tape(Schedule(ExpressionVector{{x[0] * x[1] + sin(x[1])}}), preferred_instruction_set(),
                  NativeCodeUse::always);
  const double shared = 0.7;
  std::vector<double> varying(200);
  for (std::size_t k = 0; k < varying.size(); ++k) varying[k] = static_cast<double>(k);
  std::vector<double> found(200);
  Tape::Workspace workspace(tape);
  tape.evaluate(varying.size(), std::vector<Tape::Input>{{varying.data()}, {&shared, true}},
                std::vector<double*>{found.data()}, workspace);
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], varying[k] * 0.7 + std::sin(0.7), 1e-13);
}

TEST(RegisterAllocation, ComputesTheSameOnAnyNumberOfRegisters) {
  const Schedule schedule = crowded_formulas();
  const std::vector<double> point{0.6, 0.9, 1.1, 1.4};
  TapeSeries table{std::vector<std::uint32_t>(schedule.steps().size()), 0, 0};
  std::vector<double> beginning;
  for (std::size_t i = 0; i < schedule.steps().size(); ++i) {
    const Schedule::Step& step = schedule.steps()[i];
    if (operand_count(step.operation) > 0) continue;
    table.of_steps[i] = static_cast<std::uint32_t>(beginning.size());
    beginning.push_back(step.operation == Operation::input ? point[step.input_index] : step.value);
  }
  table.first_output = static_cast<std::uint32_t>(beginning.size());
  table.first_slot = table.first_output + static_cast<std::uint32_t>(schedule.outputs().size());
  const NativePlan plan = native_plan(schedule, table);
  ASSERT_EQ(plan.stages.size(), 2U) << "before the exponential function and after it";
  const std::vector<double> expected = replay<double>(schedule, point);
  std::size_t loads_before = std::numeric_limits<std::size_t>::max();
  for (const std::size_t registers : {3U, 4U, 5U, 8U, 16U, 32U, 64U}) {
    SCOPED_TRACE(registers);
    std::vector<double> series = beginning;
    series.resize(table.first_slot + plan.slots);
    std::size_t steps = 0;
    for (const NativeStage& stage : plan.stages) {
      const MachineSteps machine = allocate_registers(stage, plan.homes, registers);
      SimulatedProcessor processor(registers, machine.stack_places, plan);
      processor.run(machine.once, series);
      processor.run(machine.steps, series);
      for (const TapeInstruction& function : stage.functions) {
        series[function.result] = std::exp(series[function.operands[0]]);
      }
      steps += machine.steps.size();
    }
    for (std::size_t j = 0; j < expected.size(); ++j) EXPECT_EQ(series[table.first_output + j], expected[j]) << j;
    EXPECT_LE(steps, loads_before) << "fewer registers took fewer loads";
    loads_before = steps;
  }
}

/// Chains of so many sums, one after the other; sum j of chain i is value 1 + i * length + j. Value 0 is in memory.
std::vector<VectorStep> chains_of_sums(std::uint32_t chains, std::uint32_t length) {
  std::vector<VectorStep> steps;
  for (std::uint32_t i = 0; i < chains; ++i) {
    for (std::uint32_t j = 0; j < length; ++j) {
      const std::uint32_t result = 1 + i * length + j;
      steps.push_back({VectorOperation::add, result, j == 0 ? 0 : result - 1, 0});
    }
    steps.push_back({VectorOperation::copy, i, (i + 1) * length, (i + 1) * length});
  }
  return steps;
}

std::vector<std::uint32_t> results_of(const std::vector<VectorStep>& steps) {
  std::vector<std::uint32_t> results;
  for (const VectorStep& step : steps) {
    if (step.operation != VectorOperation::copy) results.push_back(step.result);
  }
  return results;
}

TEST(StepOrder, LetsNoSumWaitForTheOneBeforeItWhereOthersCould) {
  constexpr std::uint32_t chains = 5;
  constexpr std::uint32_t length = 6;
  const std::vector<VectorStep> steps = chains_of_sums(chains, length);
  const std::vector<VectorStep> ordered = overlapping_order(steps, 1 + chains * length, 16);
  const std::vector<std::uint32_t> results = results_of(ordered);
  ASSERT_EQ(ordered.size(), steps.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto before = std::span(results).first(i);
    if (results[i] % length == 1) continue;  // the first of a chain
    const auto operand = std::ranges::find(before, results[i] - 1);
    ASSERT_NE(operand, before.end()) << "a sum comes before what it reads";
    EXPECT_GE(before.end() - operand, 4) << "position " << i;
  }
}

TEST(StepOrder, KeepsCopiesBehindTheirValues) {
  const std::vector<VectorStep> ordered = overlapping_order(chains_of_sums(5, 6), 31, 16);
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    if (ordered[i].operation != VectorOperation::copy) continue;
    ASSERT_GT(i, 0U);
    EXPECT_EQ(ordered[i].left, ordered[i - 1].result);
  }
}

TEST(StepOrder, StaysThatOfTheScheduleWhereRegistersAreFew) {
  const std::vector<VectorStep> steps = chains_of_sums(5, 6);
  EXPECT_EQ(results_of(overlapping_order(steps, 31, 4)), results_of(steps));
}

TEST(RegisterAllocation, LoadsConstantsOnceWhereRegistersAreLeft) {
  const Schedule schedule(ExpressionVector{{2.0 * Expression::input(0) + 3.0}});
  TapeSeries table{std::vector<std::uint32_t>(schedule.steps().size()), 3, 4};
  for (std::uint32_t i = 0, next = 0; i < schedule.steps().size(); ++i) {
    if (operand_count(schedule.steps()[i].operation) == 0) table.of_steps[i] = next++;
  }
  const NativePlan plan = native_plan(schedule, table);
  const auto loads = [](const std::vector<MachineStep>& steps) {
    return std::ranges::count_if(steps, [](const MachineStep& step) {
      return step.left.kind == OperandPlace::Kind::constant || step.right.kind == OperandPlace::Kind::constant;
    });
  };
  const MachineSteps roomy = allocate_registers(plan.stages.front(), plan.homes, 16);
  EXPECT_EQ(loads(roomy.once), 2);
  EXPECT_EQ(loads(roomy.steps), 0);
}

TEST(LateCode, IsMadeOnceEnoughIntervalsHaveBeenEvaluatedAndChangesNoValue) {
  const Schedule schedule = crowded_formulas();
  const Tape tape(schedule, preferred_instruction_set(), NativeCodeUse::when_worthwhile);
  const std::uint64_t worthwhile = LateCode::worthwhile_intervals(schedule.operation_count());
  constexpr std::size_t count = 1000;
  RandomPoints random;
  const SeriesTable inputs = random_inputs(random, 4, count, 0.5, 1.5);
  const SeriesTable first = tests::evaluate(tape, inputs, count);
  EXPECT_FALSE(tape.is_native());
  for (std::uint64_t evaluated = count; evaluated < worthwhile; evaluated += count) {
    expect_same(tests::evaluate(tape, inputs, count), first);
  }
  EXPECT_EQ(tape.is_native(), has_native_code(preferred_instruction_set()));
  expect_same(tests::evaluate(tape, inputs, count), first);
  const Tape copy = tape;  // NOLINT(performance-unnecessary-copy-initialization): it is what is tested
  EXPECT_EQ(copy.is_native(), tape.is_native());
}

TEST(LateCode, IsMadeWhileThreadsEvaluateTheTape) {
  const Schedule schedule = crowded_formulas();
  const Tape tape(schedule, preferred_instruction_set(), NativeCodeUse::when_worthwhile);
  const std::uint64_t worthwhile = LateCode::worthwhile_intervals(schedule.operation_count());
  constexpr std::size_t count = 500;
  RandomPoints random;
  const SeriesTable inputs = random_inputs(random, 4, count, 0.5, 1.5);
  const SeriesTable alone =
      tests::evaluate(Tape(schedule, preferred_instruction_set(), NativeCodeUse::never), inputs, count);
  std::vector<SeriesTable> found(4);
  std::vector<std::thread> threads;
  threads.reserve(found.size());
  for (SeriesTable& result : found) {
    threads.emplace_back([&] {
      for (std::uint64_t evaluated = 0; evaluated < worthwhile; evaluated += count) {
        result = tests::evaluate(tape, inputs, count);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(tape.is_native(), has_native_code(preferred_instruction_set()));
  for (const SeriesTable& result : found) expect_same(result, alone);
}

TEST(LateCode, IsNotMadeOfTapesThatAreTooLong) {
  const ExpressionVector x = input_vector(0, 1);
  std::vector<Expression> outputs{x[0]};
  for (std::size_t i = 0; i < LateCode::most_operations; ++i) outputs.push_back(outputs.back() * x[0]);
  const auto is_native = [&](std::size_t operations) {
    return Tape(Schedule(std::span(outputs).first(operations + 1)), preferred_instruction_set(), NativeCodeUse::always)
        .is_native();
  };
  EXPECT_EQ(is_native(100), has_native_code(preferred_instruction_set()));
  outputs.push_back(outputs.back() * x[0]);
  EXPECT_FALSE(is_native(LateCode::most_operations + 1));
}

}  // namespace
}  // namespace dmocbench
