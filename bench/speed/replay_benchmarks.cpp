#include "bench/speed/agreement.hpp"
#include "bench/speed/benchmark_name.hpp"
#include "bench/speed/benchmarks.hpp"
#include "methods/expression/replay.hpp"

namespace dmocbench::speed {

namespace {

void register_replay(const std::string& quantity, const Subject& subject, const Schedule& schedule) {
  const BenchmarkName name{.way = "replay", .quantity = quantity, .problem = subject.problem()};
  benchmark::RegisterBenchmark(name.text().c_str(), [&subject, &schedule](benchmark::State& state) {
    for ([[maybe_unused]] auto turn : state) {
      for (std::size_t k = 0; k < Subject::intervals; ++k) {
        // The two vectors that a replay allocates are timed with it: it has no other form.
        benchmark::DoNotOptimize(replay<double>(schedule, subject.inputs_of(k)));
      }
    }
    count_intervals(state, {.operations = schedule.operation_count()});
  });
}

}  // namespace

void register_replay_benchmarks(const Subjects& subjects) {
  for (const auto& subject : subjects) {
    const IntervalFunctions& functions = subject->functions();
    require_agreement(*subject, functions.hessian.schedule, "replay", [&](std::size_t interval) {
      return replay<double>(functions.hessian.schedule, subject->inputs_of(interval));
    });
    register_replay("residual", *subject, functions.rows.schedule);
    register_replay("jacobian", *subject, functions.jacobian.schedule);
    register_replay("hessian", *subject, functions.hessian.schedule);
  }
}

}  // namespace dmocbench::speed
