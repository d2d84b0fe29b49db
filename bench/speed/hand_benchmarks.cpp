#include <memory>

#include "bench/speed/interval_benchmark.hpp"
#include "bench/speed/kernels.hpp"
#include "methods/error.hpp"

namespace dmocbench::speed {

namespace {

HandFunctions hand_written(const std::string& problem, InstructionSet set) {
  const Kernels kernels = kernels_of(set);
  if (problem == "orbital_transfer") return kernels.orbital_transfer;
  if (problem == "two_link_manipulator") return kernels.two_link_manipulator;
  throw Error("nobody wrote the formulas of " + problem + " by hand");
}

void register_problem(BenchmarkedFormulas& point, InstructionSet set) {
  constexpr double rounding = 1e-12;
  const HandFunctions by_hand = hand_written(point.formulas().problem, set);
  const double factor = BenchmarkedFormulas::objective_factor * point.program().cost_scale();
  std::vector<const double*> inputs;
  for (const Tape::Input& input : point.columns()) inputs.push_back(input.data);
  IntervalBenchmark what{.way = "hand", .formulas = point.formulas(), .instruction_set = std::string(name_of(set))};
  std::vector<Evaluation> all;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const Schedule& schedule = *point.schedules()[i];
    const auto outputs = std::make_shared<IntervalColumns>(schedule.outputs().size());
    const auto evaluate = [kernel = by_hand[i], factor, inputs, outputs] {
      kernel(BenchmarkedFormulas::intervals, {.in = inputs.data(), .factor = factor, .out = outputs->columns().data()});
    };
    evaluate();
    what.quantity = quantities[i];
    require_agreement(
        point, schedule, what.quantity + " by hand on " + what.instruction_set,
        [&](std::size_t interval) { return outputs->row(interval); }, rounding);
    // Operations are those of the tape's formulas: nobody counts what the compiler makes of the loops.
    register_benchmark(what, all.emplace_back(evaluate, work_of(schedule, point)));
  }
  what.quantity = "separate";
  register_benchmark(what, one_by_one(all));
}

}  // namespace

void register_hand_benchmarks(const FormulasOfPaper& paper) {
  for (const auto& point : paper) {
    for (const InstructionSet set : available_instruction_sets()) register_problem(*point, set);
  }
}

}  // namespace dmocbench::speed
