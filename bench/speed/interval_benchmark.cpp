#include "bench/speed/interval_benchmark.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "methods/error.hpp"

namespace dmocbench::speed {

namespace {

/// Columns of doubles that a schedule reads. A column shared by neighbouring intervals (the right end of one is the
/// left end of the next) stands in one array and counts once; a value shared by all intervals does not count.
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

std::string benchmark_name(const IntervalBenchmark& benchmark) {
  const Formulas& formulas = benchmark.formulas;
  std::string name = fmt::format("{}/{}/{}", benchmark.way, benchmark.quantity, formulas.problem);
  if (formulas.links > 0) name += fmt::format("_{}", formulas.links);
  if (benchmark.names_method) name += fmt::format("/{}/gauss_{}", formulas.method, formulas.stages);
  if (!benchmark.instruction_set.empty()) name += "/" + benchmark.instruction_set;
  return name;
}

/// The keys are columns of the table of `bench/speed/page`.
std::string label_of(const IntervalBenchmark& benchmark) {
  const Formulas& formulas = benchmark.formulas;
  std::string label = fmt::format("way={} quantity={} problem={} method={} tableau=gauss stages={} intervals={}",
                                  benchmark.way, benchmark.quantity, formulas.problem, formulas.method, formulas.stages,
                                  BenchmarkedFormulas::intervals);
  if (formulas.links > 0) label += fmt::format(" links={}", formulas.links);
  if (!benchmark.instruction_set.empty()) label += " instruction_set=" + benchmark.instruction_set;
  return label;
}

/// Memory for columns of one number per interval.
///
/// Columns begin with a cache line, but not a power of two apart: otherwise they would compete for the same few lines
/// of the first-level cache. (In a program they stand where the pattern has them.)
class AlignedSeries {
 public:
  explicit AlignedSeries(std::size_t count) : lines_(count * stride) {
    for (std::size_t j = 0; j < count; ++j) columns_.push_back(lines_[j * stride].numbers.data());
  }

  [[nodiscard]] std::span<double* const> columns() const noexcept { return columns_; }
  /// The numbers of one interval.
  [[nodiscard]] std::vector<double> row(std::size_t interval) const {
    std::vector<double> numbers;
    numbers.reserve(columns_.size());
    for (const double* column : columns_) numbers.push_back(column[interval]);
    return numbers;
  }

 private:
  static constexpr std::size_t stride =
      (BenchmarkedFormulas::intervals + Tape::block_width) / CacheLine{}.numbers.size();
  std::vector<CacheLine> lines_;
  std::vector<double*> columns_;
};

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

void register_benchmark(const IntervalBenchmark& measured, std::function<Evaluation()> make) {
  const auto run = [label = label_of(measured), make = std::move(make)](benchmark::State& state) {
    const auto [evaluate, work] = make();
    for ([[maybe_unused]] auto turn : state) {
      evaluate();
      benchmark::ClobberMemory();
    }
    using benchmark::Counter;
    constexpr std::int64_t intervals = BenchmarkedFormulas::intervals;
    constexpr double nanosecond = 1e-9;
    state.SetItemsProcessed(state.iterations() * intervals);
    state.counters["ns_per_interval"] =
        Counter(intervals * nanosecond, Counter::kIsIterationInvariantRate | Counter::kInvert);
    state.counters["operations"] = static_cast<double>(work.operations);
    if (work.bytes > 0.0) state.counters["bytes"] = work.bytes;
    state.SetLabel(label);
  };
  benchmark::RegisterBenchmark(benchmark_name(measured).c_str(), run);
}

void register_benchmark(const IntervalBenchmark& measured, const Evaluation& evaluation) {
  register_benchmark(measured, std::function([evaluation] { return evaluation; }));
}

ColumnWriter by_tape(const BenchmarkedFormulas& point, const Schedule& schedule, InstructionSet set) {
  const auto tape = std::make_shared<Tape>(schedule, set);
  const auto workspace = std::make_shared<Tape::Workspace>(*tape);
  return [&point, tape, workspace](std::span<double* const> outputs) {
    tape->evaluate(BenchmarkedFormulas::intervals, point.columns(), outputs, *workspace);
  };
}

Evaluation checked_evaluation(const BenchmarkedFormulas& point, const Schedule& schedule, const std::string& name,
                              const ColumnWriter& write, double tolerance) {
  const auto outputs = std::make_shared<AlignedSeries>(schedule.outputs().size());
  const auto evaluate = [write, outputs] { write(outputs->columns()); };
  evaluate();
  require_agreement(
      point, schedule, name, [&](std::size_t interval) { return outputs->row(interval); }, tolerance);
  return {evaluate, work_of(schedule, point)};
}

void register_quantities(IntervalBenchmark benchmark, const BenchmarkedFormulas& point,
                         const std::function<ColumnWriter(std::size_t i)>& writer, double tolerance) {
  std::vector<Evaluation> all;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    benchmark.quantity = quantities[i];
    const std::string name =
        fmt::format("{} by {} on {}", benchmark.quantity, benchmark.way, benchmark.instruction_set);
    all.push_back(checked_evaluation(point, *point.schedules()[i], name, writer(i), tolerance));
    register_benchmark(benchmark, all.back());
  }
  benchmark.quantity = "separate";
  register_benchmark(benchmark, one_by_one(all));
}

void require_agreement(const BenchmarkedFormulas& point, const Schedule& schedule, const std::string& name,
                       const std::function<std::vector<double>(std::size_t interval)>& values, double tolerance) {
  AlignedSeries outputs(schedule.outputs().size());
  by_tape(point, schedule, preferred_instruction_set())(outputs.columns());
  for (std::size_t k = 0; k < BenchmarkedFormulas::intervals; ++k) {
    const std::vector<double> expected = outputs.row(k);
    const std::vector<double> found = values(k);
    const auto size = static_cast<Eigen::Index>(expected.size());
    const Eigen::Map<const Eigen::ArrayXd> of_tape(expected.data(), size);
    const double largest = of_tape.abs().maxCoeff();
    const double difference =
        (Eigen::Map<const Eigen::ArrayXd>(found.data(), size) - of_tape).abs().maxCoeff<Eigen::PropagateNaN>();
    if (difference <= tolerance * largest) continue;  // false for NaN
    throw Error("{} differs from the tape by {:.3g} on interval {} of {}", name, difference / largest, k,
                point.formulas().problem);
  }
}

}  // namespace dmocbench::speed
