// All problems by every method from the problems' own guesses: success, speed and accuracy.
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/experiment.hpp"
#include "bench/run/meanings.hpp"
#include "bench/run/result_file.hpp"
#include "bench/tables/profile_tables.hpp"

namespace dmocbench::profile_program {

class Profile final : public Experiment {
 public:
  Profile()
      : Experiment(
            {.name = "profile",
             .description =
                 "Every problem by every method from the problem's own guess: performance profiles after Dolan and "
                 "Moré (NAME_profiles.csv) and shifted geometric means (NAME_summary.csv). Success is a KKT residual "
                 "below the tolerance and a cost within --objective-tolerance of the reference (where a problem states "
                 "none, of the best found by any method here); all else counts as never. NAME_library.csv and "
                 "NAME_library.md hold every cost at the finest grid beside the reference.",
             .options = {.problems = {"all"},
                         .intervals = "32,64,128",
                         .start = "guess",
                         .tolerance = 1e-8,  // all solvers reach it
                         .most_seconds = 20.0},
             .tells_branches = false,
             .problems_are_independent = true}) {}
  [[nodiscard]] Columns<SolvedCase> columns() const override {
    const auto& reference = measured_.reference;
    return Columns<SolvedCase>{
               {"success", "", "yes or no", [this](const SolvedCase&) { return measured_.is_success ? "yes" : "no"; }},
               {"reference_objective", "cost", "cost that the problem states",
                of(reference, &ReferenceOptimum::objective)},
               {"reference_digits", "", "digits of it that hold", of(reference, &ReferenceOptimum::digits)},
               {"reference_kind", "", "stated by the problem, or the best cost on the finest grid by any method here",
                [this](const SolvedCase&) { return measured_.reference ? stated_reference : ""; }},
               {"objective_error", "cost", "distance from it", of(measured_.error)},
               {"evaluations", "", "calls of the cost, the constraints and their derivatives by the solver",
                from(&SolvedCase::solution, &Solution::total_evaluations)},
           } +
           columns_of(measured_.checks);
  }
  void add_options(CommandLine& line) override {
    line.number("--objective-tolerance", objective_tolerance_, 0.0, 1.0,
                "largest difference of the cost from the reference, relative, that counts as a success");
  }

  void complete(SolvedCase& solved) override {
    measured_ = {};
    measured_.reference = solved.the_case.problem->card().reference;
    const auto& reference = measured_.reference;
    if (!is_solved(solved.solution.status) || !solved.trajectory) return;
    measured_.checks = check_independently(solved);
    if (!reference) return;
    measured_.error = std::abs(solved.trajectory->cost - reference->objective);
    measured_.is_success =
        is_solved(solved.solution.status) && measured_.error <= objective_tolerance_ * std::abs(reference->objective);
  }

  [[nodiscard]] Table compared(const Table& table) const override {
    return with_best_found_references(table, objective_tolerance_);
  }
  [[nodiscard]] std::vector<std::string> further_files() const override {
    return {"_profiles.csv", "_summary.csv", "_library.csv", "_library.md"};
  }
  void finish(const Table& table, const std::filesystem::path& prefix, nlohmann::ordered_json& metadata) override {
    write_table(prefix.string() + "_profiles.csv", performance_profiles(table), metadata);
    const Table summary = profile_summary(table);
    write_table(prefix.string() + "_summary.csv", summary, metadata);
    const Table library = library_table(table);
    write_table(prefix.string() + "_library.csv", library, metadata);
    write_file(prefix.string() + "_library.md", library_table_in_markdown(library));
    metadata["success"] = {{"objective_tolerance", objective_tolerance_}, {"most_seconds", options().most_seconds}};
    for (const Row& row : summary.rows()) {
      fmt::print("{:<12} {} {} {:<6} {} of {} instances\n", row.text("method"), row.text("tableau"), row.text("stages"),
                 row.text("solver"), row.text("successes"), row.text("instances"));
    }
  }

 private:
  double objective_tolerance_ = 0.02;
  struct {
    std::optional<ReferenceOptimum> reference;
    std::optional<double> error;
    bool is_success = false;
    IndependentChecks checks;
  } measured_;  // of the case that is completed
};

int run(int argc, char** argv) { return run_experiment(Profile(), argc, argv); }

}  // namespace dmocbench::profile_program
