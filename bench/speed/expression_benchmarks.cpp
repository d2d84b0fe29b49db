#include <memory>

#include <benchmark/benchmark.h>

#include "bench/speed/interval_benchmark.hpp"
#include "methods/expression/replay.hpp"

namespace dmocbench::speed {

namespace {

void register_tapes(const BenchmarkedFormulas& point, InstructionSet set) {
  IntervalBenchmark what{.way = "tape", .formulas = point.formulas(), .instruction_set = std::string(name_of(set))};
  const auto by_tape = [&](const Schedule& schedule, const std::shared_ptr<TapeRun>& tape) {
    return Evaluation{[&point, tape] { tape->evaluate(point.columns()); }, work_of(schedule, point)};
  };
  std::vector<Evaluation> all;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const Schedule& schedule = *point.schedules()[i];
    const auto tape = std::make_shared<TapeRun>(schedule, set);
    tape->evaluate(point.columns());
    require_agreement(point, schedule, "the tape on " + what.instruction_set,
                      [&](std::size_t interval) { return tape->row(interval); });
    what.quantity = quantities[i];
    register_benchmark(what, all.emplace_back(by_tape(schedule, tape)));
  }
  what.quantity = "separate";
  register_benchmark(what, one_by_one(all));
  what.quantity = "fused";
  const Schedule schedule = fused(point);
  register_benchmark(what, by_tape(schedule, std::make_shared<TapeRun>(schedule, set)));
}

void register_replays(const BenchmarkedFormulas& point) {
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const Schedule& schedule = *point.schedules()[i];
    require_agreement(point, schedule, "replay",
                      [&](std::size_t interval) { return replay<double>(schedule, point.inputs_of(interval)); });
    const auto evaluate = [&point, &schedule] {
      for (std::size_t k = 0; k < BenchmarkedFormulas::intervals; ++k) {
        // The two vectors that a replay allocates are timed with it: it has no other form.
        benchmark::DoNotOptimize(replay<double>(schedule, point.inputs_of(k)));
      }
    };
    register_benchmark({.way = "replay", .quantity = quantities[i], .formulas = point.formulas()},
                       Evaluation{evaluate, {.operations = schedule.operation_count()}});
  }
}

}  // namespace

void register_expression_benchmarks(const FormulasOfPaper& paper) {
  for (const auto& point : paper) {
    for (const InstructionSet set : available_instruction_sets()) register_tapes(*point, set);
    register_replays(*point);
  }
}

}  // namespace dmocbench::speed
