// Which local minima there are and how often each method falls into which: "Global Minima", section 4.1 of the paper.
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include <Eigen/Core>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/experiment.hpp"
#include "bench/run/start_provider.hpp"
#include "bench/tables/minima.hpp"
#include "bench/tables/selection.hpp"

namespace dmocbench::local_minima_program {

struct Measured {
  std::string start;
  std::optional<double> bulge_1;
  std::optional<double> bulge_2;
  IndependentChecks checks;
};

/// How often each method finds the best minimum, and at which cost.
Table minima_found(const Table& minima, const Table& shares) {
  const ColumnNames group{"problem", "tableau", "stages", "solver", "derivatives", "intervals"};
  Table found({"problem", "N", "method", "minima", "best cost", "best in", "95 % interval", "no motion", "not solved"});
  found.set_key({"problem", "N", "method", "tableau", "stages", "solver", "derivatives"});
  for (const Row& share : shares.rows()) {
    const Selection of_group = Selection(minima).matching(share, group);
    const Selection best = of_group.where("is_best", "yes");
    Row row = fields_of(share, found.key());
    row.set("N", share.text("intervals"));
    row.set("minima",
            of_group.where([&](const Row& minimum) { return minimum.number(share.text("method"), 0.0) > 0.0; }).size());
    row.set("no motion", share.text("unconfirmed"));
    row.set("not solved", share.text("unsolved"));
    row.set("best cost", best.empty() ? "not found" : fmt::format("{:.7g}", best.front().needed("objective")));
    row.set("best in", fmt::format("{} of {}", share.text("best"), share.text("starts")));
    constexpr double percent = 100.0;
    row.set("95 % interval", fmt::format("{:.0f} to {:.0f} %", percent * share.number("share_lower", 0.0),
                                         percent * share.number("share_upper", 1.0)));
    found.append(std::move(row));
  }
  return found;
}

class LocalMinima final : public ExperimentOf<Measured> {
 public:
  LocalMinima()
      : ExperimentOf({.name = "local_minima",
                      .description = "Solves every case from many perturbed guesses. NAME_minima.csv has the minima "
                                     "found and the number of starts that end in each. NAME_shares.csv has the share "
                                     "ending in the best minimum, with a confidence interval. With --plane, the starts "
                                     "form a plane, and NAME_basins.csv has the minimum that each start reaches.",
                      .options = {.solvers = {"auto"}, .intervals = "64", .start = "guess", .jobs = 2, .batch = true},
                      .further_files = {"_minima.csv", "_shares.csv", "_basins.csv"},
                      .branches = BranchReport::none,
                      .problems_are_independent = true,
                      .takes_batches = true}) {}
  [[nodiscard]] Columns<Measured> columns() const override {
    return Columns<Measured>{{"start", "", "number of the start; 0 is the initial guess", &Measured::start, in_key},
                             {"bulge_1", "", "perturbation of the start in q_1, relative to the range of q_1 (--plane)",
                              &Measured::bulge_1},
                             {"bulge_2", "",
                              "perturbation of the start in q_2, or in q_1 with twice the frequency if there is no q_2",
                              &Measured::bulge_2}} +
           columns_through<Measured>(&Measured::checks, check_columns());
  }
  void add_options(CommandLine& line) override {
    line.number("--starts", starts_, 1, 100000, "number of starts per case: the guess and perturbed guesses");
    line.number("--seed", seed_, 0, 0xffffffffU, "seed of the random curves; the same seed gives the same starts");
    line.number("--amplitude", amplitude_, 0.0, 10.0,
                "amplitude of the random curves and of the perturbations of a plane, relative to the range of each "
                "coordinate and the size of each control");
    line.number("--plane", plane_, 2, 316,
                "use M x M starts instead of random curves: the guess plus multiples of sin(pi t/T) in q_1 and q_2, "
                "with M values from -amplitude to amplitude");
    for (const char* const option : {"--starts", "--seed"})
      line.ignored_unless(
          option, [this] { return plane_ == 0; }, "--plane already sets the starts");
  }
  /// All methods and grids start from the same curves.
  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    for (const Case& the_case : chosen) {
      varied_[the_case.problem->name()] = plane_ > 0 ? "starts vary only q and v" : varied_in_words(*the_case.problem);
    }
    return from_starts(
        chosen, [this](const Case& /*the_case*/) { return plane_ > 0 ? plane_ * plane_ : starts_; },
        [this](const Motion& motion, const Problem& problem, std::size_t start) {
          return plane_ > 0 ? bulged(motion, bulges(start))
                            : perturbed(motion, amplitude_, seed_, start, control_scales(problem));
        });
  }

  void measure(SolvedCase& solved, Measured& measured) override {
    const Variant& start = solved.the_case.variant;
    measured.start = start.label;
    if (plane_ > 0) {
      measured.bulge_1 = bulges(start.index)[0];
      measured.bulge_2 = bulges(start.index)[1];
    }
    if (is_solved(solved.solution.status)) measured.checks = check_independently(solved);
  }

  void finish(Table& table, FurtherOutput& output) override {
    nlohmann::ordered_json& metadata = output.metadata;
    const Table minima = distinct_minima(table, separation);
    const Table shares = best_minimum_shares(table, separation);
    output.write("_minima.csv", minima);
    output.write("_shares.csv", shares);
    if (plane_ > 0) {
      output.write("_basins.csv", basins(table, separation));
      metadata["starts"] = {{"plane", plane_}, {"amplitude", amplitude_}};
    } else {
      metadata["starts"] = {{"count", starts_}, {"seed", seed_}, {"amplitude", amplitude_}};
    }
    for (const auto& [problem, words] : varied_) metadata["starts"]["varied"][problem] = words;
    output.summary.show("minima", minima_found(minima, shares), {}, output.prefix.string() + "_shares.csv");
  }

 private:
  // Costs of one minimum by different methods differ by less than this share, costs of different minima by more.
  static constexpr double separation = 0.01;

  /// The sizes of the bulges of a start of the plane.
  [[nodiscard]] Eigen::Vector2d bulges(std::size_t start) const {
    const auto number = static_cast<long long>(start);
    const auto size = [&](long long step) {
      return amplitude_ * (2.0 * static_cast<double>(step) / static_cast<double>(plane_ - 1) - 1.0);
    };
    return {size(number % plane_), size(number / plane_)};
  }

  long long starts_ = 20;
  long long plane_ = 0;  // 0: random starts
  std::uint64_t seed_ = 1;
  double amplitude_ = 0.5;
  std::map<std::string, std::string> varied_;  // the quantities that starts vary, by problem
};

int run(int argc, char** argv) { return run_experiment(LocalMinima(), argc, argv); }

}  // namespace dmocbench::local_minima_program
