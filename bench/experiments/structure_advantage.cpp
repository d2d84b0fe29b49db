// How much of DMOC's saving is due to the method, and how much to the solver: the same programs by solvers that use
// more or less of their structure.
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/experiments/advantage_ratios.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/indirect_reference.hpp"
#include "bench/run/meanings.hpp"
#include "methods/error.hpp"
#include "methods/solvers/interior_point/interior_point_solver.hpp"

namespace dmocbench::structure_advantage_program {

const std::vector<std::string> all_factorisations{"intervals", "sparse"};

/// Empty where the solver does not tell.
std::string linear_rounds(const SolvedCase& solved) {
  std::vector<double> seconds;
  for (const SolveTimes& round : solved.rounds) {
    if (!is_solved(solved.solution.status) || !round.linear_seconds) return {};
    seconds.push_back(*round.linear_seconds);
  }
  return joined_numbers(seconds);
}

class StructureAdvantage final : public Experiment {
 public:
  StructureAdvantage()
      : Experiment(
            {.name = "structure_advantage",
             .description =
                 "What collocation costs beside DMOC by Ipopt and by interior_point with its linear systems solved by "
                 "intervals or as any sparse matrix: iterations, linear systems, seconds. NAME_ratios.csv sets them "
                 "against DMOC at equal N and at equal error of the objective.",
             .options = {.solvers = {"ipopt", "interior_point"}, .intervals = "64:1024", .repeats = 11},
             .takes_turns = true}) {}

  [[nodiscard]] Columns<SolvedCase> columns() const override {
    return {
        {"factorisation", "", "how interior_point solves its linear systems",
         from(&SolvedCase::the_case, &Case::variant)},
        {"linear_systems", "", "linear systems of the solve", from(&SolvedCase::solution, &Solution::linear_systems)},
        {"seconds_per_iteration", "s", "wall clock of the solve by iterations", of(measured_.per_iteration)},
        {"linear_algebra_per_iteration", "s", "the same without evaluations",
         of(measured_.linear_algebra_per_iteration)},
        {"seconds_per_linear_system", "s", "factorisation and substitution", of(measured_.per_linear_system)},
        {"objective_error", "", "of the objective, relative, against the indirect solution",
         of(measured_.objective_error)},
        {"round_linear_seconds", "s", "spent in linear systems in each round, with spaces between them", linear_rounds},
    };
  }

  void add_options(CommandLine& line) override {
    line.list("--factorisation", factorisations_, "how interior_point solves its linear systems");
  }

  /// Solvers but ours have no factorisation to choose.
  [[nodiscard]] std::vector<Case> variants(const std::vector<Case>& curve) const override {
    const auto factorisations = chosen_of("--factorisation", all_factorisations, factorisations_);
    return curve.front().solver == "interior_point" ? vary(curve, factorisations) : curve;
  }

  [[nodiscard]] std::unique_ptr<Solver> solver_for(const Case& the_case, SolverOptions options) override {
    if (the_case.variant.empty()) return Experiment::solver_for(the_case, options);
    InteriorPointOptions choices = interior_point_options(named_options(this->options()));
    choices.factorisation = factorisation_named(the_case.variant);
    return std::make_unique<InteriorPointSolver>(options, std::move(choices));
  }

  void check(const std::vector<Case>& cases) override {
    for (const Case& the_case : cases) static_cast<void>(solver_for(the_case, solver_options(options())));
    reference_ = IndirectReference(options().out);
  }

  /// The indirect solution.
  [[nodiscard]] std::string shared_by(const Case& the_case) const override { return the_case.problem->name(); }

  void complete(SolvedCase& solved) override {
    measured_ = {};
    const Solution& solution = solved.solution;
    if (!is_solved(solution.status)) return;
    if (const int iterations = solution.major_iterations.value_or(0); iterations > 0) {
      measured_.per_iteration = solution.seconds / iterations;
      measured_.linear_algebra_per_iteration = (solution.seconds - solution.evaluation_seconds) / iterations;
    }
    const int systems = solution.linear_systems.value_or(0);
    if (solution.linear_seconds && systems > 0) measured_.per_linear_system = *solution.linear_seconds / systems;
    if (!is_usable(solved) || !solved.trajectory) return;
    try {
      const double exact = reference_.near(*solved.the_case.problem, *solved.trajectory).cost();
      measured_.objective_error = std::abs(solved.trajectory->cost - exact) / std::abs(exact);
    } catch (const Error& error) {
      solved.note(error.what());
    }
  }

  [[nodiscard]] nlohmann::ordered_json findings() const override { return reference_.findings(); }
  void add_findings(const JsonPlace& findings) override { reference_.add_findings(findings); }

  [[nodiscard]] std::vector<std::string> further_files() const override { return {"_ratios.csv"}; }
  void finish(const Table& table, const std::filesystem::path& prefix, nlohmann::ordered_json& metadata) override {
    write_table(prefix.string() + "_ratios.csv", advantage_ratios(table), metadata);
    metadata["references"] = reference_.metadata();
  }

 private:
  std::vector<std::string> factorisations_ = all_factorisations;
  IndirectReference reference_{std::filesystem::path()};  // of the folder of the run, once it is known
  struct {
    std::optional<double> per_iteration;
    std::optional<double> linear_algebra_per_iteration;
    std::optional<double> per_linear_system;
    std::optional<double> objective_error;
  } measured_;  // of the case that is completed
};

int run(int argc, char** argv) { return run_experiment(StructureAdvantage(), argc, argv); }

}  // namespace dmocbench::structure_advantage_program
