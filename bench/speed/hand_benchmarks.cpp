#include <algorithm>
#include <utility>

#include "bench/speed/agreement.hpp"
#include "bench/speed/benchmark_name.hpp"
#include "bench/speed/benchmarks.hpp"
#include "bench/speed/interval_columns.hpp"
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

/// A function written by hand with its inputs and with memory for its outputs, as `TapeRun` has it.
class HandRun {
 public:
  HandRun(HandKernel kernel, Subject& subject, std::size_t outputs)
      : kernel_(kernel),
        factor_(Subject::objective_factor * subject.program().cost_scale()),
        outputs_(outputs, Subject::intervals) {
    for (const Tape::Input& input : subject.columns()) inputs_.push_back(input.data);
  }

  void evaluate() const {
    kernel_(Subject::intervals, {.in = inputs_.data(), .factor = factor_, .out = outputs_.columns().data()});
  }
  [[nodiscard]] const IntervalColumns& outputs() const noexcept { return outputs_; }

 private:
  HandKernel kernel_;
  double factor_;
  std::vector<const double*> inputs_;
  IntervalColumns outputs_;
};

using HandRuns = std::vector<std::shared_ptr<HandRun>>;

void register_runs(const std::string& quantity, const std::string& problem, InstructionSet set, const HandRuns& runs,
                   const Work& work) {
  const BenchmarkName name{
      .way = "hand", .quantity = quantity, .problem = problem, .instruction_set = std::string(name_of(set))};
  benchmark::RegisterBenchmark(name.text().c_str(), [runs, work](benchmark::State& state) {
    for ([[maybe_unused]] auto turn : state) {
      for (const auto& run : runs) run->evaluate();
      benchmark::ClobberMemory();
    }
    count_intervals(state, work);
  });
}

void register_problem(Subject& subject, InstructionSet set) {
  const HandFunctions by_hand = hand_written(subject.problem(), set);
  const IntervalFunctions& functions = subject.functions();
  HandRuns all;
  Work work_of_all;
  const auto add = [&](const std::string& quantity, HandKernel kernel, const Schedule& schedule) {
    const auto run = std::make_shared<HandRun>(kernel, subject, schedule.outputs().size());
    run->evaluate();
    constexpr double rounding = 1e-12;
    require_agreement(
        subject, schedule, quantity + " by hand on " + std::string(name_of(set)),
        [&](std::size_t interval) { return run->outputs().row(interval); }, rounding);
    // Operations of the tape's formulas: those of the loops are the compiler's affair.
    const Work work = work_of(schedule, subject);
    register_runs(quantity, subject.problem(), set, {run}, work);
    all.push_back(run);
    work_of_all += work;
  };
  add("residual", by_hand.residual, functions.rows.schedule);
  add("jacobian", by_hand.jacobian, functions.jacobian.schedule);
  add("hessian", by_hand.hessian, functions.hessian.schedule);
  register_runs("separate", subject.problem(), set, all, work_of_all);
}

}  // namespace

void register_hand_benchmarks(const Subjects& subjects) {
  for (const auto& subject : subjects) {
    for (const InstructionSet set : available_instruction_sets()) register_problem(*subject, set);
  }
}

}  // namespace dmocbench::speed
