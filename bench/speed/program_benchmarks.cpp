#include <memory>

#include <benchmark/benchmark.h>

#include "bench/speed/interval_benchmark.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

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
  // Made when it is first wanted: of some hundred benchmarks most are left out of a run.
  const auto point = std::make_shared<std::unique_ptr<BenchmarkedFormulas>>();
  const auto evaluate = [point, formulas](std::size_t quantity) {
    if (!*point) *point = std::make_unique<BenchmarkedFormulas>(formulas);
    return evaluation_of(**point, quantity);
  };
  IntervalBenchmark what{.way = "program",
                         .formulas = formulas,
                         .names_method = true,
                         .instruction_set = std::string(name_of(preferred_instruction_set()))};
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    what.quantity = quantities[i];
    register_benchmark(what, [evaluate, i] { return evaluate(i); });
  }
  what.quantity = "separate";
  register_benchmark(what, [evaluate] { return one_by_one({evaluate(0), evaluate(1), evaluate(2)}); });
}

}  // namespace

void register_program_benchmarks() {
  constexpr int most_stages = 3;
  constexpr int fewest_links = 2;
  constexpr int most_links = 8;
  for (const std::string& method : element_names()) {
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

}  // namespace dmocbench::speed
