// Feedback: controllers that solve their problem again at every sample, on an exact plant with disturbances.
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/experiments/closed_loop/plant.hpp"
#include "bench/experiments/closed_loop/replanner.hpp"
#include "bench/run/case_list.hpp"
#include "bench/run/column.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/options.hpp"
#include "bench/run/start_provider.hpp"
#include "bench/run/table_run.hpp"
#include "bench/run/uniform_01.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/error.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/elements/families.hpp"

namespace dmocbench::closed_loop_program {

/// The choices of a user.
struct LoopOptions {
  ProblemOptions problems{.problems = paper_problem_names()};
  std::vector<std::string> methods = paper_families();
  int stages = 1;
  std::string intervals = "16:64";
  int samples = 16;
  int draws = 20;
  double disturbance = 0.1;
  std::uint64_t seed = 1;
};

/// A motion of the plant under one controller.
struct Loop {
  Scheme scheme;
  long long intervals = 0;
  std::size_t variables = 0;
  bool is_closed = false;
  std::size_t draw = 0;
  double disturbance = 0.0;
  int plans = 0;
  int failed = 0;
  double iterations = 0.0;
  std::optional<double> cost = std::nullopt;
  std::optional<double> excess_cost = std::nullopt;
  double violation = 0.0;
  std::optional<double> momentum_defect = std::nullopt;
  std::optional<double> momentum_miss = std::nullopt;
  std::optional<double> final_distance = std::nullopt;
  std::string message = {};
};

const Columns<Loop> loop_columns =
    scheme_columns<Loop>() +
    Columns<Loop>{
        {"intervals", "", "number of intervals N of every plan", &Loop::intervals, in_key},
        {"feedback", "", "closed: a plan at every sample; open: the first plan to the end",
         [](const Loop& loop) { return loop.is_closed ? "closed" : "open"; }, in_key},
        {"draw", "", "number of the drawn disturbances, the same for all controllers; 0 without", &Loop::draw, in_key},
        {"disturbance", "", "largest disturbance of a coordinate, relative to the range of its momentum over T",
         &Loop::disturbance},
        {"variables", "", "unknowns of a plan that are not fixed", &Loop::variables},
        {"plans", "", "number of plans", &Loop::plans},
        {"failed", "", "plans without a solution, where the one before stayed", &Loop::failed},
        {"iterations", "", "mean number of iterations of a plan", &Loop::iterations},
        {"cost", "cost", "cost of the plant's motion", &Loop::cost},
        {"excess_cost", "cost", "the same less the cost with plans of DMOC with three stages", &Loop::excess_cost},
        {"violation", "", "largest excess of the plant over a bound, relative to the distance of its bounds",
         &Loop::violation},
        {"momentum_defect", "momentum", "largest defect of momentum and forces in an interval of a plan",
         &Loop::momentum_defect},
        {"momentum_miss", "momentum", "largest distance of the plant's momentum from the plan's at the next sample",
         &Loop::momentum_miss},
        {"final_distance", "", "distance of the plant from the final state in (q, v)", &Loop::final_distance},
        {"message", "", "why the plant's motion ended", &Loop::message}};

/// In the last quarter of the horizon the last plan stays. In less time than that, corrections of a coordinate without
/// a control of its own need controls that grow without bounds.
constexpr double last_plan = 0.75;
/// Of the plans that stand for exact ones.
constexpr int exact_stages = 3;
constexpr long long exact_intervals = 32;

/// Throws `Error` if the problem changes otherwise than by its initial state when its horizon begins later.
void require_loop(const Problem& problem) {
  const ProblemBounds bounds = problem.bounds();
  const TracedProblem traced(problem);
  const std::vector<MotionPoint> point(2, problem.guess(0.3 * problem.horizon()));
  const Eigen::MatrixXd formulas = traced.table(point, Eigen::Vector2d(0.0, 0.3 * problem.horizon()));
  if (problem.phased() == nullptr && problem.unknowns().empty() && problem.first_order_size() == 0 &&
      traced.constraint_count() == 0 && traced.integral_count() == 0 && traced.boundary_condition_count() == 0 &&
      bounds.interior.empty() && bounds.first.all_fixed() && !bounds.horizon.is_free() &&
      formulas.row(0) == formulas.row(1)) {
    return;
  }
  throw Error(problem.name() +
              " cannot be planned anew on its way: a closed loop needs a fixed horizon and initial state and formulas "
              "without time, and no phases, constraints of the motion, conditions on both ends or between them, "
              "integrals, first-order states or unknown parameters; choose another problem");
}

/// The controllers of one problem on its plant.
class Loops {
 public:
  /// Begins with the plans that stand for exact ones.
  Loops(const TableRun& run, const LoopOptions& options, std::shared_ptr<const Problem> problem, StartProvider& starts)
      : run_(run), options_(options), problem_(std::move(problem)), plant_(*problem_), starts_(starts) {
    Replanner exact = controller("dmoc", exact_stages, exact_intervals);
    draw_disturbances(exact.current());
    follow_all({problem_->name(), "dmoc", "gauss", exact_stages}, exact_intervals, exact);
  }
  /// A method on a grid.
  void measure(const std::string& method, long long intervals) {
    Replanner replanner = controller(method, options_.stages, intervals);
    follow_all({problem_->name(), method, "gauss", options_.stages}, intervals, replanner);
  }
  [[nodiscard]] const std::vector<Loop>& rows() const noexcept { return rows_; }

 private:
  [[nodiscard]] Replanner controller(const std::string& method, int stages, long long intervals) {
    const Case the_case{.problem = problem_,
                        .method = method,
                        .stages = stages,
                        .solver = "interior_point",
                        .grid = Grid::uniform(intervals)};
    run_.show(the_case.label());
    return {the_case, starts_.start_for(the_case).motion, TableRun::solver_options()};
  }
  /// A column per sample; all of the first draw vanish.
  void draw_disturbances(const Trajectory& optimum) {
    const Eigen::VectorXd largest = options_.disturbance / problem_->horizon() *
                                    (optimum.p.colwise().maxCoeff() - optimum.p.colwise().minCoeff()).transpose();
    std::mt19937_64 engine(options_.seed);
    const auto share = [&] { return 2.0 * uniform_01(engine) - 1.0; };
    disturbances_.emplace_back(Eigen::MatrixXd::Zero(largest.size(), options_.samples));
    for (int i = 0; i < options_.draws; ++i) {
      const Eigen::MatrixXd shares = Eigen::MatrixXd::NullaryExpr(largest.size(), options_.samples, share);
      disturbances_.emplace_back(largest.asDiagonal() * shares);
    }
  }
  void follow_all(const Scheme& scheme, long long intervals, Replanner& replanner) {
    for (const bool is_closed : {false, true}) {
      for (std::size_t draw = 0; draw < disturbances_.size(); ++draw) {
        throw_if_interrupted();
        Loop loop{.scheme = scheme,
                  .intervals = intervals,
                  .variables = replanner.free_variables(),
                  .is_closed = is_closed,
                  .draw = draw,
                  .disturbance = draw == 0 ? 0.0 : options_.disturbance};
        const auto followed = measured_or_reason([&] { return follow(loop, replanner); });
        if (!followed) loop.message = followed.error();
        loop.plans = replanner.plans();
        loop.failed = replanner.failed();
        loop.iterations = static_cast<double>(replanner.iterations()) / loop.plans;
        rows_.push_back(std::move(loop));
      }
    }
    const std::size_t loops = 2 * disturbances_.size();  // the exact ones are the first
    for (std::size_t i = 0; i < loops; ++i) {
      Loop& loop = rows_[rows_.size() - loops + i];
      if (loop.cost && rows_[i].cost) loop.excess_cost = *loop.cost - *rows_[i].cost;
    }
  }
  /// The plant's motion to the end; true.
  bool follow(Loop& loop, Replanner& replanner) {
    const double horizon = problem_->horizon();
    const double sample = horizon / options_.samples;
    plant_.begin();
    replanner.begin();
    for (int k = 0; k < options_.samples; ++k) {
      const double t = k * sample;
      if (loop.is_closed && k > 0 && t <= last_plan * horizon) replanner.plan(plant_.state(), t);
      const Trajectory& plan = replanner.current();
      const double from = t - replanner.made_at();
      if (from == 0.0 && plant_.has_momentum()) {
        loop.momentum_defect =
            std::max(loop.momentum_defect.value_or(0.0), momentum_consistency(*problem_, plan).largest);
      }
      plant_.follow(plan, from, from + sample, disturbances_[loop.draw].col(k));
      if (plant_.has_momentum()) {
        const double miss = std::abs(plant_.momentum(plant_.state()) - planned_momentum(plan, from + sample));
        loop.momentum_miss = std::max(loop.momentum_miss.value_or(0.0), miss);
      }
    }
    loop.cost = plant_.cost(horizon);
    loop.violation = plant_.violation();
    loop.final_distance = distance_from_end();
    return true;
  }
  /// Linear between the nodes, as the momentum of one stage is.
  [[nodiscard]] double planned_momentum(const Trajectory& plan, double t) {
    const auto at_node = [&](Eigen::Index k) {
      const MotionPoint node = plan.node(k);
      return plant_.momentum({node.q, node.v});
    };
    const auto later = std::upper_bound(plan.node_times.begin() + 1, plan.node_times.end() - 1, t);
    const Eigen::Index k = later - plan.node_times.begin() - 1;
    const double share = (t - plan.node_times[k]) / plan.step(k);
    return (1.0 - share) * at_node(k) + share * at_node(k + 1);
  }
  /// Of the components that the final state fixes.
  [[nodiscard]] double distance_from_end() const {
    const EndBounds last = problem_->bounds().last;
    const BoundaryState reached = plant_.state();
    double square = 0.0;
    for (Eigen::Index i = 0; i < reached.q.size(); ++i) {
      if (last.q.is_fixed(i)) square += std::pow(reached.q[i] - last.q.lower[i], 2);
      if (last.v.is_fixed(i)) square += std::pow(reached.v[i] - last.v.lower[i], 2);
    }
    return std::sqrt(square);
  }

  const TableRun& run_;
  const LoopOptions& options_;
  std::shared_ptr<const Problem> problem_;
  Plant plant_;
  StartProvider& starts_;
  std::vector<Eigen::MatrixXd> disturbances_;
  std::vector<Loop> rows_;
};

/// The grids of a method: the chosen ones, and of collocation also those with about as many unknowns as DMOC has there.
std::vector<long long> grids_of(const std::string& method, const Problem& problem, const std::string& chosen) {
  std::vector<long long> grids = parse_intervals("--intervals", chosen);
  if (method == "dmoc") return grids;
  const auto n = static_cast<double>(problem.configuration_size());
  const auto m = static_cast<double>(problem.control_size());
  const std::size_t count = grids.size();
  for (std::size_t i = 0; i < count; ++i) {
    grids.push_back(std::llround(static_cast<double>(grids[i]) * (n + m) / (2.0 * n + m)));
  }
  std::ranges::sort(grids);
  grids.erase(std::ranges::unique(grids).begin(), grids.end());
  return grids;
}

int run_loops(CommandLine& line) {
  LoopOptions options;
  options.problems.add_to(line);
  line.list("--method", options.methods, fmt::format("methods: {}", fmt::join(paper_families(), ", ")));
  line.number("--stages", options.stages, 1, 4, "number of Gauss stages s");
  line.option("--intervals", options.intervals,
              "numbers of intervals N of a plan; collocation also gets grids with about as many unknowns as DMOC");
  line.number("--samples", options.samples, 2, 1000, "number of samples of the horizon");
  line.number("--draws", options.draws, 0, 1000, "number of draws of the disturbances");
  line.number("--disturbance", options.disturbance, 0.0, 10.0,
              "largest disturbance of a coordinate, relative to the range of its momentum over T");
  line.number("--seed", options.seed, 0, 0xffffffffU, "seed of the disturbances");
  TableRun run("closed_loop", line, TableRun::Resumes::yes);
  options.methods = chosen_of("--method", paper_families(), options.methods);
  const auto problems = run.selected(options.problems);
  for (const auto& problem : problems) require_loop(*problem);
  StartProvider starts({}, TableRun::solver_options());
  for (const auto& problem : problems) {
    run.stage(problem->name(), [&] {
      Loops loops(run, options, problem, starts);
      for (const std::string& method : options.methods) {
        for (const long long intervals : grids_of(method, *problem, options.intervals)) {
          loops.measure(method, intervals);
        }
      }
      run.add("closed_loop", loop_columns, loops.rows());
    });
  }
  return run.write();
}

int run(int argc, char** argv) {
  return run_program(
      "closed_loop",
      "Controls an exact plant by plans: at every sample the problem is solved again from the measured state over the "
      "time that remains, each solve started at the rest of the plan before it, and the plan is followed to the next "
      "sample. Disturbances are forces, constant over a sample, drawn once for all methods. For comparison, the first "
      "plan is followed to the end (open), and all is done with plans that stand for exact ones, of DMOC with three "
      "stages.",
      argc, argv, run_loops);
}

}  // namespace dmocbench::closed_loop_program
