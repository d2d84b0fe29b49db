// All problems by every method from the problems' own guesses: success, speed and accuracy.
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "bench/run/experiment.hpp"
#include "bench/run/result_file.hpp"
#include "bench/tables/profile_tables.hpp"

namespace dmocbench::profile_program {

struct Measured {
  std::optional<ReferenceOptimum> reference;
  std::optional<double> error;
  bool is_success = false;
  std::optional<int> evaluations;
  IndependentChecks checks;
};

class Profile final : public ExperimentOf<Measured> {
 public:
  Profile()
      : ExperimentOf(
            {.name = "profile",
             .description =
                 "Solves every problem with every method from the problem's own guess. NAME_profiles.csv has "
                 "performance profiles after Dolan and Moré, NAME_summary.csv has shifted geometric means. A solve "
                 "succeeds if the KKT residual is below the tolerance and the cost is within 2 % of the reference (or, "
                 "if the problem states none, of the best cost of any method); all other solves count as failures. "
                 "NAME_library.csv and NAME_library.md compare the costs on the finest grid with the reference.",
             .options = {.problems = {"all"},
                         .intervals = "32,64,128",
                         .start = "guess",
                         .tolerance = 1e-8,  // all solvers reach it
                         .most_seconds = 20.0},
             .further_files = {"_profiles.csv", "_summary.csv", "_library.csv", "_library.md"},
             .branches = BranchReport::none,
             .problems_are_independent = true}) {}
  [[nodiscard]] Columns<Measured> columns() const override {
    constexpr auto reference = &Measured::reference;
    return Columns<Measured>{
               {"success", "", "success: yes or no",
                [](const Measured& measured) { return yes_or_no(measured.is_success); }},
               {"reference_objective", "cost", "the problem's reference cost",
                from(reference, &ReferenceOptimum::objective)},
               {"reference_digits", "", "valid digits of this reference", from(reference, &ReferenceOptimum::digits)},
               {"reference_kind", "",
                "reference: stated by the problem, or the best cost of all methods on the finest grid",
                [](const Measured& measured) { return measured.reference ? stated_reference : ""; }},
               {"objective_error", "cost", "difference of the cost from reference_objective", &Measured::error},
               {"evaluations", "", "number of evaluations of the cost, the constraints and their derivatives",
                &Measured::evaluations},
           } +
           columns_through<Measured>(&Measured::checks, check_columns());
  }

  void measure(SolvedCase& solved, Measured& measured) override {
    measured.reference = solved.the_case.problem->card().reference;
    measured.evaluations = solved.solution.total_evaluations();
    const auto& reference = measured.reference;
    if (!is_solved(solved.solution.status) || !solved.trajectory) return;
    measured.checks = check_independently(solved);
    if (!reference) return;
    measured.error = std::abs(solved.trajectory->cost - reference->objective);
    measured.is_success =
        is_solved(solved.solution.status) && measured.error <= objective_tolerance * std::abs(reference->objective);
  }

  void finish(Table& table, FurtherOutput& output) override {
    table = with_best_found_references(table, objective_tolerance);
    output.write("_profiles.csv", performance_profiles(table));
    const Table summary = profile_summary(table);
    output.write("_summary.csv", summary);
    const Table library = library_table(table);
    output.write("_library.csv", library);
    write_file(output.prefix.string() + "_library.md", library_table_in_markdown(library));
    output.metadata["success"] = {{"objective_tolerance", objective_tolerance},
                                  {"most_seconds", options().most_seconds}};
    output.summary.show("successes", summary, {"method", "tableau", "stages", "solver", "successes", "instances"},
                        output.prefix.string() + "_summary.csv");
  }

 private:
  /// The largest difference of the cost from the reference, relative, that counts as a success.
  static constexpr double objective_tolerance = 0.02;
};

int run(int argc, char** argv) { return run_experiment(Profile(), argc, argv); }

}  // namespace dmocbench::profile_program
