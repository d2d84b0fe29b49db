// Formulas of an interval by bare tapes, number by number, in the assembled program and written by hand.
#include <memory>

#include <benchmark/benchmark.h>

#include "bench/speed/interval_benchmark.hpp"
#include "bench/speed/kernels.hpp"
#include "methods/error.hpp"
#include "methods/expression/replay.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// The tapes of residual, Jacobian and Hessian, and one tape for the three.
void register_tapes(const BenchmarkedFormulas& point, InstructionSet set) {
  const std::string name(name_of(set));
  IntervalBenchmark benchmark{.way = "tape", .formulas = point.formulas(), .instruction_set = name};
  register_quantities(benchmark, point, [&](std::size_t i) { return by_tape(point, *point.schedules()[i], set); });
  const Schedule all = fused(point);
  benchmark.quantity = "fused";
  register_benchmark(benchmark, checked_evaluation(point, all, "the tape on " + name, by_tape(point, all, set)));
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

/// Evaluations of the assembled program, in the order of `quantities`.
Evaluation evaluation_of(BenchmarkedFormulas& point, std::size_t quantity) {
  Transcription& program = point.program();
  const std::array sizes{program.constraint_count(), program.jacobian_structure().size(),
                         program.hessian_structure().size()};
  const auto result = std::make_shared<Eigen::VectorXd>(static_cast<Eigen::Index>(sizes[quantity]));
  const auto evaluate = [&point, &program, quantity, result] {
    if (quantity == 0) program.constraints(point.x(), *result);
    if (quantity == 1) program.jacobian(point.x(), *result);
    if (quantity == 2) {
      program.hessian(point.x(), BenchmarkedFormulas::objective_factor, point.multipliers(), *result);
    }
    benchmark::DoNotOptimize(result->data());
  };
  const double written = static_cast<double>(sizes[quantity]) / static_cast<double>(BenchmarkedFormulas::intervals);
  return {evaluate, work_of(*point.schedules()[quantity], point, written)};
}

void register_formulas(const Formulas& formulas) {
  // Made when it is first needed: of some hundred benchmarks most are left out of a run.
  const auto point = std::make_shared<std::unique_ptr<BenchmarkedFormulas>>();
  const auto evaluate = [point, formulas](std::size_t quantity) {
    if (!*point) *point = std::make_unique<BenchmarkedFormulas>(formulas);
    return evaluation_of(**point, quantity);
  };
  IntervalBenchmark benchmark{.way = "program",
                              .formulas = formulas,
                              .names_method = true,
                              .instruction_set = std::string(name_of(preferred_instruction_set()))};
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    benchmark.quantity = quantities[i];
    register_benchmark(benchmark, [evaluate, i] { return evaluate(i); });
  }
  benchmark.quantity = "separate";
  register_benchmark(benchmark, [evaluate] { return one_by_one({evaluate(0), evaluate(1), evaluate(2)}); });
}

HandFunctions hand_written(const std::string& problem, InstructionSet set) {
  const Kernels kernels = kernels_of(set);
  if (problem == "orbital_transfer") return kernels.orbital_transfer;
  if (problem == "two_link_manipulator") return kernels.two_link_manipulator;
  throw Error("there are no handwritten formulas for " + problem);
}

}  // namespace

void register_expression_benchmarks(const FormulasOfPaper& paper) {
  for (const auto& point : paper) {
    for (const InstructionSet set : available_instruction_sets()) register_tapes(*point, set);
    register_replays(*point);
  }
}

void register_program_benchmarks() {
  constexpr int most_stages = 3;
  constexpr int fewest_links = 2;
  constexpr int most_links = 8;
  for (const std::string& method : paper_families()) {
    for (int stages = 1; stages <= most_stages; ++stages) {
      for (const std::string& problem : paper_problem_names()) {
        register_formulas({.problem = problem, .method = method, .stages = stages});
      }
      for (int links = fewest_links; links <= most_links; ++links) {
        register_formulas({.problem = "link_chain", .links = links, .method = method, .stages = stages});
      }
    }
  }
}

void register_hand_benchmarks(const FormulasOfPaper& paper) {
  constexpr double rounding = 1e-12;
  for (const auto& point : paper) {
    const double factor = BenchmarkedFormulas::objective_factor * point->program().cost_scale();
    std::vector<const double*> inputs;
    for (const Tape::Input& input : point->columns()) inputs.push_back(input.data);
    for (const InstructionSet set : available_instruction_sets()) {
      const HandFunctions by_hand = hand_written(point->formulas().problem, set);
      const auto writer = [&](std::size_t i) -> ColumnWriter {
        return [kernel = by_hand[i], factor, inputs](std::span<double* const> outputs) {
          kernel(BenchmarkedFormulas::intervals, {.in = inputs.data(), .factor = factor, .out = outputs.data()});
        };
      };
      // Operations are the tape's: the ones that the compiler makes of the loops are not counted.
      register_quantities({.way = "hand", .formulas = point->formulas(), .instruction_set = std::string(name_of(set))},
                          *point, writer, rounding);
    }
  }
}

}  // namespace dmocbench::speed
