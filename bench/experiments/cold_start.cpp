// How often a solve from a guess, or from a perturbed one, succeeds: every problem by every method, as users meet them,
// never from a solution. How many starts are solved, confirmed, and on the best branch, and at which cost.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/experiment.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/start_provider.hpp"
#include "bench/tables/cold_starts.hpp"
#include "bench/tables/ratio_interval.hpp"
#include "bench/tables/selection.hpp"
#include "methods/choose.hpp"
#include "methods/error.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/runtime/numbers_in_text.hpp"
#include "methods/solvers/solver.hpp"
#include "methods/transcription/start.hpp"
#include "methods/transcription/trajectory_reader.hpp"

namespace dmocbench::cold_start_program {

/// The counts of each problem, method and solver; the counts of all problems together if the rows exceed a screen.
Table summed_up(const Table& shares) {
  constexpr std::size_t most_rows = 12;
  ColumnNames keys{"problem", "method", "solver"};
  if (shares.rows().size() > most_rows) keys.erase(keys.begin());
  const ColumnNames counts{"starts", "solved", "confirmed", "best"};
  ColumnNames columns = keys;
  columns.insert(columns.end(), counts.begin(), counts.end());
  Table summary(columns);
  for (const Selection& group : Selection(shares).group_by(keys)) {
    Row row = fields_of(group.front(), keys);
    for (const std::string& count : counts) {
      double sum = 0.0;
      for (const Row& share : group) sum += share.number(count, 0.0);
      row.set(count, static_cast<long long>(sum));
    }
    summary.append(std::move(row));
  }
  return summary;
}

/// How many of the same starts the indirect method converges from.
struct IndirectStarts {
  std::string problem;
  long long starts = 0;
  ShareCount converged = {};
  ShareCount best = {};
};

const Columns<IndirectStarts> indirect_columns{
    {"problem", "", "name of the problem", &IndirectStarts::problem, in_key},
    {"starts", "", "number of the direct methods' cold starts, used with costates 0", &IndirectStarts::starts},
    {"converged", "", "number of starts from which two runs of the indirect method agree to 1e-6",
     [](const IndirectStarts& of) { return static_cast<long long>(of.converged.hits); }},
    {"converged_lower", "", "lower 95 % confidence limit of the share of converged starts",
     [](const IndirectStarts& of) { return wilson_interval(of.converged).lower; }},
    {"converged_upper", "", "upper 95 % confidence limit of the share of converged starts",
     [](const IndirectStarts& of) { return wilson_interval(of.converged).upper; }},
    {"best", "", "number of converged starts whose cost does not exceed the certified cost",
     [](const IndirectStarts& of) { return static_cast<long long>(of.best.hits); }}};

/// Starts per case: a number for all solvers, SOLVER=NUMBER for one of them; 0 where neither is given.
class StartCounts {
 public:
  static constexpr const char* indirect = "indirect";  ///< the indirect method, in place of a solver

  StartCounts() = default;
  /// Throws `Error` that names the option where a word is neither.
  StartCounts(const char* option, const std::vector<std::string>& words) {
    std::vector<std::string> names = solver_names();
    names.emplace_back(indirect);
    for (const std::string& word : words) {
      const std::size_t equals = word.find('=');
      const bool is_for_all = equals == std::string::npos;
      const auto count = parsed<long long>(is_for_all ? word : word.substr(equals + 1));
      if (!count || *count < 0 || *count > most) {
        throw Error("{0}: expected a number from 0 to {2} or SOLVER=NUMBER, got {1}", option, word, most);
      }
      const std::string solver = is_for_all ? all : word.substr(0, equals);
      if (!is_for_all) {
        static_cast<void>(position_of(names, std::identity(), solver, fmt::format("{}: there is no solver", option)));
      }
      counts_[solver] = *count;
    }
  }

  [[nodiscard]] long long of(const std::string& solver) const {
    const auto own = counts_.find(solver);
    if (own != counts_.end()) return own->second;
    const auto of_all = counts_.find(all);
    return of_all != counts_.end() && solver != indirect ? of_all->second : 0;
  }

 private:
  static constexpr long long most = 100000;
  static constexpr const char* all = "";
  std::map<std::string, long long> counts_;
};

class ColdStart final : public Experiment {
 public:
  ColdStart()
      : Experiment(
            {.name = "cold_start",
             .description = "Solves every case from the problem's guess and from perturbed guesses, which are the same "
                            "for all methods. NAME_shares.csv has the numbers of starts that are solved, confirmed by "
                            "integrating each interval, and on the best branch, with confidence intervals, and "
                            "quartiles of the iterations, evaluations and seconds. NAME_profiles.csv has the share of "
                            "starts solved within a budget of evaluations or seconds (for solves in a batch, only of "
                            "evaluations). Failed starts stay in the table and count. NAME_indirect.csv has the number "
                            "of trajectories from which the indirect method converges with costates 0.",
             .options = {.problems = {"all"},
                         .solvers = {"auto"},
                         .intervals = "64",
                         .start = "guess",
                         .tolerance = 1e-8,  // all solvers reach it
                         .most_iterations = 200,
                         .jobs = 2},
             .further_files = {"_shares.csv", "_profiles.csv", "_indirect.csv"},
             .branches = BranchReport::none,
             .problems_are_independent = true,
             .takes_batches = true},
            {{"start", "", "number of the cold start; 0 is the guess itself",
              from(&SolvedCase::the_case, &Case::variant, &Variant::label), in_key},
             {"evaluations", "", "number of evaluations of the cost, the constraints and their derivatives",
              from(&SolvedCase::solution, &Solution::total_evaluations)},
             {"reference_objective", "cost", "certified cost that the problem states", [](const SolvedCase& solved) {
                const auto& reference = solved.the_case.problem->card().reference;
                return reference ? std::optional(reference->objective) : std::nullopt;
              }}}) {}
  void add_options(CommandLine& line) override {
    line.list("--starts", starts_,
              "number of starts per case: NUMBER for all solvers, SOLVER=NUMBER for one solver, indirect=NUMBER for "
              "the indirect method on the paper's problems; default: 1000 on the paper's problems, 100 on others");
    line.list("--suite-starts", suite_starts_,
              "number of starts per case for problems other than the paper's; default: the value of --starts");
    line.ignored_unless(
        "--suite-starts", [this] { return has_problem(false); }, "all chosen problems are the paper's; use --starts");
    line.ignored_unless(
        "--starts", [this] { return suite_starts_.empty() || has_problem(true); }, "--suite-starts replaces --starts");
    line.number("--seed", seed_, 0, 0xffffffffU, "seed of the random curves; the same seed gives the same starts");
    line.number(
        "--amplitude", amplitude_, 0.0, 10.0,
        "amplitude of the random curves, relative to the range of each coordinate and the size of each control");
  }
  /// All methods, solvers and grids start from the same curves.
  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    using Words = std::vector<std::string>;
    paper_counts_ = StartCounts("--starts", starts_.empty() ? Words{"1000"} : starts_);
    suite_counts_ = !suite_starts_.empty() ? StartCounts("--suite-starts", suite_starts_)
                                           : StartCounts("--starts", starts_.empty() ? Words{"100"} : starts_);
    note_unchosen_solvers("--starts", starts_);
    note_unchosen_solvers("--suite-starts", suite_starts_);
    std::vector<Case> cases = from_starts(
        chosen, [this](const Case& the_case) { return starts_of(the_case); },
        [this](const Motion& motion, const Problem& problem, std::size_t start) {
          return perturbed(motion, amplitude_, seed_, start, control_scales(problem));
        });
    for (const Case& the_case : chosen) {
      varied_[the_case.problem->name()] = varied_in_words(*the_case.problem);
      problems_[the_case.problem->name()] = the_case.problem;
    }
    if (cases.empty()) throw Error("no case has a start; raise --starts or --suite-starts");
    return cases;
  }

  void finish(Table& table, FurtherOutput& output) override {
    nlohmann::ordered_json& metadata = output.metadata;
    const Table shares = cold_start_shares(table, objective_tolerance);
    output.write("_shares.csv", shares);
    output.write("_profiles.csv", cold_start_profiles(table));
    std::vector<IndirectStarts> indirect;
    const long long indirect_starts = paper_counts_.of(StartCounts::indirect);
    for (const auto& [name, problem] : problems_) {
      if (is_of_paper(name) && indirect_starts > 0) indirect.push_back(by_indirect_method(problem, indirect_starts));
    }
    if (!indirect.empty()) output.write("_indirect.csv", table_of(indirect_columns, indirect));
    metadata["start"] = "cold";
    metadata["seed"] = seed_;
    metadata["amplitude"] = amplitude_;
    metadata["objective_tolerance"] = objective_tolerance;
    for (const auto& [problem, words] : varied_) metadata["varied"][problem] = words;
    const Table summary = summed_up(shares);
    output.summary.show("shares", summary, {}, output.prefix.string() + "_shares.csv");
  }

 private:
  /// Whether a chosen problem is one of the paper's, or is another one.
  [[nodiscard]] bool has_problem(bool of_paper) const {
    const std::vector<std::string>& names = card().options.problems;
    return names == std::vector<std::string>{"all"} ||
           std::ranges::any_of(names, [&](const std::string& name) { return is_of_paper(name) == of_paper; });
  }
  /// States which counts of single solvers no case follows.
  void note_unchosen_solvers(const char* option, const std::vector<std::string>& words) const {
    for (const std::string& word : words) {
      const std::string solver = word.substr(0, std::min(word.find('='), word.size()));
      if (solver == word) continue;
      const bool is_followed = solver == StartCounts::indirect ? option == std::string("--starts") && has_problem(true)
                                                               : std::ranges::count(card().options.solvers, solver) > 0;
      if (!is_followed) remark(fmt::format("{} {} is ignored because no case is solved by {}", option, word, solver));
    }
  }
  [[nodiscard]] long long starts_of(const Case& the_case) const {
    return (is_of_paper(the_case.problem->name()) ? paper_counts_ : suite_counts_).of(the_case.solver);
  }
  /// The boundary value problem of the maximum principle from the motions of the direct methods' starts. Costates are
  /// unknown there, so that they begin at 0.
  [[nodiscard]] IndirectStarts by_indirect_method(const std::shared_ptr<const Problem>& problem,
                                                  long long starts) const {
    constexpr long long intervals = 64;
    constexpr double agreement = 1e-6;
    const Case grid{.problem = problem, .method = "dmoc", .grid = Grid::uniform(intervals)};
    const std::unique_ptr<Transcription> program = grid.transcribe();
    const Motion guess = guessed_motion(*problem);
    const auto& reference = problem->card().reference;
    const auto trials = static_cast<std::size_t>(starts);
    IndirectStarts result{problem->name(), starts, {.hits = 0, .trials = trials}, {.hits = 0, .trials = trials}};
    for (std::size_t number = 0; number < trials; ++number) {
      throw_if_interrupted();
      const Motion motion = perturbed(guess, amplitude_, seed_, number, control_scales(*problem));
      Trajectory start = read_trajectory(*program, sample(*program, motion), {});
      start.psi_q = start.psi_p = Eigen::MatrixXd::Zero(start.q.rows(), start.q.cols());
      try {
        const IndirectSolution solution =
            solve_indirect(*problem, start, {.tolerance = agreement, .most_intervals = intervals});
        if (!(solution.agreement().worst() <= agreement)) continue;
        ++result.converged.hits;
        if (reference && solution.cost() - reference->objective <= objective_tolerance * std::abs(reference->objective))
          ++result.best.hits;
      } catch (const Error&) {
        continue;  // it counts as not converged
      }
    }
    return result;
  }

  /// The largest excess of the cost over the reference, relative, of an answer on the best branch.
  static constexpr double objective_tolerance = 0.02;

  std::vector<std::string> starts_;
  std::vector<std::string> suite_starts_;
  StartCounts paper_counts_;
  StartCounts suite_counts_;
  std::uint64_t seed_ = 1;
  double amplitude_ = 0.3;
  std::map<std::string, std::string> varied_;  // the quantities that starts vary, by problem
  std::map<std::string, std::shared_ptr<const Problem>> problems_;
};

int run(int argc, char** argv) { return run_experiment(ColdStart(), argc, argv); }

}  // namespace dmocbench::cold_start_program
