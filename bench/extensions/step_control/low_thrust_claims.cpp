// Low thrust over many revolutions: from how many steps per revolution on structure preservation pays.
#include <cmath>
#include <optional>

#include "bench/claims/claim.hpp"
#include "bench/extensions/register_extensions.hpp"

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

/// The fewest steps per revolution from which on an error of one method is `factor` times the error of a better one;
/// none if it is not on the finest grid.
std::optional<double> pays_from(const Selection& of_revolutions, const char* better, const char* other,
                                const char* error, double factor) {
  const Selection others = over_steps(of_revolutions, other, error);
  std::optional<double> from;
  for (const Row& row : over_steps(of_revolutions, better, error)) {
    const Selection beside = others.matching(row, {"steps_per_revolution"});
    const bool pays = !beside.empty() && quotient(beside.front(), row, error) >= factor;
    if (!pays) from.reset();
    if (pays && !from) from = row.needed("steps_per_revolution");
  }
  return from;
}

/// Whether a method pays compared with another one from so many steps per revolution on, for any number of revolutions.
Finding pays(const ResultTables& tables, const std::string& problem, const char* better, const char* other,
             const char* error, double factor, double wanted) {
  std::vector<std::string> words;
  bool always = true;
  for (const Selection& rows : by_revolutions(tables, problem)) {
    const auto from = pays_from(rows, better, other, error, factor);
    always = always && from && *from <= wanted;
    words.push_back(fmt::format("with {} revolutions {}", rows.front().text("revolutions"),
                                from ? fmt::format("from {:g} steps on", *from) : "never"));
  }
  return found(always, "{} of {} at least {:g} times as large as of {}: {}", error, other, factor, better,
               fmt::join(words, ", "));
}

Finding pays_in_momentum_alone(const ResultTables& tables, const std::string& problem) {
  constexpr double same = 1.25;
  constexpr double clearly_worse = 2.0;
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
  return found(
      farthest < same && least > clearly_worse,
      "on {} grids cost and replay errors differ by a factor of at most {:.2f}; angular momentum over the whole "
      "horizon less work: of tangent-space collocation at least {:.1f} times DMOC's",
      compared, farthest, least);
}

Finding pays_beside_explicit(const ResultTables& tables, const std::string& problem) {
  constexpr double factor = 1.05;
  constexpr double coarsest = 8.0;
  return pays(tables, problem, "dmoc", explicit_midpoint, "state_error", factor, coarsest);
}

Finding order_pays_more(const ResultTables& tables, const std::string& problem) {
  constexpr double factor = 5.0;
  constexpr double from = 12.0;
  return pays(tables, problem, runge_kutta_4, "dmoc", "cost_error", factor, from);
}

}  // namespace

Claims low_thrust_claims() {
  const std::vector<std::string> evidence{"low_thrust.csv", "low_thrust_reference.csv", "figures/{}_low_thrust.svg"};
  return {
      {.id = "low_thrust_structure_pays_in_momentum_alone",
       .problems = only_orbit,
       .where = "section 4.2.1, with many revolutions",
       .states = "in polar coordinates, with 8 to 32 steps per revolution, tangent-space collocation has the cost and "
                 "replay errors of DMOC; only the balance of momentum is worse",
       .judge = pays_in_momentum_alone,
       .evidence = evidence},
      {.id = "low_thrust_structure_pays_beside_explicit",
       .problems = only_orbit,
       .where = "section 4.2.1, with many revolutions",
       .states =
           "compared with shooting by the explicit midpoint rule, of the same order, DMOC has the smaller state error "
           "from 8 steps per revolution on",
       .judge = pays_beside_explicit,
       .evidence = evidence},
      {.id = "low_thrust_order_pays_more",
       .problems = only_orbit,
       .where = "section 4.2.1, with many revolutions",
       .states =
           "from 12 steps per revolution on order pays more than structure: shooting by rk4 has at most a fifth of "
           "DMOC's cost error",
       .judge = order_pays_more,
       .condition = "coordinates in which a circular orbit is a straight line",
       .evidence = evidence}};
}

}  // namespace dmocbench
