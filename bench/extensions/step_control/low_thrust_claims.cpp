// Low thrust over many revolutions: from how many steps per revolution on structure preservation pays.
#include <cmath>
#include <limits>

#include "bench/claims/claim.hpp"
#include "bench/extensions/claims_of_extensions.hpp"

namespace dmocbench {

namespace {

constexpr const char* explicit_midpoint = "multiple_shooting_midpoint_1";
constexpr const char* runge_kutta_4 = "multiple_shooting_rk4_1";

std::vector<Selection> by_revolutions(const ResultTables& tables, const std::string& problem) {
  return tables.rows("low_thrust", problem).group_by({"revolutions"});
}

/// The solved rows of a method with one number of revolutions, coarsest first. Errors below the certified accuracy of
/// the reference mean nothing and are left out.
Selection over_steps(const Selection& of_revolutions, const char* method, const char* error) {
  const auto says_something = [&](const Row& row) {
    constexpr double above = 10.0;
    return row.needed(error) > above * std::pow(10.0, -row.needed("reference_digits"));
  };
  Selection rows =
      of_revolutions.where("method", method).usable().where(says_something).sorted_by("steps_per_revolution");
  require(rows.size() >= 3, "low_thrust.csv has {} usable rows of {} with {} revolutions; three are needed",
          rows.size(), method, of_revolutions.front().text("revolutions"));
  return rows;
}

/// The error of one method over the error of a better one, on every grid with at least this many steps per revolution.
struct ErrorRatios {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  std::size_t count = 0;
};
ErrorRatios ratios_of(const ResultTables& tables, const std::string& problem, const char* better, const char* other,
                      const char* error, double fewest_steps) {
  ErrorRatios ratios;
  for (const Selection& rows : by_revolutions(tables, problem)) {
    const Selection others = over_steps(rows, other, error);
    for (const Row& row : over_steps(rows, better, error)) {
      const Selection beside = others.matching(row, {"steps_per_revolution"});
      if (beside.empty() || row.needed("steps_per_revolution") < fewest_steps) continue;
      const double ratio = quotient(beside.front(), row, error);
      ratios.least = std::min(ratios.least, ratio);
      ratios.most = std::max(ratios.most, ratio);
      ++ratios.count;
    }
  }
  require(ratios.count >= 3, "low_thrust.csv has {} grids of {} with usable rows of {} and {}; three are needed",
          ratios.count, problem, better, other);
  return ratios;
}

Finding pays_in_momentum_alone(const ResultTables& tables, const std::string& problem) {
  double farthest = 1.0;  // ratio of cost or replay errors, whichever is larger
  double least = std::numeric_limits<double>::infinity();
  std::size_t compared = 0;
  for (const Selection& rows : by_revolutions(tables, problem)) {
    const Selection tangent = rows.where("method", "tangent").usable();
    for (const Row& dmoc : rows.where("method", "dmoc").usable()) {
      const Selection beside = tangent.matching(dmoc, {"steps_per_revolution"});
      if (beside.empty()) continue;
      ++compared;
      for (const char* error : {"cost_error", "replay_error"}) {
        const double ratio = quotient(beside.front(), dmoc, error);
        farthest = std::max({farthest, ratio, 1.0 / ratio});
      }
      least = std::min(least, quotient(beside.front(), dmoc, "momentum_balance"));
    }
  }
  require(compared >= 3, "low_thrust.csv has {} grids with usable rows of dmoc and tangent; three are needed",
          compared);
  return found(ClaimVerdict::measured, "on {} grids, cost and replay errors differ by a factor of at most {:.2f}",
               compared, Measurement{"largest factor between cost or replay errors", farthest, "tangent"})
      .also(worded("the change of angular momentum minus the work over the horizon is at least {:.1f} times as large "
                   "with tangent-space collocation as with DMOC",
                   Measurement{"least ratio of the momentum balance", least, "tangent"}));
}

Finding pays_beside_explicit(const ResultTables& tables, const std::string& problem) {
  const ErrorRatios ratios = ratios_of(tables, problem, "dmoc", explicit_midpoint, "state_error", 0.0);
  return found(ratios.least > 1.0, "the ratio of state errors of {} and DMOC on {} grids is {:.2f} to {:.2f}",
               explicit_midpoint, ratios.count,
               Measurement{"least ratio of state errors", ratios.least, explicit_midpoint},
               Measurement{"largest ratio of state errors", ratios.most, explicit_midpoint});
}

Finding order_pays_more(const ResultTables& tables, const std::string& problem) {
  constexpr double from = 12.0;
  const ErrorRatios ratios = ratios_of(tables, problem, runge_kutta_4, "dmoc", "cost_error", from);
  return found(
      ratios.least > 1.0,
      "the ratio of cost errors of DMOC and {} on {} grids with at least {:g} steps per revolution is {:.1f} to {:.1f}",
      runge_kutta_4, ratios.count, Measurement{"fewest steps per revolution", from},
      Measurement{"least ratio of cost errors", ratios.least, "dmoc"},
      Measurement{"largest ratio of cost errors", ratios.most, "dmoc"});
}

}  // namespace

Claims low_thrust_claims() {
  const std::vector<std::string> evidence{"low_thrust.csv", "low_thrust_reference.csv", "figures/{}_low_thrust.svg"};
  return about(
      only_orbit, Whose::extension,
      {{.id = "low_thrust_structure_pays_in_momentum_alone",
        .where = "section 4.2.1, with many revolutions",
        .states = "differences between tangent-space collocation and DMOC in the errors of cost and replay and in "
                  "the balance of momentum, in polar coordinates with 8 to 32 steps per revolution",
        .judge = pays_in_momentum_alone,
        .evidence = evidence,
        .has_verdict = false},
       {.id = "low_thrust_structure_pays_beside_explicit",
        .where = "section 4.2.1, with many revolutions",
        .states = "with 8 to 32 steps per revolution, DMOC has a smaller state error than shooting with the "
                  "explicit midpoint rule, which has the same order",
        .judge = pays_beside_explicit,
        .evidence = evidence},
       {.id = "low_thrust_order_pays_more",
        .where = "section 4.2.1, with many revolutions",
        .states = "from 12 steps per revolution on, the order matters more than the structure: shooting with rk4 "
                  "has a smaller cost error than DMOC",
        .judge = order_pays_more,
        .condition = "coordinates in which a circular orbit is a straight line",
        .evidence = evidence}});
}

}  // namespace dmocbench
