// Orders for nonsmooth and smooth optimal controls: (main_theorem) and its remark on constraints.
#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "bench/experiments/convergence/situation.hpp"
#include "bench/experiments/smoothness/optimum_error.hpp"
#include "bench/run/column.hpp"
#include "bench/run/options.hpp"
#include "bench/run/start_provider.hpp"
#include "bench/run/table_run.hpp"
#include "methods/error.hpp"
#include "methods/transcription/elements/families.hpp"

namespace dmocbench::smoothness_program {

constexpr std::array quantities{
    std::pair{"state", &OptimumError::state},         std::pair{"costate_q", &OptimumError::costate_q},
    std::pair{"costate_p", &OptimumError::costate_p}, std::pair{"node_control", &OptimumError::node_control},
    std::pair{"control", &OptimumError::control},     std::pair{"objective", &OptimumError::objective}};

struct Measured {
  const Situation* situation = nullptr;
  Scheme scheme;
  std::string status;
  bool is_exact = false;
  long long intervals = 0;
  double h = 0.0;
  std::optional<OptimumError> error = std::nullopt;
};

struct MeasuredOrder {
  const Situation* situation = nullptr;
  Scheme scheme;
  int order = 0;
  std::string quantity;
  FittedOrder fit;
};

template <class Record>
Columns<Record> situation_columns() {
  return Columns<Record>{{"situation", "", "name of the problem with its bounds and final state",
                          from(&Record::situation, &Situation::name), in_key},
                         {"active", "", "quantities whose bounds are active along the optimum",
                          from(&Record::situation, &Situation::active)},
                         {"end", "", "final state: fixed or free", from(&Record::situation, &Situation::end)}} +
         scheme_columns<Record>();
}

const Columns<Measured> error_columns =
    situation_columns<Measured>() +
    Columns<Measured>{
        {"status", "", "status of the solve", &Measured::status},
        {"reference", "", "reference of the errors: closed form or finer grid",
         [](const Measured& m) { return m.is_exact ? "closed form" : "finer grid"; }},
        {"intervals", "", "number of intervals N", &Measured::intervals, in_key},
        {"h", "", "step", &Measured::h},
        {"state_error", "", "largest error of (q, p) over the nodes", from(&Measured::error, &OptimumError::state)},
        {"costate_q_error", "", "largest error of psi^q over the nodes",
         from(&Measured::error, &OptimumError::costate_q)},
        {"costate_p_error", "", "largest error of psi^p over the nodes",
         from(&Measured::error, &OptimumError::costate_p)},
        {"node_control_error", "", "largest error of u(x_k, psi_k) over the nodes",
         from(&Measured::error, &OptimumError::node_control)},
        {"control_error", "", "largest error of u over the stages", from(&Measured::error, &OptimumError::control)},
        {"objective_error", "", "error of the cost", from(&Measured::error, &OptimumError::objective)}};

const Columns<MeasuredOrder> order_columns =
    situation_columns<MeasuredOrder>() +
    Columns<MeasuredOrder>{
        {"order", "", "order of the tableau", &MeasuredOrder::order},
        {"quantity", "",
         "quantity whose error is fitted; where bounds are active, its largest error on a grid and all finer grids",
         &MeasuredOrder::quantity, in_key}} +
    fitted_order_columns(&MeasuredOrder::fit);

/// The largest error on each grid and all finer ones. Where a kink lies inside an interval, the error's factor changes
/// its sign with the place of the kink, and some grids are better than the order by accident.
std::vector<GridError> envelope(std::vector<GridError> points) {
  std::ranges::sort(points, {}, &GridError::step);
  for (std::size_t i = 1; i < points.size(); ++i) points[i].error = std::max(points[i].error, points[i - 1].error);
  return points;
}

class Smoothness {
 public:
  explicit Smoothness(const TableRun& run) : run_(run) {}

  /// Fills in which bounds are active if the situation does not state it.
  void measure(Situation& situation) {
    const Trajectory finer = finest(situation);
    if (situation.active.empty()) situation.active = active_bounds(*situation.problem, finer);
    const KnownOptimum optimum(*situation.problem, situation.has_closed_form ? std::nullopt : std::optional(finer));
    const Start start{smooth_motion(finer)};
    for (const std::string& method : paper_families()) {
      for (const int stages : {1, 2}) follow(situation, optimum, start, method, stages);
    }
  }
  [[nodiscard]] const std::vector<Measured>& errors() const noexcept { return errors_; }
  [[nodiscard]] const std::vector<MeasuredOrder>& orders() const noexcept { return orders_; }

 private:
  [[nodiscard]] static Case case_of(const Situation& situation, const std::string& method, int stages,
                                    long long intervals) {
    return {.problem = situation.problem,
            .method = method,
            .stages = stages,
            .solver = "interior_point",
            .grid = Grid::uniform(intervals)};
  }
  [[nodiscard]] SolvedCase solve(const Case& the_case, const Start& start) const {
    run_.show(the_case.label());
    return solve_case(the_case, start, *solver_, options_.tolerance, 1, true);
  }
  /// DMOC on a grid that is five times finer than the finest one that is measured.
  [[nodiscard]] Trajectory finest(const Situation& situation) {
    Case common = case_of(situation, "dmoc", 1, 128);
    common.problem = situation.base;
    const SolvedCase coarse = solve(case_of(situation, "dmoc", 1, 128), starts_.start_for(common));
    if (!coarse.trajectory) throw Error(situation.name + " could not be solved: " + coarse.solution.message);
    const SolvedCase fine =
        solve(case_of(situation, "dmoc", 2, finer_intervals), Start{smooth_motion(*coarse.trajectory)});
    if (!fine.trajectory || !is_solved(fine.solution.status))
      throw Error(situation.name + " is not solved on the reference grid: " + fine.solution.message);
    return *fine.trajectory;
  }
  void follow(const Situation& situation, const KnownOptimum& optimum, const Start& start, const std::string& method,
              int stages) {
    const Scheme scheme{situation.problem->name(), method, "gauss", stages};
    const bool is_smooth = situation.active == "nothing";
    std::array<std::vector<GridError>, quantities.size()> points;
    for (const long long intervals : measured_intervals) {
      const SolvedCase solved = solve(case_of(situation, method, stages, intervals), start);
      const double h = situation.problem->horizon() / static_cast<double>(intervals);
      Measured measured{.situation = &situation,
                        .scheme = scheme,
                        .status = std::string(name_of(solved.solution.status)),
                        .is_exact = optimum.is_exact(),
                        .intervals = intervals,
                        .h = h};
      if (solved.trajectory && is_solved(solved.solution.status)) measured.error = optimum.error_of(*solved.trajectory);
      errors_.push_back(measured);
      if (!measured.error) continue;
      for (std::size_t i = 0; i < quantities.size(); ++i) {
        const double error = *measured.error.*quantities[i].second;
        if (is_smooth || intervals >= coarsest_fitted) points[i].push_back({h, error});
      }
    }
    for (std::size_t i = 0; i < quantities.size(); ++i) {
      const auto fit = is_smooth ? asymptotic_order(points[i], rounding) : fit_envelope(points[i]);
      if (fit) orders_.push_back({&situation, scheme, 2 * stages, quantities[i].first, *fit});
    }
  }
  /// Where kinks move within their intervals from grid to grid neighbouring orders scatter, and no range has one order:
  /// all grids are used, four at least.
  [[nodiscard]] static std::optional<FittedOrder> fit_envelope(std::vector<GridError> points) {
    std::erase_if(points, [](const GridError& point) { return !(point.error > rounding); });
    const auto fit = fit_order(envelope(std::move(points)));
    return fit && std::cmp_greater_equal(fit->points, fewest_grids) ? fit : std::nullopt;
  }

  // A kink of the closed forms divides its interval 1 : 2 on all of them, and all nodes are nodes of the finer grid.
  static constexpr std::array measured_intervals{20LL, 32LL, 40LL, 64LL, 80LL, 128LL, 160LL, 256LL};
  static constexpr long long coarsest_fitted = 32;
  static constexpr long long finer_intervals = 1280;
  static constexpr double rounding = 1e-11;  // below it are solver and rounding, not the grid
  const TableRun& run_;
  SolverOptions options_ = TableRun::solver_options();
  StartProvider starts_{{}, options_};
  std::unique_ptr<Solver> solver_ = make_solver("interior_point", options_);
  std::vector<Measured> errors_;
  std::vector<MeasuredOrder> orders_;
};

std::vector<Situation> asked_situations(TableRun& run, const ProblemOptions& asked) {
  if (asked.problems.empty()) {
    if (!asked.settings.empty()) throw Error("--set needs --problem");
    return example_situations();
  }
  std::vector<Situation> situations;
  for (const auto& problem : run.selected(asked)) situations.push_back(situation_of(problem));
  return situations;
}

int measure_all(CommandLine& line) {
  ProblemOptions asked;
  asked.add_to(line);
  TableRun run("smoothness", line);
  std::vector<Situation> situations = asked_situations(run, asked);
  Smoothness smoothness(run);
  for (Situation& situation : situations) smoothness.measure(situation);
  run.add("smoothness", error_columns, smoothness.errors());
  run.add("smoothness_slopes", order_columns, smoothness.orders());
  return run.write();
}

int run(int argc, char** argv) {
  return run_program("smoothness",
                     "Measures orders of state, costate, control and cost where bounds are active and the optimal "
                     "control has kinks, compared with smooth optima, with a fixed and with a free final state "
                     "(smoothness.csv; fitted orders in smoothness_slopes.csv). The reference is the closed form, or "
                     "DMOC with two stages on 1280 intervals. --problem replaces the examples.",
                     argc, argv, measure_all);
}

}  // namespace dmocbench::smoothness_program
