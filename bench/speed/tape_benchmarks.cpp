#include "bench/speed/agreement.hpp"
#include "bench/speed/benchmarks.hpp"
#include "bench/speed/tape_run.hpp"

namespace dmocbench::speed {

namespace {

/// Tapes carried out one after the other.
using Passes = std::vector<std::shared_ptr<TapeRun>>;

void register_passes(const std::string& quantity, const Subject& subject, InstructionSet set, const Passes& passes) {
  const std::string name = "tape/" + quantity + "/" + subject.problem() + "/" + std::string(name_of(set));
  benchmark::RegisterBenchmark(name.c_str(), [&subject, passes](benchmark::State& state) {
    for ([[maybe_unused]] auto turn : state) {
      for (const auto& pass : passes) pass->evaluate(subject.columns());
      benchmark::ClobberMemory();
    }
    std::size_t operations = 0;
    for (const auto& pass : passes) operations += pass->tape().operation_count();
    count_intervals(state, operations);
  });
}

void require_hessian(const Subject& subject, InstructionSet set, TapeRun& hessian) {
  hessian.evaluate(subject.columns());
  require_agreement(subject, "the tape on " + std::string(name_of(set)), [&](std::size_t interval) {
    std::vector<double> entries;
    for (std::size_t e = 0; e < hessian.tape().output_count(); ++e) entries.push_back(hessian.value(interval, e));
    return entries;
  });
}

}  // namespace

void register_tape_benchmarks(const Subjects& subjects) {
  for (const auto& subject : subjects) {
    const IntervalFunctions& functions = subject->functions();
    for (const InstructionSet set : available_instruction_sets()) {
      const auto make = [&](const Schedule& schedule) {
        return std::make_shared<TapeRun>(schedule, set, Subject::intervals);
      };
      const auto residual = make(functions.rows.schedule);
      const auto jacobian = make(functions.jacobian.schedule);
      const auto hessian = make(functions.hessian.schedule);
      require_hessian(*subject, set, *hessian);
      register_passes("residual", *subject, set, {residual});
      register_passes("jacobian", *subject, set, {jacobian});
      register_passes("hessian", *subject, set, {hessian});
      register_passes("separate", *subject, set, {residual, jacobian, hessian});
      register_passes("fused", *subject, set, {make(fused(functions))});
    }
  }
}

}  // namespace dmocbench::speed
