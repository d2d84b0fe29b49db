#include "bench/experiments/invariants/energy_tables.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <map>
#include <optional>
#include <string>

#include "bench/experiments/invariants/example_systems.hpp"
#include "bench/run/column.hpp"
#include "bench/run/interrupt.hpp"
#include "bench/run/start_provider.hpp"
#include "bench/run/table_run.hpp"
#include "methods/diagnostics/conserved_quantities.hpp"
#include "methods/diagnostics/modified_energy.hpp"
#include "methods/diagnostics/one_step_map.hpp"
#include "methods/mechanics/legendre_transform.hpp"
#include "methods/mechanics/point_function.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/elements/families.hpp"
#include "problems/registry.hpp"

namespace dmocbench {

namespace {

constexpr std::array truncations{2, 4, 6};
/// Shares of the largest work below which a gap is due to solver and rounding: solved motion, replay in long double.
constexpr double share_of_solver = 1e-10;
constexpr double share_of_replay = 1e-16;

/// The midpoint rule of one family of elements on one problem, in long double, with its energies.
class FollowedEnergy {
 public:
  /// Largest distances from the first energy, with and without the work taken off, per order of truncation.
  struct Deviations {
    std::array<double, truncations.size()> range{};               ///< max - min of the energy
    std::array<double, truncations.size()> from_work{};           ///< of its change from the virtual work
    std::array<double, truncations.size()> from_modified_work{};  ///< and from the modified work of the same order
  };

  FollowedEnergy(const Problem& problem, const std::string& method)
      : traced_(problem), modified_(problem), map_(traced_, *make_element(method), gauss_tableau(1)) {}

  /// Whether L_vv is the same at two configurations: "constant", otherwise "moving".
  [[nodiscard]] const char* mass() const {
    const Eigen::Index n = traced_.configuration_size();
    const Eigen::Index m = traced_.control_size();
    PointFunction function(n, m,
                           [&](const ControlledState& x) { return ExpressionVector(traced_.at(x).mass.reshaped()); });
    const auto at = [&](double q) {
      Eigen::VectorXd mass(n * n);
      const Eigen::VectorXd anywhere = Eigen::VectorXd::LinSpaced(n, q, 2.0 * q);
      function.evaluate({anywhere, Eigen::VectorXd::Ones(n), Eigen::VectorXd::Zero(m)}, 0.0, mass);
      return mass;
    };
    return at(0.3).isApprox(at(1.1)) ? "constant" : "moving";
  }

  /// One step per row of `controls`, from `start` at t = 0.
  [[nodiscard]] Deviations along(const BoundaryState& start, const Eigen::MatrixXd& controls, double h) const {
    LongVector q = start.q.cast<long double>();
    LongVector v = start.v.cast<long double>();
    LongVector p = LegendreTransform(traced_).momentum(start.q, start.v, 0.0).cast<long double>();
    const StepSeries first = partial_sums(modified_.energy(q, v), h);
    StepSeries smallest = first;
    StepSeries largest = first;
    StepSeries work{};
    Deviations result;
    for (Eigen::Index k = 0; k < controls.rows(); ++k) {
      throw_if_interrupted();
      const LongMatrix u = controls.row(k).cast<long double>();
      const long double t = static_cast<long double>(k) * h;
      const auto step = map_.advance(q, p, v, u, h, t);
      const StepSeries power =
          partial_sums(modified_.power((q + step.q) / 2.0L, step.mean_velocity, u.row(0).transpose(), t + h / 2.0L), h);
      q = step.q;
      p = step.p;
      v = modified_.velocity(q, p, step.mean_velocity);
      const StepSeries energy = partial_sums(modified_.energy(q, v), h);
      for (std::size_t i = 0; i < truncations.size(); ++i) {
        work[i] += h * power[i];
        smallest[i] = std::min(smallest[i], energy[i]);
        largest[i] = std::max(largest[i], energy[i]);
        raise(result.from_work[i], energy[i] - first[i] - work[0]);
        raise(result.from_modified_work[i], energy[i] - first[i] - work[i]);
        result.range[i] = static_cast<double>(largest[i] - smallest[i]);
      }
    }
    return result;
  }

 private:
  static void raise(double& largest, long double deviation) {
    largest = std::max(largest, static_cast<double>(std::abs(deviation)));
  }
  TracedProblem traced_;
  ModifiedEnergy modified_;
  OneStepMap<long double> map_;
};

Scheme midpoint_of(const Problem& problem, const std::string& method) { return {problem.name(), method, "gauss", 1}; }

/// A quantity, and the order at which the modified energy in it is cut off.
struct EnergyQuantity {
  std::string name;
  int truncation = 0;

  auto operator<=>(const EnergyQuantity&) const = default;
};

struct FittedQuantity {
  Scheme scheme;
  EnergyQuantity quantity;
  FittedOrder fit;
  const char* mass;
};

constexpr auto quantity_of = &FittedQuantity::quantity;

const Columns<FittedQuantity> fitted_columns =
    scheme_columns<FittedQuantity>() +
    Columns<FittedQuantity>{
        {"quantity", "", "quantity whose order is fitted", from(quantity_of, &EnergyQuantity::name), in_key},
        {"truncation", "", "truncation order of the modified energy; 2 is the energy itself",
         from(quantity_of, &EnergyQuantity::truncation), in_key}} +
    fitted_order_columns(&FittedQuantity::fit) +
    Columns<FittedQuantity>{{"mass", "", "mass matrix: constant, or moving with q", &FittedQuantity::mass}};

/// Points of several curves of one scheme, by their quantities.
class Curves {
 public:
  void add(const EnergyQuantity& quantity, double h, double error) { points_[quantity].push_back({h, error}); }
  void fit_into(std::vector<FittedQuantity>& fits, const Scheme& scheme, const char* mass) const {
    for (const auto& [quantity, points] : points_) {
      if (const auto order = asymptotic_order(points, 0.0)) fits.push_back({scheme, quantity, *order, mass});
    }
  }

 private:
  std::map<EnergyQuantity, std::vector<GridError>> points_;
};

struct Drift {
  Scheme scheme;
  int steps = 0;
  double h = 0.0;
  int truncation = 0;
  double drift = 0.0;
};

const Columns<Drift> drift_columns =
    scheme_columns<Drift>() +
    Columns<Drift>{{"steps", "", "number of steps", &Drift::steps, in_key},
                   {"h", "", "step", &Drift::h},
                   {"truncation", "", "truncation order of the modified energy; 2 is the energy itself",
                    &Drift::truncation, in_key},
                   {"drift", "", "range of the truncated modified energy over the trajectory", &Drift::drift}};

struct FreeSystem {
  std::shared_ptr<const Problem> problem;
  BoundaryState start;
  double duration;
};

/// A constant mass and moving ones; only the pendulum and the orbits are integrable.
std::vector<FreeSystem> free_systems() {
  const auto pendulum = std::make_shared<Pendulum>();
  const auto radial = std::make_shared<RadialThrust>();
  const auto spherical = std::make_shared<MeridianPendulum>();
  return {{pendulum, pendulum->initial_state(), pendulum->horizon()},
          {radial, radial->initial_state(), radial->horizon()},
          {spherical, spherical->initial_state(), spherical->horizon()},
          {make_problem("two_link_manipulator"), bent_links(), 2.0}};
}

struct Gap {
  Scheme scheme;
  long long intervals = 0;
  double h = 0.0;
  int truncation = 0;
  double to_work = 0.0;
  double to_modified_work = 0.0;
};

const Columns<Gap> gap_columns =
    scheme_columns<Gap>() +
    Columns<Gap>{
        {"intervals", "", "number of intervals N", &Gap::intervals, in_key},
        {"h", "", "step", &Gap::h},
        {"truncation", "", "truncation order of the modified energy; 2 is the energy itself", &Gap::truncation, in_key},
        {"gap_to_work", "", "largest gap between energy change and virtual work over the nodes", &Gap::to_work},
        {"gap_to_modified_work", "", "largest gap between energy change and modified work, truncated at the same order",
         &Gap::to_modified_work}};

struct PlainGap {
  Scheme scheme;
  long long intervals = 0;
  double h = 0.0;
  std::optional<EnergyBalance> balance;
  std::string message;
};

constexpr auto balance_of = &PlainGap::balance;
const Columns<PlainGap> plain_columns =
    scheme_columns<PlainGap>() +
    Columns<PlainGap>{
        {"intervals", "", "number of intervals N", &PlainGap::intervals, in_key},
        {"h", "", "step", &PlainGap::h},
        {"energy_change", "", "E(T) - E(0)", from(balance_of, &EnergyBalance::change)},
        {"work", "", "virtual work of the control forces", from(balance_of, &EnergyBalance::work)},
        {"gap", "", "their difference",
         [](const PlainGap& e) {
           return e.balance ? std::optional(e.balance->change - e.balance->work) : std::nullopt;
         }},
        {"largest_gap", "", "largest gap over the nodes between energy change and work",
         from(balance_of, &EnergyBalance::largest_gap)},
        {"largest_work", "", "largest work over the nodes", from(balance_of, &EnergyBalance::largest_work)},
        {"message", "", "reason for a missing energy", &PlainGap::message}};

/// The rows of all tables before they are written.
struct EnergyWorkRows {
  std::vector<PlainGap> plain;
  std::vector<Gap> modified;
  std::vector<FittedQuantity> fits;
};

/// The measurements along one optimal motion.
struct EnergyAlongMotion {
  double h = 0.0;
  EnergyBalance balance;
  FollowedEnergy::Deviations gaps;
};

EnergyAlongMotion energy_along(const Trajectory& motion, const Problem& problem, const FollowedEnergy& followed) {
  const double h = motion.step(0);
  const MotionPoint first = motion.node(0);
  return {.h = h,
          .balance = energy_balance(problem, motion),
          .gaps = followed.along({first.q, first.v}, motion.stage_u, h)};
}

/// One problem by one method: the optimal controls are replayed by the method's own map in long double, so that the
/// rounding of the solve does not hide the small gaps.
void follow_optimal_motions(const std::shared_ptr<const Problem>& problem, const std::string& method,
                            StartProvider& starts, EnergyWorkRows& rows) {
  const Scheme scheme = midpoint_of(*problem, method);
  const FollowedEnergy followed(*problem, method);
  Case the_case{.problem = problem, .method = method, .solver = "auto"};
  Curves curves;
  for (const long long intervals : {16, 20, 24, 28, 32, 40, 48, 56, 64, 80, 96, 128, 192, 256}) {
    throw_if_interrupted();
    the_case.grid = Grid::uniform(intervals);
    const auto measured = measured_or_reason([&] { return energy_along(starts.solve(the_case), *problem, followed); });
    if (!measured) {
      const double guessed = problem->horizon() / static_cast<double>(intervals);
      rows.plain.push_back({scheme, intervals, guessed, std::nullopt, measured.error()});
      continue;
    }
    const auto& [h, balance, gaps] = *measured;
    rows.plain.push_back({scheme, intervals, h, balance, {}});
    const auto add = [&, h = h, work = balance.largest_work](const EnergyQuantity& quantity, double gap, double share) {
      if (gap > share * work) curves.add(quantity, h, gap);
    };
    add({"gap", truncations.front()}, balance.largest_gap, share_of_solver);
    for (std::size_t i = 0; i < truncations.size(); ++i) {
      rows.modified.push_back({scheme, intervals, h, truncations[i], gaps.from_work[i], gaps.from_modified_work[i]});
      add({"gap_to_work", truncations[i]}, gaps.from_work[i], share_of_replay);
      add({"gap_to_modified_work", truncations[i]}, gaps.from_modified_work[i], share_of_replay);
    }
  }
  curves.fit_into(rows.fits, scheme, followed.mass());
}

}  // namespace

ModifiedEnergyTables modified_energy_tables() {
  std::vector<Drift> drifts;
  std::vector<FittedQuantity> fits;
  for (const FreeSystem& system : free_systems()) {
    for (const std::string& method : paper_families()) {
      const Scheme scheme = midpoint_of(*system.problem, method);
      const FollowedEnergy followed(*system.problem, method);
      Curves curves;
      for (const int steps : {128, 192, 256, 384, 512}) {
        const double h = system.duration / steps;
        const Eigen::MatrixXd no_control = Eigen::MatrixXd::Zero(steps, system.problem->control_size());
        const auto range = followed.along(system.start, no_control, h).range;
        for (std::size_t i = 0; i < truncations.size(); ++i) {
          drifts.push_back({scheme, steps, h, truncations[i], range[i]});
          curves.add({"drift", truncations[i]}, h, range[i]);
        }
      }
      curves.fit_into(fits, scheme, followed.mass());
    }
  }
  return {.drifts = table_of(drift_columns, drifts), .orders = table_of(fitted_columns, fits)};
}

EnergyWorkTables energy_work_tables(const std::vector<std::shared_ptr<const Problem>>& problems,
                                    const SolverOptions& options) {
  StartProvider starts({}, options);
  EnergyWorkRows rows;
  for (const auto& problem : problems) {
    for (const std::string& method : paper_families()) follow_optimal_motions(problem, method, starts, rows);
  }
  return {.unsolved = std::ranges::count_if(rows.plain, [](const PlainGap& row) { return !row.balance; }),
          .plain = table_of(plain_columns, rows.plain),
          .modified = table_of(gap_columns, rows.modified),
          .orders = table_of(fitted_columns, rows.fits)};
}

}  // namespace dmocbench
