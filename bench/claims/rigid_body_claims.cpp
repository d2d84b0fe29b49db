// One slew of a rigid body in five systems of coordinates, away from the singularity of Euler angles and close to it.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/claims/claim.hpp"

namespace dmocbench {

namespace {

/// In the place of a problem.
const Problems rigid_body{"rigid_body"};

constexpr const char* slew_away = "rigid_body_coordinates";
constexpr const char* slew_near = "rigid_body_coordinates_near_singularity";
constexpr std::array slews{slew_away, slew_near};
constexpr std::array by_multipliers{"satellite_quaternion", "satellite_directors"};

std::string chart_of(const std::string& problem) { return problem + "_embedded"; }

/// DMOC's rows of a slew with errors.
Selection dmoc_rows(const ResultTables& tables, const char* slew) {
  Selection rows = midpoint(tables.rows(slew).usable(), "dmoc");
  require(!rows.empty(), "{}.csv has no solved row of dmoc", slew);
  return rows;
}

/// The row of a problem on the grid of another row.
const Row& on_grid_of(const Row& row, const Selection& rows, const std::string& problem, const char* slew) {
  const Selection same = rows.where("problem", problem).matching(row, {"method", "tableau", "stages", "intervals"});
  require(!same.empty(), "{}.csv has no solved row of {} with N = {}", slew, problem, row.text("intervals"));
  return same.front();
}

Finding one_optimum(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double ten_digits = 1e-10;
  double angle = 0.0;
  double cost = 0.0;
  double digits = 16.0;
  for (const char* slew : slews) {
    const Selection rows = tables.rows(slew).with_number("optimum_state_difference");
    require(!rows.empty(), "{}.csv does not compare two indirect solutions", slew);
    angle = std::max(angle, rows.max("optimum_state_difference"));
    cost = std::max(cost, rows.max([](const Row& row) {
      return row.needed("optimum_objective_difference") / row.needed("objective");
    }));
    digits = std::min(digits, tables.rows(std::string(slew) + "_reference").min("certified_digits"));
  }
  return found(angle < ten_digits && cost < ten_digits,
               "two slews: attitudes differ by at most {:.0e} rad, costs by {:.0e}, relative",
               Measurement{"largest angle between the optimal attitudes", angle, "", "", "rad"},
               Measurement{"largest relative difference of the optimal costs", cost})
      .also(worded("each is certified to {:.1f} digits at least", Measurement{"certified digits", digits}));
}

Finding one_order(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double near = 0.2;
  Selection rows;
  for (const char* slew : slews) {
    rows.append(tables.rows(std::string(slew) + "_slopes").where([](const Row& row) {
      const std::string& quantity = row.text("quantity");
      return has_order(row) && (quantity == "state" || quantity == "objective" || quantity == "replay");
    }));
  }
  const std::size_t systems = rows.distinct("problem").size();
  require(systems == 5, "the tables of orders have orders of {} systems of coordinates; five are needed", systems);
  return found(
      verdict_on_all(rows, [](const Row& row) { return verdict_on_order(row, 2.0 * row.needed("stages"), near); }),
      "{} orders in {} systems: at most {:.2f} away from 2s", rows.size(), systems,
      Measurement{"largest distance of an order from 2s",
                  rows.max([](const Row& row) { return std::abs(row.needed("slope") - 2.0 * row.needed("stages")); })});
}

Finding charts_and_multipliers(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double rounding = 1e-11;  // rad
  double difference = 0.0;
  bool has_minimal_size = true;
  std::size_t grids = 0;
  for (const char* slew : slews) {
    const Selection rows = dmoc_rows(tables, slew);
    const Selection angles = tables.rows(slew).where("problem", "satellite_angles");  // also on too coarse grids
    for (const char* problem : by_multipliers) {
      const Selection with_multipliers = rows.where("problem", problem);
      require(with_multipliers.size() == rows.where("problem", chart_of(problem)).size(),
              "{}.csv has {} and its chart on different grids", slew, problem);
      for (const Row& row : with_multipliers) {
        const Row& chart = on_grid_of(row, rows, chart_of(problem), slew);
        difference = std::max(difference, std::abs(row.needed("state_error") - chart.needed("state_error")));
        has_minimal_size =
            has_minimal_size &&
            chart.text("free_variables") == on_grid_of(row, angles, "satellite_angles", slew).text("free_variables");
        ++grids;
      }
    }
  }
  require(grids > 0, "no table has solved rows with multipliers");
  return found(difference < rounding && has_minimal_size,
               "{} comparisons: errors of the attitude differ by at most {:.0e} rad", grids,
               Measurement{"largest difference of the errors of the attitude", difference, "dmoc", "", "rad"});
}

/// The least and the largest error of Euler angles divided by the error in a chart, over the grids of a slew.
std::pair<double, double> ratios_to_chart(const ResultTables& tables, const char* slew, const std::string& chart,
                                          const char* column) {
  const Selection rows = dmoc_rows(tables, slew);
  const Selection angles = rows.where("problem", "satellite_angles");
  require(!angles.empty(), "{}.csv has no solved row of satellite_angles", slew);
  const auto ratio = [&](const Row& row) { return quotient(row, on_grid_of(row, rows, chart, slew), column); };
  return {-angles.max([&](const Row& row) { return -ratio(row); }), angles.max(ratio)};
}

Finding attitude_error(const ResultTables& tables, const std::string& /*problem*/) {
  double smallest = std::numeric_limits<double>::infinity();
  const auto ratios = [&](const char* column) {
    return joined(slews, "; close to the singularity ", [&](const char* slew) {
      return joined(by_multipliers, ", ", [&](const char* problem) {
        const auto [least, most] = ratios_to_chart(tables, slew, chart_of(problem), column);
        if (column == std::string("state_error")) smallest = std::min(smallest, least);
        const std::string at = fmt::format("{}, {}, {}", column, slew, chart_of(problem));
        return worded("{:.2f} to {:.2f}", Measurement{"least ratio of errors", least, "dmoc", at},
                      Measurement{"largest ratio of errors", most, "dmoc", at});
      });
    });
  };
  const Words of_attitude = ratios("state_error");
  return found(smallest > 1.0,
               "errors in Euler angles over errors in a chart of quaternions, of directors: attitude {}", of_attitude)
      .also(worded("cost {}", ratios("objective_error")))
      .also(worded("replay {}", ratios("replay_error")));
}

Finding near_singularity(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double ten_times = 10.0;
  constexpr double twice = 2.0;
  const Selection away = dmoc_rows(tables, slew_away);
  const Selection near = dmoc_rows(tables, slew_near);
  const auto growth = [&](const Row& row, const std::string& problem) {
    return quotient(on_grid_of(row, near, problem, slew_near), on_grid_of(row, away, problem, slew_away),
                    "state_error");
  };
  const Selection angles = near.where("problem", "satellite_angles");
  require(!angles.empty(), "{}.csv has no solved row of satellite_angles", slew_near);
  const double of_angles = -angles.max([&](const Row& row) { return -growth(row, "satellite_angles"); });
  const double of_others = angles.max([&](const Row& row) {
    double largest = 0.0;
    for (const std::string problem : by_multipliers) {
      largest = std::max({largest, growth(row, problem), growth(row, chart_of(problem))});
    }
    return largest;
  });
  return found(
      of_angles > ten_times && of_others < twice,
      "factor of the error of the attitude on the same grid: at least {:.1f} in Euler angles, at most {:.2f} in "
      "all others",
      Measurement{"least factor in Euler angles", of_angles, "dmoc"},
      Measurement{"largest factor in other coordinates", of_others, "dmoc"});
}

}  // namespace

/// Claims about coordinates of a rigid body.
Claims rigid_body_claims() {
  const auto claim = [](const char* id, const char* states, Predicate judge, const char* condition,
                        std::vector<std::string> evidence) {
    return Claim{.id = id,
                 .problems = rigid_body,
                 .where = "section 1, Lie groups",
                 .whose = Whose::extension,
                 .states = states,
                 .judge = std::move(judge),
                 .condition = condition,
                 .evidence = std::move(evidence)};
  };
  const std::string table_away = "rigid_body_coordinates.csv";
  const std::string table_near = "rigid_body_coordinates_near_singularity.csv";
  const std::string figure = "figures/rigid_body_coordinates.svg";
  return {
      claim("one_optimum", "the indirect optima in Euler angles and in a chart of attitudes are one motion",
            one_optimum, "a difference in the tenth digit would refute it", {table_away, table_near}),
      claim("one_order",
            "attitude, cost and replay have order 2s in Euler angles, by a quaternion, by directors, and in charts of "
            "both",
            one_order, "Gauss with s stages; an order further than 0.2 from 2s would refute it",
            {"rigid_body_coordinates_slopes.csv", "rigid_body_coordinates_near_singularity_slopes.csv"}),
      claim("charts",
            "charts per node of quaternions and of directors, as Lie group integrators have them, have the attitudes "
            "of multipliers, with as many unknowns as Euler angles",
            charts_and_multipliers, "DMOC, one Gauss stage; a difference above 1e-11 rad would refute it",
            {table_away, table_near}),
      claim("attitude_error",
            "with the unknowns of Euler angles, charts of quaternions and of directors have smaller errors of the "
            "attitude on every grid",
            attitude_error,
            "DMOC, one Gauss stage. One ratio of 1 or less would refute it; errors of cost and replay may be larger",
            {table_away, table_near, figure}),
      claim("near_singularity",
            "where the motion comes close to the singularity of Euler angles, their error of the attitude grows at "
            "least ten times, the error in other coordinates less than twice",
            near_singularity, "DMOC, one Gauss stage, on grids that are not too coarse for Euler angles",
            {table_near, figure})};
}

}  // namespace dmocbench
