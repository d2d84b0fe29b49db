// What makes interior_point faster than Ipopt, factor by factor: one thing is changed at a time, in rounds that take
// turns.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/speed/guessed_program.hpp"
#include "bench/speed/measured_page.hpp"
#include "bench/speed/one_lane_kernel.hpp"
#include "bench/tables/ratio_interval.hpp"
#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/kkt/intervals/interval_kkt.hpp"
#include "methods/kkt/refined_kkt.hpp"
#include "methods/kkt/sparse_kkt.hpp"
#include "methods/numerics/median.hpp"
#include "methods/runtime/instruction_set.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "methods/transcription/derivatives/derivative_back_end.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

using KernelChoice = kkt::SegmentKernelChoice;

std::unique_ptr<Solver> with_kkt(const SolverOptions& options,
                                 std::function<std::unique_ptr<kkt::KktSystem>(NonlinearProgram&)> make) {
  return std::make_unique<InteriorPointSolver>(options, InteriorPointOptions{.make_kkt_system = std::move(make)});
}

std::unique_ptr<Solver> by_mumps(const SolverOptions& options, kkt::SparseKkt::Order order) {
  return with_kkt(options,
                  [order](NonlinearProgram& program) { return std::make_unique<kkt::SparseKkt>(program, order); });
}

std::unique_ptr<Solver> by_intervals(const SolverOptions& options, KernelChoice choose) {
  return with_kkt(options, [choose](NonlinearProgram& program) -> std::unique_ptr<kkt::KktSystem> {
    auto made = kkt::IntervalKkt::make(program, choose);
    if (!made) throw Error(made.error());
    return std::make_unique<kkt::RefinedKkt>(program, std::move(*made));
  });
}

/// The kernel for any sizes, which a plain shape has too.
kkt::Shape of_any_size(kkt::Shape shape) {
  shape.is_plain = false;
  return shape;
}

/// A way to solve: how it is called on the page, and the solver.
struct Way {
  std::string name;
  std::string words;
  std::function<std::unique_ptr<Solver>(const SolverOptions&)> make;
  std::size_t threads = 1;
};

const std::vector<Way>& ways() {
  using Order = kkt::SparseKkt::Order;
  static const std::vector<Way> known{
      {"ipopt", "Ipopt with MUMPS, as Debian has them", [](const auto& o) { return make_solver("ipopt", o); }},
      {"mumps", "interior_point with MUMPS", [](const auto& o) { return by_mumps(o, Order::found); }},
      {"dissection", "... in the order of a dissection of the horizon",
       [](const auto& o) { return by_mumps(o, Order::along_the_horizon); }},
      {"one_lane", "by intervals, one lane after the other, any sizes",
       [](const auto& o) {
         return by_intervals(o, [](const kkt::Shape& shape) { return one_lane_kernel(of_any_size(shape)); });
       }},
      {"eight_lanes", "by intervals, eight lanes, any sizes",
       [](const auto& o) {
         return by_intervals(o, [](const kkt::Shape& shape) { return kkt::segment_kernel_for(of_any_size(shape)); });
       }},
      {"one_lane_sized", "by intervals, one lane after the other, known sizes",
       [](const auto& o) { return by_intervals(o, one_lane_kernel); }},
      {"sized", "by intervals, eight lanes, known sizes: the solver as it is",
       [](const auto& o) { return make_solver("interior_point", o); }},
      {"two_threads", "the same on two threads", [](const auto& o) { return make_solver("interior_point", o); }, 2},
  };
  return known;
}

const Way& way_named(const std::string& name) { return one_of(ways(), &Way::name, name, "there is no way"); }

/// What one way took for one program, round after round.
struct Times {
  std::vector<double> seconds;
  std::vector<double> evaluation_seconds;
  Solution solution;

  [[nodiscard]] double iterations() const { return solution.major_iterations.value_or(0); }
};
using TimesByWay = std::map<std::string, Times>;

/// A program that several ways solve.
struct SharedProgram {
  std::string problem;
  int intervals = 0;
  std::string derivatives = "tape";
};

/// Solves a program by every way, in turn.
TimesByWay measure(const SharedProgram& of, const std::vector<std::string>& names, int rounds, double tolerance) {
  const GuessedProgram made(make_problem(of.problem), "dmoc", of.intervals, 1, of.derivatives);
  SolverOptions options;
  options.tolerance = tolerance;
  options.most_seconds = 60.0;
  TimesByWay times;
  for (int round = 0; round < rounds; ++round) {
    for (const std::string& name : names) {
      const Way& way = way_named(name);
      set_thread_count(way.threads);
      Times& of_way = times[name];
      of_way.solution = way.make(options)->solve(*made.program, made.start);
      of_way.seconds.push_back(of_way.solution.seconds);
      of_way.evaluation_seconds.push_back(of_way.solution.evaluation_seconds);
    }
  }
  return times;
}

/// Both solved, with equal costs.
bool are_same(const Times& a, const Times& b) {
  constexpr double equal = 1e-7;
  return is_solved(a.solution.status) && is_solved(b.solution.status) &&
         std::abs(a.solution.objective - b.solution.objective) <= equal * std::abs(b.solution.objective);
}

/// The columns that tell `Record::of`.
template <class Record>
Columns<Record> program_columns() {
  return {{"problem", "", "name of the problem", from(&Record::of, &SharedProgram::problem)},
          {"intervals", "", "number of intervals N", from(&Record::of, &SharedProgram::intervals)},
          {"derivatives", "", "back end of derivatives", from(&Record::of, &SharedProgram::derivatives)}};
}

/// What a way took for a program.
struct TimedWay {
  SharedProgram of;
  const Way* way = nullptr;
  Times times;

  [[nodiscard]] double seconds() const { return median(times.seconds); }
};

Columns<TimedWay> way_columns() {
  constexpr auto times = &TimedWay::times;
  return program_columns<TimedWay>() +
         Columns<TimedWay>{
             {"way", "", "name of the way to solve", [](const TimedWay& timed) { return timed.way->name; }},
             {"words", "", "what it is", [](const TimedWay& timed) { return timed.way->words; }},
             {"rounds", "", "how often it solved", [](const TimedWay& timed) { return timed.times.seconds.size(); }},
             {"status", "", "of the last solve",
              [](const TimedWay& timed) { return name_of(timed.times.solution.status); }},
             {"iterations", "", "of a solve", from(times, &Times::iterations)},
             {"linear_systems", "", "of a solve", from(times, &Times::solution, &Solution::linear_systems)}} +
         median_columns<TimedWay>("seconds", "s", "of a solve", times, &Times::seconds) +
         Columns<TimedWay>{
             {"us_per_iteration", "us", "time of a solve by its iterations",
              [](const TimedWay& timed) { return 1e6 * timed.seconds() / std::max(1.0, timed.times.iterations()); }},
             {"evaluation_share", "", "share of derivatives in the time",
              [](const TimedWay& timed) { return median(timed.times.evaluation_seconds) / timed.seconds(); }}};
}

/// One thing that is changed.
struct Change {
  std::string order;
  std::string subject;
  std::string from;
  std::string to;
};

/// The factor of a change, split into iterations and time per iteration; empty where costs differ.
struct Factor {
  double of_iterations = 1.0;
  MedianOfRounds rounds;

  [[nodiscard]] double of_time(std::optional<double> MedianOfRounds::*bound) const {
    return (rounds.*bound).value_or(NAN) / of_iterations;
  }
};

struct MeasuredChange {
  SharedProgram of;
  Change change;
  std::optional<Factor> factor;
  std::size_t round_count = 0;

  MeasuredChange(SharedProgram program, Change changed, const TimesByWay& times)
      : of(std::move(program)), change(std::move(changed)) {
    const Times& from = times.at(change.from);
    const Times& to = times.at(change.to);
    if (!are_same(from, to)) return;
    const std::vector<double> ratios = round_ratios(from.seconds, to.seconds);
    round_count = ratios.size();
    factor = {.of_iterations = from.iterations() / to.iterations(), .rounds = MedianOfRounds(ratios)};
  }
  [[nodiscard]] std::string verdict() const {
    if (!factor) return "not both solved with equal costs";
    if (is_busy()) return "not judged on a busy machine";
    if (round_count < fewest_rounds) return "too few rounds";
    const bool is_apart = factor->rounds.lower.value_or(1.0) > 1.0 || factor->rounds.upper.value_or(1.0) < 1.0;
    return is_apart ? "apart from 1" : "not apart from 1";
  }
};

Columns<MeasuredChange> change_columns() {
  constexpr auto change = &MeasuredChange::change;
  constexpr auto factor = &MeasuredChange::factor;
  const auto of_time = [](std::optional<double> MedianOfRounds::*bound) {
    return from(&MeasuredChange::factor, [bound](const Factor& split) { return split.of_time(bound); });
  };
  return program_columns<MeasuredChange>() +
         Columns<MeasuredChange>{
             {"order", "", "in which order lanes and sizes are switched", from(change, &Change::order)},
             {"changed", "", "what is changed", from(change, &Change::subject)},
             {"from", "", "the way before", from(change, &Change::from)},
             {"to", "", "the way behind", from(change, &Change::to)},
             {"factor", "", "seconds before by seconds behind, the median over the rounds",
              from(factor, &Factor::rounds, &MedianOfRounds::median)}} +
         round_columns<MeasuredChange>(factor, &Factor::rounds) +
         Columns<MeasuredChange>{
             {"of_iterations", "", "the factor in the number of iterations", from(factor, &Factor::of_iterations)},
             {"of_time_per_iteration", "", "the factor in the time per iteration", of_time(&MedianOfRounds::median)},
             {"of_time_lower", "", "of the interval of 99 % of this factor", of_time(&MedianOfRounds::lower)},
             {"of_time_upper", "", "of the same interval", of_time(&MedianOfRounds::upper)},
             {"verdict", "", "whether the factor is apart from 1", &MeasuredChange::verdict}};
}

const std::vector<Change>& changes() {
  static const std::vector<Change> all{
      {"both", "the method", "ipopt", "mumps"},
      {"both", "the order of elimination", "mumps", "dissection"},
      {"lanes first", "elimination by intervals", "dissection", "one_lane"},
      {"lanes first", "eight lanes", "one_lane", "eight_lanes"},
      {"lanes first", "known sizes", "eight_lanes", "sized"},
      {"sizes first", "known sizes", "one_lane", "one_lane_sized"},
      {"sizes first", "eight lanes", "one_lane_sized", "sized"},
      {"all", "all of it", "ipopt", "sized"},
  };
  return all;
}

constexpr const char* words_of_page =
    "DMOC with the midpoint rule, from the problem's own guess; all solve the same program with the same derivatives "
    "and stop by one rule. Medians over rounds in which every way solves once, with 99 % intervals (bootstrap). A "
    "factor is the ratio of the seconds before and after a change, round by round, and the product of the ratio of "
    "iterations, which no load changes, and that of the time per iteration. Lanes and sizes are switched in both "
    "orders: where their factors differ between the orders, they act together. Ipopt takes no order of elimination "
    "from outside, so the first two steps have one order only.\n\n";

struct MeasuredFactors {
  std::vector<TimedWay> of_ways;
  std::vector<MeasuredChange> of_changes;

  /// Solves a program by all ways that the changes name.
  void measure_program(const SharedProgram& of, const std::vector<Change>& of_program, int rounds, double tolerance) {
    std::vector<std::string> names;
    for (const Way& way : ways()) {
      const auto names_it = [&](const Change& change) { return change.from == way.name || change.to == way.name; };
      if (std::ranges::any_of(of_program, names_it)) names.push_back(way.name);
    }
    const TimesByWay times = measure(of, names, rounds, tolerance);
    for (const std::string& name : names) of_ways.push_back({of, &way_named(name), times.at(name)});
    for (const Change& change : of_program) of_changes.emplace_back(of, change, times);
  }
};

MeasuredFactors measure_all(int rounds) {
  constexpr double tolerance = 1e-10;
  constexpr double of_differences = 1e-6;  // differences reach no lower one: all back ends get one that they can
  MeasuredFactors measured;
  for (const std::string& problem : paper_problem_names()) {
    measured.measure_program({problem, 1024}, changes(), rounds, tolerance);
    measured.measure_program({problem, 65536}, {{"threads", "two threads", "sized", "two_threads"}}, rounds, tolerance);
    for (const std::string& derivatives : derivative_back_end_names()) {
      measured.measure_program({problem, 128, derivatives}, {{"back ends", "the solver", "ipopt", "sized"}}, rounds,
                               of_differences);
    }
  }
  return measured;
}

std::string tables_on_page(const Table& of_ways, const Table& of_changes) {
  return "## Factors\n\n" +
         page_table(of_changes.rows(), {{"problem", "problem"},
                                        {"intervals", "N", 9},
                                        {"derivatives", "derivatives"},
                                        {"order", "order"},
                                        {"changed", "changed"},
                                        {"factor", "factor"},
                                        {"ratio_lower", "from"},
                                        {"ratio_upper", "to"},
                                        {"of_iterations", "of iterations"},
                                        {"of_time_per_iteration", "of time per iteration"},
                                        {"of_time_lower", "from"},
                                        {"of_time_upper", "to"},
                                        {"verdict", "verdict"}}) +
         "## Times\n\n" +
         page_table(of_ways.rows(), {{"problem", "problem"},
                                     {"intervals", "N", 9},
                                     {"derivatives", "derivatives"},
                                     {"words", "by"},
                                     {"seconds", "seconds"},
                                     {"seconds_lower", "from"},
                                     {"seconds_upper", "to"},
                                     {"iterations", "iterations", 9},
                                     {"linear_systems", "systems", 9},
                                     {"us_per_iteration", "µs per iteration"},
                                     {"evaluation_share", "share of derivatives", 2},
                                     {"status", "status"}});
}

MeasuredPage measure_page(int rounds) {
  if (preferred_instruction_set() == InstructionSet::baseline)
    throw Error("one lane is compiled for processors with AVX2");
  const MeasuredFactors measured = measure_all(rounds);
  const Table of_ways = table_of(way_columns(), measured.of_ways);
  const Table of_changes = table_of(change_columns(), measured.of_changes);
  return {.title = "Why interior_point is faster than Ipopt, factor by factor",
          .text = words_of_page + tables_on_page(of_ways, of_changes),
          .tables = {{"", of_ways}, {"_steps", of_changes}}};
}

}  // namespace

int run_factors(int argc, char** argv) {
  const PageProgram program{
      .name = "factors",
      .description = "What makes interior_point faster than Ipopt, factor by factor.",
      .ends = {"", "_steps"},
      .columns = describe(way_columns()) + "\nof speed_factors_steps.csv:\n" + describe(change_columns()),
      .measure = measure_page};
  return program.run(argc, argv);
}

}  // namespace dmocbench::speed

int main(int argc, char** argv) { return dmocbench::speed::run_factors(argc, argv); }
