// What a second thread gains: whole solves of long horizons on one thread and on several, in rounds that take turns,
// beside what the machine gains by them where nothing is shared.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/experiment/command_line.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/speed/guessed_program.hpp"
#include "bench/speed/kernels.hpp"
#include "bench/speed/measured_page.hpp"
#include "bench/summary/ratio_interval.hpp"
#include "methods/error.hpp"
#include "methods/numerics/median.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/confirm.hpp"
#include "methods/solvers/counted_program.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// What one thread and several threads took, round after round.
struct Turns {
  std::vector<double> on_one;
  std::vector<double> on_several;

  /// Times over those of one thread: `work` times as much was done on several.
  [[nodiscard]] std::vector<double> gains(double work = 1.0) const {
    std::vector<double> ratios = round_ratios(on_one, on_several);
    for (double& ratio : ratios) ratio *= work;
    return ratios;
  }
};

/// Work that threads do without sharing anything: as much of it on every thread as on one.
class Ceiling {
 public:
  /// A loop that every thread calls with memory of its own, three arrays of `size` numbers each.
  using Loop = std::function<void(double* first, std::size_t size)>;

  Ceiling(std::string name, std::string words, std::size_t size, Loop loop)
      : name_(std::move(name)), words_(std::move(words)), size_(size), loop_(std::move(loop)) {}

  void measure(std::size_t threads) {
    set_thread_count(threads);
    memory_.resize(threads);
    // Everything is written first by the thread that works on it.
    for_each_part(threads, [&](std::size_t part) { memory_[part].assign(3 * size_, 1.0); });
    turns_.on_several.push_back(seconds_of(threads));
    set_thread_count(1);
    turns_.on_one.push_back(seconds_of(1));
    memory_.clear();
  }

  [[nodiscard]] Row row(std::size_t threads) const {
    const std::vector<double> gains = turns_.gains(static_cast<double>(threads));
    Row row;
    row.set("what", name_);
    row.set("words", words_);
    row.set("threads", threads);
    row.set("rounds", gains.size());
    row.set("seconds", median(turns_.on_one));
    row.set("seconds_on_threads", median(turns_.on_several));
    row.set("gain", median(gains));
    set_rounds(row, gains);
    return row;
  }

 private:
  double seconds_of(std::size_t parts) {
    const auto begin = Clock::now();
    for_each_part(parts, [&](std::size_t part) { loop_(memory_[part].data(), size_); });
    return seconds_since(begin);
  }

  std::string name_;
  std::string words_;
  std::size_t size_;
  Loop loop_;
  std::vector<std::vector<double>> memory_;
  Turns turns_;
};

std::vector<Ceiling> ceilings() {
  constexpr std::size_t in_memory = std::size_t{1} << 22U;  // three arrays of 32 MiB, more than caches hold
  constexpr std::size_t in_cache = std::size_t{1} << 14U;   // of 128 KiB: a second-level cache of its own holds them
  constexpr std::size_t turns_of_arithmetic = 1000000;
  const Kernels kernels = kernels_of(preferred_instruction_set());
  const auto triad = [kernels](int turns) {
    return [kernels, turns](double* first, std::size_t size) {
      for (int turn = 0; turn < turns; ++turn) {
        kernels.triad(size, first, first + size, first + 2 * size, 0.5);
      }
    };
  };
  std::vector<Ceiling> all;
  all.emplace_back("arithmetic", "multiplications and additions in registers", 1,
                   [kernels](double* first, std::size_t) { *first = kernels.arithmetic(turns_of_arithmetic); });
  all.emplace_back("triad_cache", "a = b + s c, arrays of 128 KiB", in_cache, triad(2000));
  all.emplace_back("triad_memory", "a = b + s c, arrays of 32 MiB", in_memory, triad(10));
  return all;
}

/// A program, made once and solved in every round on one thread and on several.
class SharedSolves {
 public:
  SharedSolves(const std::string& problem, const std::string& method, int intervals)
      : intervals_(intervals), method_(method), made_(make_problem(problem), method, intervals) {}

  void solve(std::size_t threads) {
    turns_.on_one.push_back(seconds_on(1));
    const Eigen::VectorXd primal = std::move(solution_.primal);
    turns_.on_several.push_back(seconds_on(threads));
    is_same_ = is_same_ && solution_.primal == primal;
  }

  [[nodiscard]] Row row(std::size_t threads) {
    constexpr double nanoseconds = 1e9;
    judge();
    const double iterations = solution_.major_iterations.value_or(0);
    Row row;
    row.set("problem", made_.problem->name());
    row.set("method", method_);
    row.set("intervals", intervals_);
    row.set("threads", threads);
    row.set("rounds", turns_.on_one.size());
    row.set("status", std::string(name_of(solution_.status)));
    row.set("iterations", iterations);
    row.set("linear_systems", solution_.linear_systems);
    row.set("same_digits", is_same_ ? "yes" : "no");
    if (!is_solved(solution_.status)) return row;
    const std::vector<double> gains = turns_.gains();
    row.set("seconds", median(turns_.on_one));
    row.set("seconds_on_threads", median(turns_.on_several));
    row.set("ns_per_interval_iteration",
            nanoseconds * median(turns_.on_several) / intervals_ / std::max(1.0, iterations));
    row.set("gain", median(gains));
    set_rounds(row, gains);
    return row;
  }

 private:
  void judge() {
    if (!is_solved(solution_.status)) return;
    judge_residuals(*made_.program, solution_);
    solution_.status = judged(solution_.status, scaled_residual(*made_.program, SolverOptions().tolerance, solution_));
  }

  /// As `Solver::solve` measures it. Judging the answer, which would take longer than the solve, is left to `judge`.
  double seconds_on(std::size_t threads) {
    set_thread_count(threads);
    const InteriorPointSolver solver;
    CountedProgram counted(*made_.program);
    solution_ = {};
    auto method = solver.prepare(counted);
    method->run(made_.start, {}, std::nullopt, solution_);
    method.reset();
    return counted.elapsed_seconds();
  }

  int intervals_;
  std::string method_;
  GuessedProgram made_;
  Solution solution_;
  bool is_same_ = true;
  Turns turns_;
};

constexpr const char* words_of_page =
    "Whole solves by `interior_point` from the problem's own guess, midpoint rule, tolerance 1e-10: the time of the "
    "solver, with the search for structure, without making the program and judging the answer. A gain is the ratio of "
    "the seconds on one thread and on several, solved in turn, round by round: its median with the 99 % interval "
    "(bootstrap). Answers are judged by their residuals; `same digits` says whether those on one thread and on several "
    "are the same to the last digit. The first table is what the machine gives to threads that share nothing but "
    "itself: times the work of one thread that they do in its time. A solve is a mixture of such work.\n\n";

Table solves_table(const std::vector<std::string>& problems, const std::vector<std::string>& methods,
                   const std::vector<int>& grids, int rounds, std::size_t threads) {
  Table table({"problem", "method", "intervals", "threads", "rounds", "status", "iterations", "linear_systems",
               "seconds", "seconds_on_threads", "ns_per_interval_iteration", "gain", "ratio_lower", "ratio_upper",
               "round_ratios", "same_digits"});
  for (const std::string& problem : problems) {
    for (const std::string& method : methods) {
      for (const int intervals : grids) {
        SharedSolves solves(problem, method, intervals);
        for (int round = 0; round < rounds; ++round) solves.solve(threads);
        table.append(solves.row(threads));
      }
    }
  }
  return table;
}

Table ceiling_table(int rounds, std::size_t threads) {
  std::vector<Ceiling> machine = ceilings();
  for (int round = 0; round < rounds; ++round) {
    for (Ceiling& ceiling : machine) ceiling.measure(threads);
  }
  Table table({"what", "words", "threads", "rounds", "seconds", "seconds_on_threads", "gain", "ratio_lower",
               "ratio_upper", "round_ratios"});
  for (const Ceiling& ceiling : machine) table.append(ceiling.row(threads));
  return table;
}

std::string tables_on_page(const Table& machine, const Table& solves, std::size_t threads) {
  return "## The machine\n\n" +
         page_table(machine.rows(), {{"words", "work"},
                                     {"seconds", "seconds on one thread"},
                                     {"seconds_on_threads", "seconds on all, each as much"},
                                     {"gain", "gain"},
                                     {"ratio_lower", "from"},
                                     {"ratio_upper", "to"}}) +
         "## Solves\n\n" +
         page_table(solves.rows(), {{"problem", "problem"},
                                    {"method", "method"},
                                    {"intervals", "N", 9},
                                    {"seconds", "seconds on one thread"},
                                    {"seconds_on_threads", fmt::format("on {}", threads)},
                                    {"gain", "gain"},
                                    {"ratio_lower", "from"},
                                    {"ratio_upper", "to"},
                                    {"ns_per_interval_iteration", "ns per interval and iteration"},
                                    {"iterations", "iterations", 9},
                                    {"linear_systems", "systems", 9},
                                    {"same_digits", "same digits"},
                                    {"status", "status"}});
}

int run_threads(CommandLine& line, const std::vector<std::string>& command) {
  std::filesystem::path out = "results";
  std::vector<std::string> problems = paper_problem_names();
  std::vector<std::string> methods{"dmoc", "hamiltonian"};
  std::vector<int> grids{65536, 262144, 1000000};
  int rounds = 11;
  int threads = 2;
  line.option("--out", out, "folder for speed_threads.csv, speed_threads_ceiling.csv and speed_threads.md");
  line.list("--problem", problems, "problems");
  line.list("--method", methods, "methods");
  line.list("--intervals", grids, "numbers of intervals");
  line.number("--rounds", rounds, 1, 1000, "how often everything is solved, in turn");
  line.number("--threads", threads, 2, 1024, "threads that are compared with one");
  line.parse();
  static_cast<void>(is_busy());
  const OutputFolder folder(out);
  const auto several = static_cast<std::size_t>(threads);
  const Table solves = solves_table(problems, methods, grids, rounds, several);
  const Table machine = ceiling_table(rounds, several);
  write_file(out / "speed_threads.csv", solves.csv());
  write_file(out / "speed_threads_ceiling.csv", machine.csv());
  write_page(out / "speed_threads.md", page_head(fmt::format("What {} threads gain", threads), command) +
                                           words_of_page + tables_on_page(machine, solves, several));
  return 0;
}

}  // namespace

}  // namespace dmocbench::speed

int main(int argc, char** argv) {
  return dmocbench::speed::run_page_program(
      "threads", "What a second thread gains in whole solves, beside what the machine gives.", argc, argv,
      dmocbench::speed::run_threads);
}
