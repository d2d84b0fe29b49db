#include "bench/speed/adolc_hessian.hpp"
#include "bench/speed/agreement.hpp"
#include "bench/speed/benchmark_name.hpp"
#include "bench/speed/benchmarks.hpp"

namespace dmocbench::speed {

namespace {

void register_hessian(const std::string& quantity, short tag, const Subject& subject, std::size_t intervals) {
  const Schedule lagrangian = lagrangian_of(subject.functions());
  const auto adolc = std::make_shared<AdolcHessian>(tag, lagrangian, subject.functions().inputs, intervals);
  require_agreement(subject, subject.functions().hessian.schedule, "ADOL-C", [&](std::size_t interval) {
    if (interval % intervals == 0) adolc->evaluate(subject, interval);
    const LocalMatrix& hessian = subject.functions().hessian;
    std::vector<double> entries;
    for (std::size_t e = 0; e < hessian.rows.size(); ++e) {
      entries.push_back(adolc->entry(interval % intervals, hessian.rows[e], hessian.columns[e]));
    }
    return entries;
  });
  const BenchmarkName name{.way = "adolc", .quantity = quantity, .problem = subject.problem()};
  const std::size_t operations = lagrangian.operation_count();
  benchmark::RegisterBenchmark(name.text().c_str(), [&subject, adolc, operations](benchmark::State& state) {
    for ([[maybe_unused]] auto turn : state) {
      for (std::size_t k = 0; k < Subject::intervals; k += adolc->intervals()) {
        adolc->evaluate(subject, k);
        benchmark::ClobberMemory();
      }
    }
    count_intervals(state, {.operations = operations});
  });
}

}  // namespace

void register_adolc_benchmarks(const Subjects& subjects) {
  short tag = 0;
  for (const auto& subject : subjects) register_hessian("hessian", tag++, *subject, 1);
  for (const auto& subject : subjects) register_hessian("hessian_block", tag++, *subject, 64);
}

}  // namespace dmocbench::speed
