// What a second thread gains: whole solves of long horizons on one thread and on several, in rounds that take turns,
// beside what the machine gains by them where nothing is shared.
#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/speed/guessed_program.hpp"
#include "bench/speed/kernels.hpp"
#include "bench/speed/measured_page.hpp"
#include "bench/tables/ratio_interval.hpp"
#include "methods/error.hpp"
#include "methods/judgement/confirm.hpp"
#include "methods/numerics/median.hpp"
#include "methods/program/counted_program.hpp"
#include "methods/runtime/clock.hpp"
#include "methods/runtime/parallel.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// What one thread and several threads took, round after round.
struct Turns {
  std::vector<double> on_one;
  std::vector<double> on_several;
  double work = 1.0;  ///< how many times as much was done on several

  /// Times over those of one thread.
  [[nodiscard]] std::vector<double> gains() const {
    std::vector<double> ratios = round_ratios(on_one, on_several);
    for (double& ratio : ratios) ratio *= work;
    return ratios;
  }
  [[nodiscard]] MedianOfRounds gain() const { return MedianOfRounds(gains()); }
};

std::size_t rounds_of(const Turns& turns) { return turns.on_one.size(); }

/// The columns of what was gained.
template <class Record>
Columns<Record> gain_columns(Turns Record::*turns) {
  return Columns<Record>{{"gain", "", "seconds by seconds_on_threads, for as much work, the median over the rounds",
                          from(turns, &Turns::gain, &MedianOfRounds::median)}} +
         round_columns<Record>(turns, &Turns::gain);
}

/// Work that threads do without sharing anything: as much of it on every thread as on one.
class Ceiling {
 public:
  /// A loop that every thread calls with memory of its own, three arrays of `size` numbers each.
  using Loop = std::function<void(double* first, std::size_t size)>;

  Ceiling(std::string name, std::string words, std::size_t size, Loop loop)
      : name_(std::move(name)), words_(std::move(words)), size_(size), loop_(std::move(loop)) {}

  void measure(std::size_t threads) {
    threads_ = threads;
    turns_.work = static_cast<double>(threads);
    set_thread_count(threads);
    memory_.resize(threads);
    // Everything is written first by the thread that works on it.
    for_each_part(threads, [&](std::size_t part) { memory_[part].assign(3 * size_, 1.0); });
    turns_.on_several.push_back(seconds_of(threads));
    set_thread_count(1);
    turns_.on_one.push_back(seconds_of(1));
    memory_.clear();
  }

  [[nodiscard]] static Columns<Ceiling> columns() {
    return Columns<Ceiling>{
               {"what", "", "name of the work", &Ceiling::name_},
               {"words", "", "what it is", &Ceiling::words_},
               {"threads", "", "that are compared with one", &Ceiling::threads_},
               {"rounds", "", "how often it was done", from(&Ceiling::turns_, rounds_of)},
               {"seconds", "s", "on one thread, the median", from(&Ceiling::turns_, &Turns::on_one, median)},
               {"seconds_on_threads", "s", "on all threads, each as much, the median",
                from(&Ceiling::turns_, &Turns::on_several, median)}} +
           gain_columns<Ceiling>(&Ceiling::turns_);
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
  std::size_t threads_ = 1;
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
  SharedSolves(const std::string& problem, const std::string& method, int intervals, std::size_t threads)
      : threads_(threads), intervals_(intervals), method_(method), made_(make_problem(problem), method, intervals) {}

  void solve(int rounds) {
    for (rounds_ = 0; rounds_ < rounds; ++rounds_) {
      turns_.on_one.push_back(seconds_on(1));
      const Eigen::VectorXd primal = std::move(solution_.primal);
      turns_.on_several.push_back(seconds_on(threads_));
      is_same_ = is_same_ && solution_.primal == primal;
    }
    judge();
  }

  [[nodiscard]] static Columns<SharedSolves> columns() {
    using Solves = SharedSolves;
    constexpr auto solution = &Solves::solution_;
    return Columns<Solves>{
               {"problem", "", "name of the problem", [](const Solves& of) { return of.made_.problem->name(); }},
               {"method", "", "family of elements", &Solves::method_},
               {"intervals", "", "number of intervals N", &Solves::intervals_},
               {"threads", "", "that are compared with one", &Solves::threads_},
               {"rounds", "", "how often it was solved, on one thread and on several", &Solves::rounds_},
               {"status", "", "of the last solve", [](const Solves& of) { return name_of(of.solution_.status); }},
               {"iterations", "", "of a solve", [](const Solves& of) { return of.iterations(); }},
               {"linear_systems", "", "of a solve", from(solution, &Solution::linear_systems)},
               {"seconds", "s", "on one thread, the median; empty where the program is not solved, as what follows",
                from(&Solves::turns_, &Turns::on_one, median)},
               {"seconds_on_threads", "s", "on all threads, the median",
                from(&Solves::turns_, &Turns::on_several, median)},
               {"ns_per_interval_iteration", "ns", "on all threads, by intervals and iterations",
                [](const Solves& of) {
                  constexpr double nanoseconds = 1e9;
                  return nanoseconds * median(of.turns_.on_several) / of.intervals_ / std::max(1.0, of.iterations());
                }}} +
           gain_columns<Solves>(&Solves::turns_) +
           Columns<Solves>{{"same_digits", "", "yes if the answers on one thread and on several are the same",
                            from(&Solves::is_same_, yes_or_no)}};
  }

 private:
  [[nodiscard]] double iterations() const { return solution_.major_iterations.value_or(0); }

  /// Times of a program that is not solved say nothing.
  void judge() {
    if (is_solved(solution_.status)) {
      judge_residuals(*made_.program, solution_);
      const double residual = scaled_residual(*made_.program, SolverOptions().tolerance, solution_);
      solution_.status = judged(solution_.status, residual);
    }
    if (!is_solved(solution_.status)) turns_ = {};
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

  std::size_t threads_;
  int intervals_;
  std::string method_;
  int rounds_ = 0;
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

/// What is solved.
struct Programs {
  std::vector<std::string> problems = paper_problem_names();
  std::vector<std::string> methods{"dmoc", "hamiltonian"};
  std::vector<int> grids{65536, 262144, 1000000};
};

/// One program after the other: those of long grids do not fit into memory together.
Table solves_table(const Programs& programs, int rounds, std::size_t threads) {
  Table table = table_of(SharedSolves::columns(), std::vector<SharedSolves>());
  for (const std::string& problem : programs.problems) {
    for (const std::string& method : programs.methods) {
      for (const int intervals : programs.grids) {
        SharedSolves solves(problem, method, intervals, threads);
        solves.solve(rounds);
        table.append(row_of(SharedSolves::columns(), solves));
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
  return table_of(Ceiling::columns(), machine);
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

}  // namespace

int run_threads(int argc, char** argv) {
  Programs programs;
  int threads = 2;
  const PageProgram program{
      .name = "threads",
      .description = "What a second thread gains in whole solves, beside what the machine gives.",
      .ends = {"", "_ceiling"},
      .columns = describe(SharedSolves::columns()) + "\nof speed_threads_ceiling.csv:\n" + describe(Ceiling::columns()),
      .options =
          [&](CommandLine& line) {
            line.list("--problem", programs.problems, "problems");
            line.list("--method", programs.methods, "methods");
            line.list("--intervals", programs.grids, "numbers of intervals");
            line.number("--threads", threads, 2, 1024, "threads that are compared with one");
          },
      .measure =
          [&](int rounds) {
            const auto several = static_cast<std::size_t>(threads);
            const Table solves = solves_table(programs, rounds, several);
            const Table machine = ceiling_table(rounds, several);
            return MeasuredPage{.title = fmt::format("What {} threads gain", threads),
                                .text = words_of_page + tables_on_page(machine, solves, several),
                                .tables = {{"", solves}, {"_ceiling", machine}}};
          }};
  return program.run(argc, argv);
}

}  // namespace dmocbench::speed

int main(int argc, char** argv) { return dmocbench::speed::run_threads(argc, argv); }
