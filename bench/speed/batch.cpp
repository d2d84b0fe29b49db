// Many instances of one program: the batch in lanes, on one thread and on all, against loops over single solvers.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/experiment/solve_case.hpp"
#include "bench/speed/benchmark_program.hpp"
#include "methods/numerics/median.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/batch/instance_program.hpp"
#include "methods/solvers/batch/solve_batch.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/lane_transcription.hpp"
#include "methods/transcription/start.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

constexpr int intervals = 64;
constexpr std::size_t most_instances = 4096;

/// A program and its instances: every component of the states at both ends drawn uniformly within 10 % of its value, or
/// of the way from end to end where that is 0. Cold ones start at the guess of the problem, warm ones at the motion and
/// with the multipliers of the problem itself, which is solved before; both moved with the ends (`ClampedEnds`).
class Instances {
 public:
  Instances(const std::string& name, bool is_warm) : problem_(make_problem(name)) {
    program_ =
        Case{.problem = problem_, .method = "dmoc", .tableau = "gauss", .grid = Grid::uniform(intervals)}.transcribe();
    start_ = sample(*program_, guessed_motion(*problem_));
    ends_ = std::make_unique<ClampedEnds>(*program_);
    if (is_warm) {
      const Solution neighbour = make_solver("interior_point")->solve(*program_, start_);
      start_ = neighbour.primal;
      multipliers_ = neighbour.multipliers;
    }
    for (std::size_t i = 0; i < most_instances; ++i) states_.push_back({moved(true), moved(false)});
  }

  [[nodiscard]] Transcription& program() { return *program_; }
  [[nodiscard]] const Eigen::VectorXd& start() const { return start_; }
  void fill(std::size_t index, BatchInstance& instance) {
    instance.start = start_;
    instance.rows = program_->constraint_lower();
    instance.multipliers = multipliers_;
    ends_->write(states_[index].first, states_[index].last, instance.start, instance.rows);
  }

 private:
  struct Ends {
    BoundaryState first;
    BoundaryState last;
  };

  BoundaryState moved(bool is_first) {
    const BoundaryState first = problem_->initial_state();
    const BoundaryState last = problem_->final_state();
    BoundaryState end = is_first ? first : last;
    for (const auto part : {&BoundaryState::q, &BoundaryState::v}) {
      for (Eigen::Index i = 0; i < end.q.size(); ++i) {
        double& value = (end.*part)[i];
        const double size = value != 0.0 ? value : (last.*part)[i] - (first.*part)[i];
        constexpr double share = 0.1;
        const double unit = static_cast<double>(engine_()) / 4294967296.0;  // the same numbers everywhere
        value += share * (2.0 * unit - 1.0) * std::abs(size);
      }
    }
    return end;
  }

  std::shared_ptr<const Problem> problem_;
  std::unique_ptr<Transcription> program_;
  std::unique_ptr<ClampedEnds> ends_;
  Eigen::VectorXd start_;
  Eigen::VectorXd multipliers_;
  std::vector<Ends> states_;
  std::mt19937 engine_{20090101U};
};

/// A way to solve them, or to fill them only.
struct Way {
  std::string problem;
  bool is_warm = false;
  std::string name;  ///< batch, fill, or a solver, called in a loop
  std::size_t threads = 1;
  std::size_t instances = most_instances;
};

/// What was found out.
struct Tally {
  std::vector<double> iterations;
  double solved = 0.0;
  double one_by_one = 0.0;

  void add(const Solution& solution) {
    iterations.push_back(solution.major_iterations.value_or(0));
    solved += is_solved(solution.status) ? 1.0 : 0.0;
  }
};

void solve_in_lanes(Instances& instances, const Way& way, Tally& tally) {
  BatchOptions options;
  options.threads = way.threads;
  const BatchSummary summary = solve_batch(
      instances.program(), lanes_of(instances.program()), instances.start(),
      [&](std::size_t index, BatchInstance& instance) {
        if (index < way.instances) instances.fill(index, instance);
        return index < way.instances;
      },
      [&](std::size_t, const Solution& solution) { tally.add(solution); }, options);
  tally.one_by_one = static_cast<double>(summary.solved_one_by_one);
}

void solve_in_a_loop(Instances& instances, const Way& way, Tally& tally) {
  BatchInstance instance;
  for (std::size_t i = 0; i < way.instances; ++i) {
    instances.fill(i, instance);
    if (way.name == "fill") continue;
    SolverOptions options;
    options.start_multipliers = instance.multipliers;
    batch::InstanceProgram alone(instances.program(), instance.start, instance.rows);
    tally.add(make_solver(way.name, options)->solve(alone, instance.start));
  }
}

/// Every turn solves all instances; its time is that of one of them.
void run(benchmark::State& state, const Way& way) {
  set_thread_count(1);
  Instances instances(way.problem, way.is_warm);
  Tally tally;
  for ([[maybe_unused]] auto turn : state) {
    tally = {};
    const auto begin = Clock::now();
    way.name == "batch" ? solve_in_lanes(instances, way, tally) : solve_in_a_loop(instances, way, tally);
    state.SetIterationTime(seconds_since(begin) / static_cast<double>(way.instances));
  }
  state.SetLabel(fmt::format("problem={} start={} way={} threads={} instances={}", way.problem,
                             way.is_warm ? "warm" : "cold", way.name, way.threads, way.instances));
  if (tally.iterations.empty()) return;
  const auto count = static_cast<double>(tally.iterations.size());
  state.counters["median_iterations"] = median(tally.iterations);
  state.counters["solved"] = tally.solved / count;
  state.counters["one_by_one"] = tally.one_by_one / count;
}

/// PROBLEM/START/WAY/threads_COUNT
void add(const Way& way) {
  const std::string name =
      fmt::format("{}/{}/{}/threads_{}", way.problem, way.is_warm ? "warm" : "cold", way.name, way.threads);
  add_benchmark(name, benchmark::kMicrosecond, [way](benchmark::State& state) { run(state, way); })->Iterations(1);
}

void register_batches() {
  constexpr std::size_t of_interior_point = 256;
  constexpr std::size_t of_ipopt = 32;
  const std::size_t all_threads = thread_count();
  for (const std::string& problem : paper_problem_names()) {
    for (const bool is_warm : {false, true}) {
      const Way way{.problem = problem, .is_warm = is_warm, .name = "batch"};
      const auto variant = [&](const char* name, std::size_t threads, std::size_t instances) {
        add({.problem = problem, .is_warm = is_warm, .name = name, .threads = threads, .instances = instances});
      };
      add(way);
      if (all_threads > 1) variant("batch", all_threads, most_instances);
      variant("fill", 1, most_instances);
      variant("interior_point", 1, of_interior_point);
      variant("ipopt", 1, of_ipopt);
    }
  }
}

/// A row per benchmark, medians of the repetitions; `ratio` is how many times as long as one instance of the batch on
/// all threads it takes.
Table batch_table(const Benchmarks& benchmarks) {
  Table table({"problem", "start", "way", "threads", "instances", "repetitions", "seconds", "solves_per_second",
               "ratio", "median_iterations", "solved", "one_by_one"});
  std::map<std::string, double> fastest;  // per problem and start: of the batch
  const auto key = [](const Benchmark& of) { return of.label("problem") + of.label("start"); };
  const auto seconds = [](const Benchmark& of) { return 1e-9 * of.median_of("real_time").value_or(NAN); };
  for (const auto& [name, benchmark] : benchmarks) {
    if (benchmark.label("way") != "batch") continue;
    const auto [found, is_new] = fastest.emplace(key(benchmark), seconds(benchmark));
    if (!is_new) found->second = std::min(found->second, seconds(benchmark));
  }
  for (const auto& [name, benchmark] : benchmarks) {
    Row row;
    for (const char* label : {"problem", "start", "way", "threads", "instances"}) {
      row.set(label, benchmark.label(label));
    }
    row.set("repetitions", static_cast<int>(benchmark.numbers.at("real_time").size()));
    row.set("seconds", seconds(benchmark));
    if (benchmark.label("way") != "fill") row.set("solves_per_second", 1.0 / seconds(benchmark));
    if (fastest.contains(key(benchmark))) row.set("ratio", seconds(benchmark) / fastest.at(key(benchmark)));
    for (const char* counter : {"median_iterations", "solved", "one_by_one"}) {
      if (const auto value = benchmark.median_of(counter)) row.set(counter, *value);
    }
    table.append(std::move(row));
  }
  return table;
}

}  // namespace

}  // namespace dmocbench::speed

int main(int argc, char** argv) {
  using namespace dmocbench;         // NOLINT(google-build-using-namespace): the program's own
  using namespace dmocbench::speed;  // NOLINT(google-build-using-namespace)
  const BenchmarkProgram program{
      .name = "batch",
      .description = "Times per solve of many instances of a program: in lanes, and one by one.",
      .csv = "write FILE, a row per benchmark, with ratios to the batch on all threads",
      .default_filter = ".",
      .register_benchmarks = register_batches,
      .tables = [](const Benchmarks& benchmarks) -> TablesBySuffix {
        return {{"", batch_table(benchmarks)}};
      }};
  return program.run({argv, static_cast<std::size_t>(argc)});
}
