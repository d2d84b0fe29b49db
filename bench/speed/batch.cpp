// Many instances of one program: the batch in lanes, on one thread and on all, against loops over single solvers.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <iterator>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/run/uniform_01.hpp"
#include "bench/speed/benchmark_program.hpp"
#include "bench/speed/guessed_program.hpp"
#include "methods/numerics/quantile.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/batch/batch_source.hpp"
#include "methods/solvers/batch/solve_batch.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/lane_transcription.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

constexpr int intervals = 64;
constexpr std::size_t most_instances = 4096;

/// The kinds of starts; all starts are moved with their ends (`ClampedEnds`).
enum class StartKind : std::uint8_t {
  cold,     ///< at the guess of the problem
  warm,     ///< at the motion of the problem itself, which is solved before, with its multipliers
  nearest,  ///< at the motion of the nearest instance that is solved before, with its multipliers; the first are warm
};

std::string name_of(StartKind start) {
  return start == StartKind::cold ? "cold" : start == StartKind::warm ? "warm" : "nearest";
}

/// A program and its instances: every component of the states at both ends drawn uniformly within 10 % of its value, or
/// of the way from end to end where that is 0.
class Instances {
 public:
  Instances(const std::string& name, StartKind start) : made_(make_problem(name), "dmoc", intervals) {
    ends_ = std::make_unique<ClampedEnds>(*made_.program);
    if (start != StartKind::cold) {
      const Solution neighbour = make_solver("interior_point")->solve(*made_.program, made_.start);
      made_.start = neighbour.primal;
      multipliers_ = neighbour.multipliers;
    }
    for (std::size_t i = 0; i < most_instances; ++i) {
      units_.clear();
      const BoundaryState first = moved(true);
      const BoundaryState last = moved(false);
      states_.push_back({first, last, Eigen::Map<const Eigen::VectorXd>(units_.data(), std::ssize(units_))});
    }
  }

  [[nodiscard]] Transcription& program() const { return *made_.program; }
  [[nodiscard]] const Eigen::VectorXd& start() const { return made_.start; }
  /// The random numbers of an instance, between -1 and 1.
  [[nodiscard]] const Eigen::VectorXd& place(std::size_t index) const { return states_[index].place; }
  void fill(std::size_t index, BatchInstance& instance, const Solution* neighbour = nullptr) {
    instance.start = neighbour == nullptr ? made_.start : neighbour->primal;
    instance.equality_values = made_.program->constraint_lower();
    instance.multipliers = neighbour == nullptr ? multipliers_ : neighbour->multipliers;
    ends_->write(states_[index].first, states_[index].last, instance.start, instance.equality_values);
  }

 private:
  struct Ends {
    BoundaryState first;
    BoundaryState last;
    Eigen::VectorXd place;
  };

  BoundaryState moved(bool is_first) {
    const BoundaryState first = made_.problem->initial_state();
    const BoundaryState last = made_.problem->final_state();
    BoundaryState end = is_first ? first : last;
    for (const auto part : {&BoundaryState::q, &BoundaryState::v}) {
      for (Eigen::Index i = 0; i < end.q.size(); ++i) {
        double& value = (end.*part)[i];
        const double size = value != 0.0 ? value : (last.*part)[i] - (first.*part)[i];
        constexpr double share = 0.1;
        const double unit = 2.0 * uniform_01(engine_) - 1.0;
        value += share * unit * std::abs(size);
        units_.push_back(unit);
      }
    }
    return end;
  }

  GuessedProgram made_;
  std::unique_ptr<ClampedEnds> ends_;
  Eigen::VectorXd multipliers_;
  std::vector<Ends> states_;
  std::vector<double> units_;  // of the instance that is drawn
  std::mt19937 engine_{20090101U};
};

/// A way to solve them, or to fill them only.
struct BatchCase {
  std::string problem;
  StartKind start = StartKind::cold;
  std::string name;  ///< batch, fill, or a solver, called in a loop
  std::size_t threads = 1;
  std::size_t instances = most_instances;
};

/// The results.
struct Tally {
  std::vector<double> iterations;
  double solved = 0.0;
  double turns_of_lanes = 0.0;  ///< that solves took: a system each, and one for the start
  BatchSummary batch;

  void add(const Solution& solution) {
    iterations.push_back(solution.major_iterations.value_or(0));
    if (solution.solver == "batch") turns_of_lanes += solution.linear_systems.value_or(0) + 1.0;
    solved += is_solved(solution.status) ? 1.0 : 0.0;
  }
};

void solve_in_lanes(Instances& instances, const BatchCase& way, Tally& tally) {
  BatchOptions options;
  options.threads = way.threads;
  const MakeLanes lanes = lanes_of(instances.program());
  const TakeSolution take = [&](std::size_t, const Solution& solution) { tally.add(solution); };
  if (way.start == StartKind::nearest) {
    const auto place = [&](std::size_t index, Eigen::VectorXd& coordinates) {
      if (index < way.instances) coordinates = instances.place(index);
      return index < way.instances;
    };
    const auto next = [&](std::size_t index, const Solution* neighbour, BatchInstance& instance) {
      instances.fill(index, instance, neighbour);
    };
    tally.batch =
        solve_batch_from_neighbours(instances.program(), lanes, instances.start(), place, next, take, options);
    return;
  }
  const auto next = [&](std::size_t index, BatchInstance& instance) {
    if (index < way.instances) instances.fill(index, instance);
    return index < way.instances;
  };
  tally.batch = solve_batch(instances.program(), lanes, instances.start(), next, take, options);
}

void solve_in_a_loop(Instances& instances, const BatchCase& way, Tally& tally) {
  BatchInstance instance;
  for (std::size_t i = 0; i < way.instances; ++i) {
    instances.fill(i, instance);
    if (way.name == "fill") continue;
    batch::InstanceProgram alone(instances.program(), instance.start, instance.equality_values);
    tally.add(make_solver(way.name)->solve(alone, instance.start, instance.multipliers));
  }
}

constexpr std::array phase_names{"tapes", "linear_systems", "line_search", "one_by_one", "exchange", "rest"};
static_assert(phase_names.size() == batch_phases);

/// The counters of a batch: how many instances lanes could not finish, how full lanes were, and the shares of
/// time by phase.
void count_batch(benchmark::State& state, const BatchSummary& batch, double turns_of_lanes) {
  if (batch.instances == 0) return;
  state.counters["one_by_one"] = static_cast<double>(batch.solved_one_by_one) / static_cast<double>(batch.instances);
  state.counters["lanes_in_use"] = turns_of_lanes / static_cast<double>(batch.rounds * instance_lanes);
  const double total = std::accumulate(batch.seconds.begin(), batch.seconds.end(), 0.0);
  for (std::size_t i = 0; i < batch_phases; ++i) {
    state.counters[fmt::format("share_{}", phase_names[i])] = batch.seconds[i] / total;
  }
}

/// Every turn solves all instances; its time is given per instance.
void run(benchmark::State& state, const BatchCase& way) {
  set_thread_count(1);
  Instances instances(way.problem, way.start);
  Tally tally;
  double processor_seconds = 0.0;  // of all threads: other work of the machine does not count
  for ([[maybe_unused]] auto turn : state) {
    tally = {};
    const std::clock_t clock = std::clock();
    const auto begin = Clock::now();
    way.name == "batch" ? solve_in_lanes(instances, way, tally) : solve_in_a_loop(instances, way, tally);
    state.SetIterationTime(seconds_since(begin) / static_cast<double>(way.instances));
    processor_seconds = static_cast<double>(std::clock() - clock) / CLOCKS_PER_SEC;
  }
  state.counters["processor_seconds"] = processor_seconds / static_cast<double>(way.instances);
  state.SetLabel(fmt::format("problem={} start={} way={} threads={} instances={}", way.problem, name_of(way.start),
                             way.name, way.threads, way.instances));
  if (tally.iterations.empty()) return;
  const auto count = static_cast<double>(tally.iterations.size());
  state.counters["median_iterations"] = median(tally.iterations);
  state.counters["solved"] = tally.solved / count;
  count_batch(state, tally.batch, tally.turns_of_lanes);
}

/// PROBLEM/START/WAY/threads_COUNT
void add(const BatchCase& way) {
  const std::string name = fmt::format("{}/{}/{}/threads_{}", way.problem, name_of(way.start), way.name, way.threads);
  add_benchmark(name, benchmark::kMicrosecond, [way](benchmark::State& state) { run(state, way); })->Iterations(1);
}

void register_batches() {
  constexpr std::size_t of_interior_point = 256;
  constexpr std::size_t of_ipopt = 32;
  const std::size_t all_threads = thread_count();
  for (const std::string& problem : paper_problem_names()) {
    for (const StartKind start : {StartKind::cold, StartKind::warm, StartKind::nearest}) {
      const auto variant = [&](const char* name, std::size_t threads, std::size_t instances) {
        add({.problem = problem, .start = start, .name = name, .threads = threads, .instances = instances});
      };
      variant("batch", 1, most_instances);
      if (all_threads > 1) variant("batch", all_threads, most_instances);
      if (start == StartKind::nearest) continue;  // whose loops are the warm ones
      variant("fill", 1, most_instances);
      variant("interior_point", 1, of_interior_point);
      variant("ipopt", 1, of_ipopt);
    }
  }
}

}  // namespace

int run_batches(int argc, char** argv) {
  const BenchmarkProgram program{
      .name = "batch",
      .description = "Measures times per solve for many instances of a program, in lanes and one by one.",
      .default_filter = ".",
      .register_benchmarks = register_batches};
  return program.run(argc, argv);
}

}  // namespace dmocbench::speed

int main(int argc, char** argv) { return dmocbench::speed::run_batches(argc, argv); }
