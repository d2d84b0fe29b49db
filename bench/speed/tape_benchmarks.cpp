#include "bench/speed/agreement.hpp"
#include "bench/speed/benchmark_name.hpp"
#include "bench/speed/benchmarks.hpp"
#include "bench/speed/tape_run.hpp"

namespace dmocbench::speed {

namespace {

/// Tapes carried out one after the other, and the work of all.
struct Passes {
  std::vector<std::shared_ptr<TapeRun>> tapes;
  Work work;
};

Passes after(Passes first, const Passes& second) {
  first.tapes.insert(first.tapes.end(), second.tapes.begin(), second.tapes.end());
  first.work += second.work;
  return first;
}

void register_passes(const std::string& quantity, const Subject& subject, InstructionSet set, const Passes& passes) {
  const BenchmarkName name{
      .way = "tape", .quantity = quantity, .problem = subject.problem(), .instruction_set = std::string(name_of(set))};
  benchmark::RegisterBenchmark(name.text().c_str(), [&subject, passes](benchmark::State& state) {
    for ([[maybe_unused]] auto turn : state) {
      for (const auto& tape : passes.tapes) tape->evaluate(subject.columns());
      benchmark::ClobberMemory();
    }
    count_intervals(state, passes.work);
  });
}

void require_hessian(const Subject& subject, InstructionSet set, TapeRun& hessian) {
  hessian.evaluate(subject.columns());
  require_agreement(subject, subject.functions().hessian.schedule, "the tape on " + std::string(name_of(set)),
                    [&](std::size_t interval) { return hessian.outputs().row(interval); });
}

}  // namespace

void register_tape_benchmarks(const Subjects& subjects) {
  for (const auto& subject : subjects) {
    const IntervalFunctions& functions = subject->functions();
    for (const InstructionSet set : available_instruction_sets()) {
      const auto pass = [&](const Schedule& schedule) {
        return Passes{{std::make_shared<TapeRun>(schedule, set, Subject::intervals)}, work_of(schedule, *subject)};
      };
      const Passes residual = pass(functions.rows.schedule);
      const Passes jacobian = pass(functions.jacobian.schedule);
      const Passes hessian = pass(functions.hessian.schedule);
      require_hessian(*subject, set, *hessian.tapes.front());
      register_passes("residual", *subject, set, residual);
      register_passes("jacobian", *subject, set, jacobian);
      register_passes("hessian", *subject, set, hessian);
      register_passes("separate", *subject, set, after(after(residual, jacobian), hessian));
      register_passes("fused", *subject, set, pass(fused(functions)));
    }
  }
}

}  // namespace dmocbench::speed
