// One slew of a rigid body in several systems of coordinates, all measured against one optimum in one measure: the
// angle between two attitudes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/experiments/kkt_eigenvalues.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/indirect_reference.hpp"
#include "bench/tables/fitted_orders.hpp"
#include "methods/error.hpp"
#include "methods/indirect/solve_indirect.hpp"
#include "methods/mechanics/embedded_problem.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/elements/element.hpp"
#include "problems/satellite_slew.hpp"

namespace dmocbench::rigid_body_coordinates_program {

struct Measured {
  std::optional<double> condition;
  std::optional<double> attitude;
  std::optional<double> objective;
  std::optional<double> replay;
  std::optional<double> optimum_attitude;
  std::optional<double> optimum_objective;
};

/// The statement of the slew in coordinates that determine the attitude, of a chart the one with constraints; null if
/// it is another problem.
const SatelliteSlew* slew_of(const Problem& problem) {
  return dynamic_cast<const SatelliteSlew*>(problem.redundant() != nullptr ? problem.redundant() : &problem);
}

/// How a statement takes the constraints of an attitude.
enum class Form : std::uint8_t { minimal_coordinates, chart, multipliers };

Form form_of(const Problem& problem) {
  if (TracedProblem(problem).holonomic_count() > 0) return Form::multipliers;
  return problem.redundant() == nullptr ? Form::minimal_coordinates : Form::chart;
}

/// R at a configuration of a problem.
Eigen::Matrix3d attitude(const Problem& problem, const Eigen::VectorXd& q, double t) {
  const auto* chart = dynamic_cast<const EmbeddedProblem*>(&problem);
  return slew_of(problem)->attitude_at(chart == nullptr ? q : chart->lifted({q, Eigen::VectorXd::Zero(q.size())}, t).q);
}

/// The angle of the rotation from one attitude to another, at most π.
double angle_between(const Eigen::Matrix3d& one, const Eigen::Matrix3d& other) {
  return 2.0 * std::asin(std::min(1.0, (one - other).norm() / std::sqrt(8.0)));
}

/// The optimal motion of the body, in some coordinates.
struct Optimum {
  std::shared_ptr<const Problem> problem;
  const IndirectSolution* solution = nullptr;  // null until it is known

  [[nodiscard]] Eigen::Matrix3d attitude_at(double t) const { return attitude(*problem, solution->at(t).q, t); }
};

/// The largest angle over some times between an attitude, a function of the number of the time, and the optimal one.
template <class AttitudeAt>
double largest_angle(const Eigen::VectorXd& times, const Optimum& optimum, const AttitudeAt& attitude_at) {
  double largest = 0.0;
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    largest = std::max(largest, angle_between(attitude_at(k), optimum.attitude_at(times[k])));
  }
  return largest;
}

class RigidBodyCoordinates final : public ExperimentOf<Measured> {
 public:
  RigidBodyCoordinates()
      : ExperimentOf(
            {.name = "rigid_body_coordinates",
             .description =
                 "Solves one slew of a rigid body in several systems of coordinates, from the same guess, and compares "
                 "attitude, cost and replay with one optimum, the indirect solution in the first system without "
                 "multipliers. Errors of attitudes are angles. NAME_slopes.csv has the orders, NAME_reference.csv the "
                 "indirect solutions in two systems.",
             .options = {.problems = {"satellite_angles", "satellite_quaternion", "satellite_directors"},
                         .solvers = {"interior_point"},
                         .intervals = "8:128",
                         .constraints = {"multipliers", "embedding"},
                         .start = "guess"},
             .further_files = {"_slopes.csv", "_reference.csv"},
             .polishes = true}) {}

  [[nodiscard]] Columns<Measured> columns() const override {
    return {{"condition", "", "condition number of the equilibrated KKT matrix at the optimum; up to N = 16",
             &Measured::condition},
            {"state_error", "rad", "largest angle over the nodes between the attitude and the optimal one",
             &Measured::attitude},
            {"objective_error", "cost", "error of the cost", &Measured::objective},
            {"replay_error", "rad", "angle between the final attitude and the one at which a replay ends",
             &Measured::replay},
            {"optimum_state_difference", "rad",
             "largest angle over the nodes between the optimum and the indirect solution in these coordinates",
             &Measured::optimum_attitude},
            {"optimum_objective_difference", "cost", "difference of their costs", &Measured::optimum_objective}};
  }

  /// Methods that have the constraints of the motion. Statements in minimal coordinates come first, then charts: the
  /// first has the optimum, the second one of its own to compare with.
  [[nodiscard]] std::vector<Case> cases(const std::vector<Case>& chosen) override {
    std::vector<Case> cases;
    for (std::vector<Case>& curve : curves_of(chosen)) {
      const Case& first = curve.front();
      if (slew_of(*first.problem) == nullptr) {
        throw Error(first.problem->name() + " is not the slew of a satellite; --help lists the problems");
      }
      if (!takes_constraints(*make_element(first.method), TracedProblem(*first.problem),
                             make_tableau(first.tableau, first.stages))) {
        continue;
      }
      curve.back().is_reference = true;
      std::ranges::move(curve, std::back_inserter(cases));
    }
    std::ranges::stable_sort(cases, {}, [](const Case& each) { return form_of(*each.problem); });
    const auto has_optimum = [&](const Case& each) {
      return form_of(*each.problem) != Form::multipliers && each.problem != optimum_.problem;
    };
    for (Optimum* optimum : {&optimum_, &other_optimum_}) {
      const auto found = std::ranges::find_if(cases, has_optimum);
      if (found != cases.end()) optimum->problem = found->problem;
    }
    if (optimum_.problem == nullptr) {
      throw Error("the optimum needs a problem without multipliers: add satellite_angles, or --constraints embedding");
    }
    for (Case& each : cases) each.shares = optimum_.problem->name();
    indirect_ = std::make_shared<IndirectReference>(options().out);
    return cases;
  }

  void measure(SolvedCase& solved, Measured& measured) override {
    if (!is_discrete_optimum(solved) || !solved.trajectory) return;
    const Problem& problem = *solved.the_case.problem;
    const Trajectory& trajectory = *solved.trajectory;
    if (solved.the_case.intervals() <= finest_with_condition) {
      measured.condition = kkt_condition(*solved.program, solved.solution);
    }
    const Eigen::VectorXd last = problem.final_state().q;
    const double horizon = problem.horizon();
    measured.replay = angle_between(attitude(problem, last + replay_error(problem, trajectory).q, horizon),
                                    attitude(problem, last, horizon));
    if (solved.the_case.is_reference && is_usable(solved)) compare_optima(solved, measured);
    if (optimum_.solution == nullptr) return;
    measured.objective = std::abs(trajectory.cost - optimum_.solution->cost());
    measured.attitude = largest_angle(trajectory.node_times, optimum_, [&](Eigen::Index k) {
      return attitude(problem, trajectory.q.row(k), trajectory.node_times[k]);
    });
  }

  void finish(Table& table, FurtherOutput& output) override {
    const FittedOrders orders = fit_orders(table, std::nullopt, exact_reference);
    output.write("_slopes.csv", orders.table);
    output.write("_reference.csv", indirect_->table());
    output.metadata["references"] = indirect_->metadata();
    output.summary.show("coordinates", table,
                        {"problem", "method", "stages", "intervals", "free_variables", "constraints", "condition",
                         "major_iterations", "state_error", "objective_error", "replay_error"},
                        output.prefix.string() + ".csv");
  }

 private:
  /// Finds the optimum, or the one in other coordinates and how far it is away.
  void compare_optima(const SolvedCase& solved, Measured& measured) {
    const Trajectory& trajectory = *solved.trajectory;
    for (Optimum* optimum : {&optimum_, &other_optimum_}) {
      if (optimum->problem != solved.the_case.problem || optimum->solution != nullptr) continue;
      optimum->solution = &indirect_->near(*optimum->problem, trajectory);
      if (optimum == &optimum_ || optimum_.solution == nullptr) continue;
      measured.optimum_objective = std::abs(optimum->solution->cost() - optimum_.solution->cost());
      measured.optimum_attitude = largest_angle(trajectory.node_times, optimum_, [&](Eigen::Index k) {
        return optimum->attitude_at(trajectory.node_times[k]);
      });
    }
  }

  static constexpr std::size_t finest_with_condition = 16;  // dense linear algebra
  Optimum optimum_;
  Optimum other_optimum_;
};

int run(int argc, char** argv) { return run_experiment(RigidBodyCoordinates(), argc, argv); }

}  // namespace dmocbench::rigid_body_coordinates_program
