// Across the library: what every method solves from the problems' own guesses, how fast and how accurately.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiment/experiment.hpp"
#include "bench/experiment/independent_checks.hpp"
#include "bench/experiment/result_file.hpp"
#include "bench/summary/library_table.hpp"
#include "bench/summary/performance_profile.hpp"

namespace dmocbench {

namespace {

class Profile final : public Experiment {
 public:
  [[nodiscard]] std::string name() const override { return "profile"; }
  [[nodiscard]] std::string description() const override {
    return "Every problem by every method from the problem's own guess: performance profiles after Dolan and Moré "
           "(NAME_profiles.csv) and shifted geometric means (NAME_summary.csv). Success is a KKT residual below the "
           "tolerance and a cost within --objective-tolerance of the reference; all else counts as never. "
           "NAME_library.csv and NAME_library.md hold every cost at the finest grid beside the reference.";
  }
  [[nodiscard]] std::string default_intervals() const override { return "32,64,128"; }
  void set_defaults(ExperimentOptions& options) const override {
    options.problems = {"all"};
    options.start = "guess";
    constexpr double tolerance_that_all_solvers_reach = 1e-8;
    options.tolerance = tolerance_that_all_solvers_reach;
  }
  [[nodiscard]] bool problems_are_independent() const override { return true; }
  [[nodiscard]] bool tells_branches() const override { return false; }
  [[nodiscard]] std::vector<std::string> own_columns() const override {
    std::vector<std::string> columns{"success", "reference_objective", "reference_digits", "objective_error",
                                     "evaluations"};
    columns.insert(columns.end(), independent_check_columns().begin(), independent_check_columns().end());
    return columns;
  }
  void add_options(CommandLine& line) override {
    line.option("--objective-tolerance", objective_tolerance_,
                "largest difference of the cost from the reference, relative, that counts as a success")
        .range(0.0, 1.0)
        .shows_default();
    line.option("--seconds", most_seconds_, "time after which a solve has failed")
        .range(0.0, longest_time)
        .shows_default();
  }
  [[nodiscard]] SolverOptions options_for(const Case& /*what*/, SolverOptions common) override {
    common.most_seconds = most_seconds_;
    return common;
  }

  void complete(SolvedCase& solved) override {
    Row& row = solved.row;
    row.set("success", "no");
    row.set("evaluations", solved.solution.evaluations);
    const auto reference = solved.what.problem->card().reference;
    if (!reference) return;
    row.set("reference_objective", reference->objective);
    row.set("reference_digits", static_cast<long long>(reference->digits));
    if (!is_solved(solved.solution.status) || !solved.trajectory) return;
    const double error = std::abs(solved.trajectory->cost - reference->objective);
    row.set("objective_error", error);
    if (error <= objective_tolerance_ * std::abs(reference->objective)) row.set("success", "yes");
    check_independently(solved);
  }

  void finish(const Table& table, const std::filesystem::path& prefix, nlohmann::ordered_json& metadata) override {
    write_file(prefix.string() + "_profiles.csv", performance_profiles(table).csv());
    const Table summary = profile_summary(table);
    write_file(prefix.string() + "_summary.csv", summary.csv());
    const Table library = library_table(table);
    write_file(prefix.string() + "_library.csv", library.csv());
    write_file(prefix.string() + "_library.md", library_table_in_markdown(library));
    metadata["success"] = {{"objective_tolerance", objective_tolerance_}, {"most_seconds", most_seconds_}};
    for (const Row& row : summary.rows()) {
      fmt::print("{:<12} {} {} {:<6} {} of {} instances\n", row.text("method"), row.text("tableau"), row.text("stages"),
                 row.text("solver"), row.text("successes"), row.text("instances"));
    }
  }

 private:
  static constexpr double longest_time = 1e6;
  double objective_tolerance_ = 0.02;
  double most_seconds_ = 20.0;
};

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) {
  dmocbench::Profile experiment;
  return dmocbench::run_experiment(experiment, argc, argv);
}
