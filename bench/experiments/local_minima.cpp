// Which local minima there are and how often each method falls into which: "Global Minima", section 4.1 of the paper.
#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/experiment.hpp"
#include "bench/run/meanings.hpp"
#include "bench/run/start_provider.hpp"
#include "bench/tables/minima.hpp"
#include "bench/tables/selection.hpp"

namespace dmocbench::local_minima_program {

class LocalMinima final : public Experiment {
 public:
  LocalMinima()
      : Experiment(
            {.name = "local_minima",
             .description =
                 "Solves every case from many perturbed guesses; the minima found and how often each method ends in "
                 "which (NAME_minima.csv), and how often it finds the best one, with a confidence interval "
                 "(NAME_shares.csv). With --plane the starts are those of a plane, and NAME_basins.csv says where each "
                 "of them ends.",
             .options = {.intervals = "64", .start = "guess", .jobs = 2, .batch = true},
             .tells_branches = false,
             .problems_are_independent = true,
             .takes_batches = true}) {}
  [[nodiscard]] Columns<SolvedCase> columns() const override {
    return Columns<SolvedCase>{
               {"start", "", "number of the start; 0 is the guess itself", from(&SolvedCase::the_case, &Case::variant)},
               {"bulge_1", "", "of the start in q_1, in ranges of that coordinate (--plane)",
                [this](const SolvedCase& solved) { return bulge(solved.the_case, 0); }},
               {"bulge_2", "", "of the start in q_2, or of double frequency where there is no q_2",
                [this](const SolvedCase& solved) { return bulge(solved.the_case, 1); }}} +
           columns_of(checks_);
  }
  void add_options(CommandLine& line) override {
    line.number("--starts", starts_, 1, 100000, "starts per case: the guess, and perturbed ones");
    line.number("--seed", seed_, 0, 0xffffffffU, "of the random curves; the same seed gives the same starts");
    line.number("--amplitude", amplitude_, 0.0, 10.0,
                "of the random curves, and of the bulges of a plane, relative to the range of each coordinate");
    line.number(
        "--plane", plane_, 2, 316,
        "instead of random curves M x M starts: the guess with bulges sin(pi t/T) in q_1 and q_2 whose sizes go "
        "from -amplitude to amplitude in M steps");
  }
  [[nodiscard]] std::vector<Case> variants(const std::vector<Case>& curve) const override {
    std::vector<Case> all;
    const long long starts = plane_ > 0 ? plane_ * plane_ : starts_;
    for (const Case& each : curve) {
      for (long long start = 0; start < starts; ++start) all.emplace_back(each).variant = std::to_string(start);
    }
    return all;
  }
  /// All methods and grids start from the same curves.
  [[nodiscard]] Motion start_for(const Case& the_case, Motion chosen) const override {
    if (plane_ > 0) return bulged(chosen, bulges(the_case));
    return perturbed(chosen, amplitude_, seed_, static_cast<std::uint64_t>(std::stoll(the_case.variant)));
  }

  void complete(SolvedCase& solved) override {
    checks_ = {};
    if (is_solved(solved.solution.status) && solved.trajectory) checks_ = check_independently(solved);
  }

  [[nodiscard]] std::vector<std::string> further_files() const override {
    return {"_minima.csv", "_shares.csv", "_basins.csv"};
  }
  void finish(const Table& table, const std::filesystem::path& prefix, nlohmann::ordered_json& metadata) override {
    const Table minima = distinct_minima(table, separation);
    const Table shares = best_minimum_shares(table, separation);
    write_table(prefix.string() + "_minima.csv", minima, metadata);
    write_table(prefix.string() + "_shares.csv", shares, metadata);
    if (plane_ > 0) {
      write_table(prefix.string() + "_basins.csv", basins(table, separation), metadata);
      metadata["starts"] = {{"plane", plane_}, {"amplitude", amplitude_}};
    } else {
      metadata["starts"] = {{"count", starts_}, {"seed", seed_}, {"amplitude", amplitude_}};
    }
    for (const Selection& minimum :
         Selection(minima)
             .where("is_best", "yes")
             .group_by({"problem", "intervals", "stages", "tableau", "solver", "derivatives"})) {
      const Row& best = minimum.front();
      fmt::print("{}, N = {}: the best minimum found by any method here costs {:.7g}\n", best.text("problem"),
                 best.text("intervals"), best.needed("objective"));
    }
    for (const Row& row : shares.rows()) {
      if (Selection(minima)
              .matching(row, {"problem", "tableau", "stages", "solver", "derivatives", "intervals"})
              .where("is_best", "yes")
              .empty()) {
        fmt::print(
            "{} {}: no answer of any method is confirmed to be a motion, so that none is the best: {} of {} solved\n",
            row.text("problem"), row.text("method"), row.text("solved"), row.text("starts"));
        continue;
      }
      fmt::print("{} {}: best minimum in {} of {} ({:.0f} to {:.0f} %)\n", row.text("problem"), row.text("method"),
                 row.text("best"), row.text("starts"), 100.0 * row.number("share_lower").value_or(0.0),
                 100.0 * row.number("share_upper").value_or(1.0));
    }
  }

 private:
  // Costs of one minimum by different methods differ by less than this share, those of different minima by more.
  static constexpr double separation = 0.01;

  /// The sizes of the bulges of a start of the plane.
  [[nodiscard]] Eigen::Vector2d bulges(const Case& the_case) const {
    const long long number = std::stoll(the_case.variant);
    const auto size = [&](long long step) {
      return amplitude_ * (2.0 * static_cast<double>(step) / static_cast<double>(plane_ - 1) - 1.0);
    };
    return {size(number % plane_), size(number / plane_)};
  }
  [[nodiscard]] std::optional<double> bulge(const Case& the_case, Eigen::Index which) const {
    return plane_ > 0 ? std::optional(bulges(the_case)[which]) : std::nullopt;
  }

  long long starts_ = 20;
  long long plane_ = 0;  // 0: random starts
  std::uint64_t seed_ = 1;
  double amplitude_ = 0.5;
  IndependentChecks checks_;  // of the case that is completed
};

int run(int argc, char** argv) { return run_experiment(LocalMinima(), argc, argv); }

}  // namespace dmocbench::local_minima_program
