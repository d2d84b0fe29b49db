// Error constants: the limits of errors times N^p, predicted by the local errors of the exact optimum and measured.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/run/experiment.hpp"
#include "bench/run/indirect_reference.hpp"
#include "bench/tables/selection.hpp"
#include "methods/diagnostics/leading_errors.hpp"
#include "methods/diagnostics/trajectory_error.hpp"
#include "methods/indirect/solve_indirect.hpp"

namespace dmocbench::error_constants_program {

struct Measured {
  std::optional<double> state;
  std::optional<double> replay;
  std::optional<double> predicted_replay;
  std::optional<double> objective;
  std::optional<double> predicted_objective;
};

const ColumnNames quantities{"state_error", "replay_error", "predicted_replay_error", "objective_error",
                             "predicted_objective_error"};
const ColumnNames curve_columns{"problem", "method", "tableau", "stages", "solver", "derivatives"};
constexpr std::size_t fewest_grids = 3;
/// The tolerance of replays. Grids whose replay error is less than ten thousand times as large belong to no limit.
constexpr double replay_tolerance = 1e-12;
constexpr double least_replay_error = 1e4 * replay_tolerance;

/// The limit of an error times N^p on a curve.
struct Limit {
  Row head;
  std::string quantity;
  double finest = 0.0;
  double constant = 0.0;
  double uncertainty = 0.0;
};

const Columns<Limit> limit_columns =
    head_columns<Limit>(curve_columns, in_key) +
    Columns<Limit>{
        {"quantity", "", "kind of error: the name of a column of the table of errors", &Limit::quantity, in_key},
        {"finest", "", "N of the finest grid used", &Limit::finest},
        {"constant", "", "limit of the error times N^p, extrapolated from the two finest grids", &Limit::constant},
        {"uncertainty", "",
         "change of the limit when the finest grid is left out; for replays, plus their tolerance times N^p",
         &Limit::uncertainty}};

/// lim e(N) N^p from a grid and the next one, for e(N) = c N^-p (1 + a/N^2): these errors are series in N^-2.
double extrapolated(const Row& coarser, const Row& finer, const std::string& column, int order) {
  const auto scaled = [&](const Row& row) { return row.needed(column) * std::pow(row.needed("intervals"), order); };
  const double refinement = finer.needed("intervals") / coarser.needed("intervals");
  return scaled(finer) + (scaled(finer) - scaled(coarser)) / (refinement * refinement - 1.0);
}

std::vector<Limit> limits_of(const Table& rows) {
  std::vector<Limit> limits;
  const Selection predicted =
      Selection(rows).usable().with_number("predicted_objective_error").where([](const Row& row) {
        return row.needed("replay_error") > least_replay_error;
      });
  for (const Selection& curve : predicted.group_by(curve_columns)) {
    if (curve.size() < fewest_grids) continue;
    const Selection grids = curve.sorted_by("intervals");
    const auto finest = grids.end() - 1;
    const int order = make_tableau(grids.back().text("tableau"), static_cast<int>(grids.back().needed("stages"))).order;
    for (const std::string& quantity : quantities) {
      const double constant = extrapolated(*(finest - 1), *finest, quantity, order);
      const double resolution = quantity.ends_with("replay_error")
                                    ? replay_tolerance * std::pow(grids.back().needed("intervals"), order)
                                    : 0.0;
      const double before = extrapolated(*(finest - 2), *(finest - 1), quantity, order);
      limits.push_back({.head = fields_of(grids.back(), curve_columns),
                        .quantity = quantity,
                        .finest = grids.back().needed("intervals"),
                        .constant = constant,
                        .uncertainty = std::abs(constant - before) + resolution});
    }
  }
  return limits;
}

class ErrorConstants final : public ExperimentOf<Measured> {
 public:
  ErrorConstants()
      : ExperimentOf({.name = "error_constants",
                      .description = "Measures the errors of the replay and of the cost, and predicts them from the "
                                     "local errors of the exact optimum in the discrete flow, without computing a "
                                     "discrete optimum. NAME_limits.csv has the limits of all errors times N^p.",
                      .options = {.methods = {"dmoc", "tangent", "second_order"},
                                  .solvers = {"interior_point"},
                                  .intervals = "128:1024"},
                      .further_files = {"_limits.csv"},
                      .polishes = true}) {}

  [[nodiscard]] Columns<Measured> columns() const override {
    return {{"state_error", "", "largest error of q over the nodes", &Measured::state},
            {"replay_error", "", "distance from the final state in (q, v) at the end of a replay", &Measured::replay},
            {"predicted_replay_error", "", "replay error to leading order, from the exact optimum",
             &Measured::predicted_replay},
            {"objective_error", "cost", "cost minus the optimal cost", &Measured::objective},
            {"predicted_objective_error", "cost", "cost error to leading order, from the exact optimum",
             &Measured::predicted_objective}};
  }

  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    std::vector<Case> cases = chosen;
    for (Case& each : cases) {
      require_indirect(*each.problem);
      each.shares = each.problem->name();
    }
    indirect_ = std::make_shared<IndirectReference>(options().out);
    return cases;
  }

  void measure(SolvedCase& solved, Measured& measured) override {
    if (!is_usable(solved) || !solved.trajectory) return;
    const Problem& problem = *solved.the_case.problem;
    const Trajectory& trajectory = *solved.trajectory;
    const Trajectory optimum = indirect_->near(problem, trajectory).sampled_like(trajectory);
    const LeadingErrors predicted = leading_errors(problem, *make_element(solved.the_case.method), optimum);
    measured = {.state = trajectory_error(trajectory, optimum).state,
                .replay = replay_error(problem, trajectory, replay_tolerance).norm(),
                .predicted_replay = predicted.replay.norm(),
                .objective = trajectory.cost - optimum.cost,
                .predicted_objective = predicted.cost};
  }

  void finish(Table& table, FurtherOutput& output) override {
    output.metadata["references"] = indirect_->metadata();
    const Table limits = table_of(limit_columns, limits_of(table));
    output.write("_limits.csv", limits);
    output.summary.show("limits", limits, {"problem", "method", "stages", "quantity", "constant", "uncertainty"},
                        output.prefix.string() + "_limits.csv");
  }
};

int run(int argc, char** argv) { return run_experiment(ErrorConstants(), argc, argv); }

}  // namespace dmocbench::error_constants_program
