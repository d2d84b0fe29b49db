// Which local minima there are and how often each method falls into which: "Global Minima", section 4.1 of the paper.
#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/experiment/experiment.hpp"
#include "bench/experiment/meanings.hpp"
#include "bench/experiment/start_provider.hpp"
#include "bench/summary/minima.hpp"

namespace dmocbench::local_minima_program {

class LocalMinima final : public Experiment {
 public:
  LocalMinima()
      : Experiment(
            {.name = "local_minima",
             .description =
                 "Solves every case from many perturbed guesses; the minima found and how often each method ends in "
                 "which (NAME_minima.csv), and how often it finds the best one, with a confidence interval "
                 "(NAME_shares.csv).",
             .options = {.intervals = "64", .start = "guess", .jobs = 2, .batch = true},
             .tells_branches = false,
             .problems_are_independent = true,
             .takes_batches = true}) {}
  [[nodiscard]] Columns<SolvedCase> columns() const override {
    return Columns<SolvedCase>{{"start", "", "number of the start; 0 is the guess itself",
                                from(&SolvedCase::the_case, &Case::variant)}} +
           columns_of(checks_);
  }
  void add_options(CommandLine& line) override {
    line.number("--starts", starts_, 1, 100000, "starts per case: the guess, and perturbed ones");
    line.number("--seed", seed_, 0, 0xffffffffU, "of the random curves; the same seed gives the same starts");
    line.number("--amplitude", amplitude_, 0.0, 10.0, "of the random curves, relative to the range of each coordinate");
  }
  [[nodiscard]] std::vector<Case> variants(const std::vector<Case>& curve) const override {
    std::vector<Case> all;
    for (const Case& each : curve) {
      for (long long start = 0; start < starts_; ++start) all.emplace_back(each).variant = std::to_string(start);
    }
    return all;
  }
  /// All methods and grids start from the same curves.
  [[nodiscard]] Motion start_for(const Case& the_case, Motion chosen) const override {
    return perturbed(chosen, amplitude_, seed_, static_cast<std::uint64_t>(std::stoll(the_case.variant)));
  }

  void complete(SolvedCase& solved) override {
    checks_ = {};
    if (is_solved(solved.solution.status) && solved.trajectory) checks_ = check_independently(solved);
  }

  [[nodiscard]] std::vector<std::string> further_files() const override { return {"_minima.csv", "_shares.csv"}; }
  void finish(const Table& table, const std::filesystem::path& prefix, nlohmann::ordered_json& metadata) override {
    const Table minima = distinct_minima(table, separation);
    const Table shares = best_minimum_shares(table, separation);
    write_table(prefix.string() + "_minima.csv", minima, metadata);
    write_table(prefix.string() + "_shares.csv", shares, metadata);
    metadata["starts"] = {{"count", starts_}, {"seed", seed_}, {"amplitude", amplitude_}};
    for (const Row& row : shares.rows()) {
      fmt::print("{} {}: best minimum in {} of {} ({:.0f} to {:.0f} %)\n", row.text("problem"), row.text("method"),
                 row.text("best"), row.text("starts"), 100.0 * row.number("share_lower").value_or(0.0),
                 100.0 * row.number("share_upper").value_or(1.0));
    }
  }

 private:
  // Costs of one minimum by different methods differ by less than this share, those of different minima by more.
  static constexpr double separation = 0.01;

  long long starts_ = 20;
  std::uint64_t seed_ = 1;
  double amplitude_ = 0.5;
  IndependentChecks checks_;  // of the case that is completed
};

int run(int argc, char** argv) { return run_experiment(LocalMinima(), argc, argv); }

}  // namespace dmocbench::local_minima_program
