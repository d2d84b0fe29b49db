// The optimal cost over the number of intervals: fig:twolink_obj a) of the paper.
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "bench/experiments/kkt_eigenvalues.hpp"
#include "bench/run/experiment.hpp"
#include "bench/tables/selection.hpp"

namespace dmocbench::objective_program {

/// The cost of each curve on its finest grid, and by how much the grid before differs from it.
Table finest_costs(const Table& rows) {
  Table costs({"problem", "method", "N", "cost", "change from", "relative change"});
  costs.set_key({"problem", "method", "tableau", "stages", "solver", "derivatives"});
  for (const Selection& curve : Selection(rows).usable().group_by(costs.key())) {
    const Selection grids = curve.sorted_by("intervals");
    const double cost = grids.back().needed("objective");
    Row row = fields_of(curve.front(), costs.key());
    row.set("N", grids.back().text("intervals"));
    row.set("cost", fmt::format("{:.9g}", cost));
    if (grids.size() > 1) {
      const Row& before = *(grids.end() - 2);
      row.set("change from", "N = " + before.text("intervals"));
      row.set("relative change", fmt::format("{:.1e}", std::abs(before.needed("objective") / cost - 1.0)));
    }
    costs.append(std::move(row));
  }
  return costs;
}

struct Measured {
  std::optional<double> condition;
};

class Objective final : public ExperimentOf<Measured> {
 public:
  Objective()
      : ExperimentOf({.name = "objective",
                      .description = "Computes the optimal cost of each method for each number of intervals.",
                      .options = {.intervals = "16:1024"}}) {}
  [[nodiscard]] Columns<Measured> columns() const override {
    return {{"condition", "", "condition number of the equilibrated KKT matrix at the optimum (only with --condition)",
             &Measured::condition}};
  }
  void add_options(CommandLine& line) override {
    line.flag(
        "--condition", measures_condition_,
        "also compute the condition number of the KKT matrix where no bound is active (with dense linear algebra)");
  }
  void measure(SolvedCase& solved, Measured& measured) override {
    if (measures_condition_ && is_solved(solved.solution.status)) {
      measured.condition = kkt_condition(*solved.program, solved.solution);
    }
  }
  void finish(Table& table, FurtherOutput& output) override {
    output.summary.show("costs", finest_costs(table), {}, output.prefix.string() + ".csv");
  }

 private:
  bool measures_condition_ = false;
};

int run(int argc, char** argv) { return run_experiment(Objective(), argc, argv); }

}  // namespace dmocbench::objective_program
