// What makes interior_point faster than Ipopt, factor by factor: one thing is changed at a time, in rounds that take
// turns.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/experiment/command_line.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/speed/guessed_program.hpp"
#include "bench/speed/measured_page.hpp"
#include "bench/speed/one_lane_kernel.hpp"
#include "bench/summary/ratio_interval.hpp"
#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/numerics/median.hpp"
#include "methods/runtime/instruction_set.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "methods/solvers/kkt/intervals/interval_kkt.hpp"
#include "methods/solvers/kkt/refined_kkt.hpp"
#include "methods/solvers/kkt/sparse_kkt.hpp"
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

void set_program(Row& row, const SharedProgram& of) {
  row.set("problem", of.problem);
  row.set("intervals", of.intervals);
  row.set("derivatives", of.derivatives);
}

/// A row per way: its time, its iterations, the time of one, and the share of derivatives.
void append_ways(Table& table, const SharedProgram& of, const TimesByWay& times,
                 const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const Times& measured = times.at(name);
    const double seconds = median(measured.seconds);
    Row row;
    set_program(row, of);
    row.set("way", name);
    row.set("words", way_named(name).words);
    row.set("rounds", measured.seconds.size());
    row.set("status", std::string(name_of(measured.solution.status)));
    row.set("iterations", measured.iterations());
    row.set("linear_systems", measured.solution.linear_systems);
    set_median(row, "seconds", measured.seconds);
    row.set("us_per_iteration", 1e6 * seconds / std::max(1.0, measured.iterations()));
    row.set("evaluation_share", median(measured.evaluation_seconds) / seconds);
    table.append(std::move(row));
  }
}

/// One thing that is changed.
struct Change {
  std::string order;
  std::string what;
  std::string from;
  std::string to;
};

/// The factor of a change, split into iterations and time per iteration; only a verdict where costs differ.
void append_change(Table& table, const SharedProgram& of, const TimesByWay& times, const Change& change) {
  const Times& from = times.at(change.from);
  const Times& to = times.at(change.to);
  Row row;
  set_program(row, of);
  row.set("order", change.order);
  row.set("changed", change.what);
  row.set("from", change.from);
  row.set("to", change.to);
  if (!are_same(from, to)) {
    row.set("verdict", "not both solved with equal costs");
  } else {
    const std::vector<double> ratios = round_ratios(from.seconds, to.seconds);
    const RatioInterval factor = ratio_interval(ratios);
    const double of_iterations = from.iterations() / to.iterations();
    row.set("factor", factor.ratio);
    set_rounds(row, ratios);
    row.set("of_iterations", of_iterations);
    row.set("of_time_per_iteration", factor.ratio / of_iterations);
    row.set("of_time_lower", factor.lower / of_iterations);
    row.set("of_time_upper", factor.upper / of_iterations);
    row.set("verdict", is_busy()                                  ? "not judged on a busy machine"
                       : ratios.size() < fewest_rounds            ? "too few rounds"
                       : factor.lower > 1.0 || factor.upper < 1.0 ? "apart from 1"
                                                                  : "not apart from 1");
  }
  table.append(std::move(row));
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

/// The table of ways, and that of factors.
struct MeasuredFactors {
  Table of_ways{std::vector<std::string>{"problem", "intervals", "derivatives", "way", "words", "rounds", "status",
                                         "iterations", "linear_systems", "seconds", "seconds_lower", "seconds_upper",
                                         "us_per_iteration", "evaluation_share"}};
  Table of_changes{std::vector<std::string>{"problem", "intervals", "derivatives", "order", "changed", "from", "to",
                                            "factor", "ratio_lower", "ratio_upper", "round_ratios", "of_iterations",
                                            "of_time_per_iteration", "of_time_lower", "of_time_upper", "verdict"}};

  /// Solves a program by all ways that the changes name.
  void measure_program(const SharedProgram& of, const std::vector<Change>& of_program, int rounds, double tolerance) {
    std::vector<std::string> names;
    for (const Way& way : ways()) {
      const auto names_it = [&](const Change& change) { return change.from == way.name || change.to == way.name; };
      if (std::ranges::any_of(of_program, names_it)) names.push_back(way.name);
    }
    const TimesByWay times = measure(of, names, rounds, tolerance);
    append_ways(of_ways, of, times, names);
    for (const Change& change : of_program) append_change(of_changes, of, times, change);
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

std::string tables_on_page(const MeasuredFactors& measured) {
  return "## Factors\n\n" +
         page_table(measured.of_changes.rows(), {{"problem", "problem"},
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
         page_table(measured.of_ways.rows(), {{"problem", "problem"},
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

int run_factors(CommandLine& line, const std::vector<std::string>& command) {
  std::filesystem::path out = "results";
  int rounds = 11;
  line.option("--out", out, "folder for speed_factors.csv, speed_factors_steps.csv and speed_factors.md");
  line.number("--rounds", rounds, 1, 1000, "how often everything is solved, in turn");
  line.parse();
  static_cast<void>(is_busy());
  if (preferred_instruction_set() == InstructionSet::baseline)
    throw Error("one lane is compiled for processors with AVX2");
  const OutputFolder folder(out);
  const MeasuredFactors measured = measure_all(rounds);
  write_file(out / "speed_factors.csv", measured.of_ways.csv());
  write_file(out / "speed_factors_steps.csv", measured.of_changes.csv());
  write_page(out / "speed_factors.md", page_head("Why interior_point is faster than Ipopt, factor by factor", command) +
                                           words_of_page + tables_on_page(measured));
  return 0;
}

}  // namespace

}  // namespace dmocbench::speed

int main(int argc, char** argv) {
  return dmocbench::speed::run_page_program("factors", "What makes interior_point faster than Ipopt, factor by factor.",
                                            argc, argv, dmocbench::speed::run_factors);
}
