#include "bench/speed/interval_benchmark.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/speed/interval_tables.hpp"
#include "methods/error.hpp"

namespace dmocbench::speed {

namespace {

/// Columns of doubles that a schedule reads. What neighbouring intervals share (the right end of one is the left end of
/// the next) stands in one array and counts once; what is the same for all intervals does not count.
std::size_t arrays_read(const Schedule& schedule, std::span<const Tape::Input> columns) {
  std::vector<const double*> begins;
  for (const Schedule::Step& step : schedule.steps()) {
    if (step.operation != Operation::input || columns[step.input_index].same_for_all) continue;
    begins.push_back(columns[step.input_index].data);
  }
  std::ranges::sort(begins);
  // Left and right ends stand in one array, an entry apart.
  const auto is_neighbour = [](const double* left, const double* right) { return right - left <= 1; };
  return static_cast<std::size_t>(std::unique(begins.begin(), begins.end(), is_neighbour) - begins.begin());
}

std::string benchmark_name(const IntervalBenchmark& what) {
  const Formulas& formulas = what.formulas;
  std::string name = fmt::format("{}/{}/{}", what.way, what.quantity, formulas.problem);
  if (formulas.links > 0) name += fmt::format("_{}", formulas.links);
  if (what.names_method) name += fmt::format("/{}/gauss_{}", formulas.method, formulas.stages);
  if (!what.instruction_set.empty()) name += "/" + what.instruction_set;
  return name;
}

/// The keys are columns of `interval_table`.
std::string label_of(const IntervalBenchmark& what) {
  const Formulas& formulas = what.formulas;
  std::string label =
      fmt::format("way={} quantity={} problem={} method={} tableau=gauss stages={} intervals={}", what.way,
                  what.quantity, formulas.problem, formulas.method, formulas.stages, BenchmarkedFormulas::intervals);
  if (formulas.links > 0) label += fmt::format(" links={}", formulas.links);
  if (!what.instruction_set.empty()) label += " instruction_set=" + what.instruction_set;
  return label;
}

}  // namespace

Work work_of(const Schedule& schedule, const BenchmarkedFormulas& point, std::optional<double> numbers_written) {
  const auto read = static_cast<double>(arrays_read(schedule, point.columns()));
  const double written = numbers_written.value_or(static_cast<double>(schedule.outputs().size()));
  return {.operations = schedule.operation_count(), .bytes = sizeof(double) * (read + written)};
}

Evaluation one_by_one(const std::vector<Evaluation>& evaluations) {
  Evaluation all{.evaluate = [evaluations] {
    for (const Evaluation& each : evaluations) each.evaluate();
  }};
  for (const Evaluation& each : evaluations) {
    all.work.operations += each.work.operations;
    all.work.bytes += each.work.bytes;
  }
  return all;
}

void register_benchmark(const IntervalBenchmark& what, std::function<Evaluation()> make) {
  const auto run = [label = label_of(what), make = std::move(make)](benchmark::State& state) {
    const auto [evaluate, work] = make();
    for ([[maybe_unused]] auto turn : state) {
      evaluate();
      benchmark::ClobberMemory();
    }
    using benchmark::Counter;
    constexpr std::int64_t intervals = BenchmarkedFormulas::intervals;
    constexpr double nanosecond = 1e-9;
    state.SetItemsProcessed(state.iterations() * intervals);
    state.counters[ns_per_interval] =
        Counter(intervals * nanosecond, Counter::kIsIterationInvariantRate | Counter::kInvert);
    state.counters[operations_per_interval] = static_cast<double>(work.operations);
    if (work.bytes > 0.0) state.counters[bytes_per_interval] = work.bytes;
    state.SetLabel(label);
  };
  benchmark::RegisterBenchmark(benchmark_name(what).c_str(), run);
}

void register_benchmark(const IntervalBenchmark& what, const Evaluation& evaluation) {
  register_benchmark(what, std::function([evaluation] { return evaluation; }));
}

void require_agreement(const BenchmarkedFormulas& point, const Schedule& schedule, const std::string& name,
                       const std::function<std::vector<double>(std::size_t interval)>& values, double tolerance) {
  TapeRun reference(schedule, preferred_instruction_set());
  reference.evaluate(point.columns());
  for (std::size_t k = 0; k < BenchmarkedFormulas::intervals; ++k) {
    const std::vector<double> expected = reference.row(k);
    const std::vector<double> found = values(k);
    const auto size = static_cast<Eigen::Index>(expected.size());
    const Eigen::Map<const Eigen::ArrayXd> of_tape(expected.data(), size);
    const Eigen::Map<const Eigen::ArrayXd> here(found.data(), size);
    const double largest = of_tape.abs().maxCoeff();
    const double difference = (here - of_tape).abs().maxCoeff<Eigen::PropagateNaN>();
    if (difference <= tolerance * largest) continue;  // false for NaN
    throw Error(fmt::format("{} differs from the tape by {:.3g} on interval {} of {}", name, difference / largest, k,
                            point.formulas().problem));
  }
}

}  // namespace dmocbench::speed
