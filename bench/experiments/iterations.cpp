// Iteration counts, evaluations and times of solves: fig:kepler_iterations and fig:twolink_iterations.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/run/experiment.hpp"
#include "bench/tables/ratios.hpp"
#include "methods/diagnostics/kkt_fill.hpp"
#include "methods/error.hpp"
#include "methods/solvers/sqp/sqp_solver.hpp"

namespace dmocbench::iterations_program {

struct Measured {
  std::string crash;
  Solution solution;
  std::optional<long long> predicted_minors;
  KktFill fill;
  std::optional<ReplayError> replay;
};

class Iterations final : public ExperimentOf<Measured> {
 public:
  Iterations()
      : ExperimentOf({.name = "iterations",
                      .description =
                          "Counts the major and minor iterations of the solver sqp and compares the minor iterations "
                          "with the predicted number. Further columns measure the cost of the same solve in other "
                          "ways: iterations of Ipopt, evaluations of SLSQP (up to 400 free variables), seconds, and "
                          "entries of the KKT matrix and its factor. NAME_ratios.csv has these costs for collocation "
                          "relative to DMOC. By default, solves start at the problem's guess.",
                      .options = {.solvers = {"sqp"}, .intervals = "8:256", .start = "guess", .tolerance = 1e-8},
                      .further_files = {"_ratios.csv"},
                      .branches = BranchReport::of_any_start,
                      .takes_turns = true,
                      .compares_tolerances = true}) {}
  [[nodiscard]] Columns<Measured> columns() const override {
    constexpr auto solution = &Measured::solution;
    constexpr auto fill = &Measured::fill;
    return {
        {"crash", "", "first basis of sqp: none or basis", &Measured::crash, in_key},
        {"phase1_minors", "", "minor iterations of phase 1", from(solution, &Solution::phase_one_minor_iterations)},
        {"phase2_minors", "", "minor iterations of phase 2", from(solution, &Solution::phase_two_minor_iterations)},
        {"predicted_minors", "", "minor iterations predicted from the numbers of variables and major iterations",
         &Measured::predicted_minors},
        {"kkt_nonzeros", "", "entries of the lower triangle of the KKT matrix", from(fill, &KktFill::nonzeros)},
        {"factor_nonzeros", "", "nonzeros of the factor of the KKT matrix", from(fill, &KktFill::factor_nonzeros)},
        {"evaluations", "", "number of evaluations of the cost, the constraints and their derivatives",
         from(solution, &Solution::total_evaluations)},
        replay_error_column(&Measured::replay),
    };
  }
  void add_options(CommandLine& line) override {
    line.list("--crash", crashes_,
              "first basis of sqp: none (all slacks; phase 1 pivots on every constraint) or basis (a basis chosen "
              "without iterations)");
    line.ignored_unless(
        "--crash", [this] { return std::ranges::count(options().solvers, "sqp") > 0; }, "only sqp has a first basis");
  }

  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    const std::vector<std::string> crashes = chosen_of("--crash", {"none", "basis"}, crashes_);
    std::vector<Case> cases =
        vary(chosen, [&](const Case& c) { return c.solver == "sqp" ? crashes : std::vector<std::string>{""}; });
    const std::size_t left_out = std::erase_if(cases, [](const Case& the_case) {
      return the_case.solver == "nlopt" && free_variable_count(*the_case.transcribe()) > most_free_variables_for_slsqp;
    });
    if (left_out > 0 && !cases.empty())
      remark(fmt::format("nlopt is left out in cases with more than {} free variables ({} cases)",
                         most_free_variables_for_slsqp, left_out));
    if (!cases.empty()) return cases;
    throw Error("--intervals: no grid is small enough for nlopt, which is left out above {} free variables",
                most_free_variables_for_slsqp);
  }

  [[nodiscard]] SolvedCase solve(SolveTask task) override {
    if (task.the_case.solver != "sqp") return Experiment::solve(std::move(task));
    SequentialOptions choices = sequential_options(task.named_options);
    choices.crash = crash_named(task.the_case.variant.label);
    return task.by(SqpSolver(task.options, std::move(choices)));
  }

  void measure(SolvedCase& solved, Measured& measured) override {
    measured.crash = solved.the_case.variant.label;
    measured.solution = solved.solution;
    measured.predicted_minors = predicted(solved);
    measured.fill = kkt_fill(solved.program ? *solved.program : *solved.the_case.transcribe());
    if (is_solved(solved.solution.status)) measured.replay = replay(solved);
  }

  void finish(Table& table, FurtherOutput& output) override { output.write("_ratios.csv", currency_ratios(table)); }

 private:
  /// SLSQP is dense: a solve with more free variables takes seconds to minutes and gives no new information.
  static constexpr std::size_t most_free_variables_for_slsqp = 400;

  /// One minor iteration per free variable from the slack basis, per degree of freedom from a basis chosen for free,
  /// and one per later major iteration (no inequality active); empty for other solvers.
  static std::optional<long long> predicted(const SolvedCase& solved) {
    const Solution& solution = solved.solution;
    if (!solution.minor_iterations || !solution.major_iterations) return {};
    const auto free_variables = static_cast<long long>(free_variable_count(*solved.program));
    const auto constraints = static_cast<long long>(solved.program->constraint_count());
    const bool from_a_basis = solved.the_case.variant.label == "basis";
    return free_variables - (from_a_basis ? constraints : 0) + *solution.major_iterations - 1;
  }

  std::vector<std::string> crashes_{"none"};
};

int run(int argc, char** argv) { return run_experiment(Iterations(), argc, argv); }

}  // namespace dmocbench::iterations_program
