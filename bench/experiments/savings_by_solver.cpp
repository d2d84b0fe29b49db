// How much of DMOC's saving is due to the method, and how much to the solver: the same programs by solvers that use
// more or less of their structure.
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/run/experiment.hpp"
#include "bench/run/indirect_reference.hpp"
#include "bench/tables/ratios.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"

namespace dmocbench::savings_by_solver_program {

const std::vector<std::string> all_factorisations{"intervals", "sparse"};

/// Empty if the solver does not report it.
std::string linear_rounds(const SolvedCase& solved) {
  std::vector<double> seconds;
  for (const SolveTimes& round : solved.rounds) {
    if (!is_solved(solved.solution.status) || !round.linear_seconds) return {};
    seconds.push_back(*round.linear_seconds);
  }
  return joined_numbers(seconds);
}

struct Measured {
  std::string factorisation;
  std::optional<int> linear_systems;
  std::optional<double> per_iteration;
  std::optional<double> linear_algebra_per_iteration;
  std::optional<double> per_linear_system;
  std::optional<double> objective_error;
  std::string linear_rounds;
};

class StructureAdvantage final : public ExperimentOf<Measured> {
 public:
  StructureAdvantage()
      : ExperimentOf({.name = "savings_by_solver",
                      .description =
                          "Measures the computational cost of collocation relative to DMOC in iterations, linear "
                          "systems and seconds, with Ipopt and with interior_point, which solves its linear systems "
                          "interval by interval or as a general sparse matrix. NAME_ratios.csv has the ratios to "
                          "DMOC at equal N and at equal error of the objective.",
                      .options = {.solvers = {"ipopt", "interior_point"}, .intervals = "64:1024", .repeats = 11},
                      .further_files = {"_ratios.csv"},
                      .takes_turns = true}) {}

  [[nodiscard]] Columns<Measured> columns() const override {
    return {
        {"factorisation", "", "factorisation of interior_point's linear systems", &Measured::factorisation, in_key},
        {"linear_systems", "", "number of linear systems solved", &Measured::linear_systems},
        {"seconds_per_iteration", "s", "wall-clock time of the solve divided by its iterations",
         &Measured::per_iteration},
        {"linear_algebra_per_iteration", "s", "time of an iteration without evaluations",
         &Measured::linear_algebra_per_iteration},
        {"seconds_per_linear_system", "s", "time of a factorisation and a substitution", &Measured::per_linear_system},
        {"objective_error", "", "relative error of the objective with respect to the indirect solution",
         &Measured::objective_error},
        {"round_linear_seconds", "s", "time spent in linear systems in each round, separated by spaces",
         &Measured::linear_rounds},
    };
  }

  void add_options(CommandLine& line) override {
    line.list("--factorisation", factorisations_, "factorisation of interior_point's linear systems");
    line.ignored_unless(
        "--factorisation", [this] { return std::ranges::count(options().solvers, "interior_point") > 0; },
        "only interior_point offers a choice of factorisations");
  }

  /// Solvers but ours have no factorisation to choose.
  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    const auto factorisations = chosen_of("--factorisation", all_factorisations, factorisations_);
    std::vector<Case> cases = vary(chosen, [&](const Case& c) {
      return c.solver == "interior_point" ? factorisations : std::vector<std::string>{""};
    });
    for (Case& the_case : cases) the_case.shares = the_case.problem->name();
    indirect_ = std::make_shared<IndirectReference>(options().out);
    return cases;
  }

  [[nodiscard]] SolvedCase solve(SolveTask task) override {
    const std::string& factorisation = task.the_case.variant.label;
    if (factorisation.empty()) return Experiment::solve(std::move(task));
    InteriorPointOptions choices = interior_point_options(task.named_options);
    choices.factorisation = factorisation_named(factorisation);
    return task.by(InteriorPointSolver(task.options, std::move(choices)));
  }

  void measure(SolvedCase& solved, Measured& measured) override {
    measured.factorisation = solved.the_case.variant.label;
    measured.linear_systems = solved.solution.linear_systems;
    measured.linear_rounds = linear_rounds(solved);
    const Solution& solution = solved.solution;
    if (!is_solved(solution.status)) return;
    if (const int iterations = solution.major_iterations.value_or(0); iterations > 0) {
      measured.per_iteration = solution.seconds / iterations;
      measured.linear_algebra_per_iteration = (solution.seconds - solution.evaluation_seconds) / iterations;
    }
    const int systems = solution.linear_systems.value_or(0);
    if (solution.linear_seconds && systems > 0) measured.per_linear_system = *solution.linear_seconds / systems;
    if (!is_usable(solved) || !solved.trajectory) return;
    const double exact = indirect_->near(*solved.the_case.problem, *solved.trajectory).cost();
    measured.objective_error = std::abs(solved.trajectory->cost - exact) / std::abs(exact);
  }

  void finish(Table& table, FurtherOutput& output) override {
    output.write("_ratios.csv", advantage_ratios(table));
    output.metadata["references"] = indirect_->metadata();
  }

 private:
  std::vector<std::string> factorisations_ = all_factorisations;
};

int run(int argc, char** argv) { return run_experiment(StructureAdvantage(), argc, argv); }

}  // namespace dmocbench::savings_by_solver_program
