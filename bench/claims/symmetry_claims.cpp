// Momentum along optimal motions, and for a group that is not abelian.
#include <cmath>

#include "bench/claims/claim.hpp"

namespace dmocbench {

namespace {

Finding optimal_motions_keep_momentum(const ResultTables& tables, const std::string& /*problem*/) {
  // DMOC's momenta are differences of positions divided by h: their rounding is known.
  constexpr double within_rounding = 10.0;
  constexpr double beyond_rounding = 1000.0;
  const Selection rows = tables.rows("invariants_orthogonal_forces");
  const auto deviation = [](const Row& row) {
    require(row.needed("rounding") > 0.0, "{}, column rounding: the value must be positive", row.place());
    return row.needed("momentum_deviation") / row.needed("rounding");
  };
  const auto is_tangent = [](const Row& row) { return row.text("method") == "tangent"; };
  const Selection tangent = rows.where(is_tangent);
  const Selection structured = rows.where(std::not_fn(is_tangent));
  require(!tangent.empty() && !structured.empty(),
          "invariants_orthogonal_forces.csv needs rows of dmoc and of tangent");
  const double kept = structured.max(deviation);
  double least = std::numeric_limits<double>::infinity();
  for (const Row& row : tangent) least = std::min(least, deviation(row));
  return found(kept < within_rounding && least > beyond_rounding,
               "|J_k - J_0| in units of round-off on {} optimal trajectories by DMOC and Hamiltonian: at most {:.1f}",
               structured.size(), Measurement{"largest deviation in units of round-off", kept})
      .also(worded("on {} by tangent-space collocation: {:.1e} to {:.1e}", tangent.size(),
                   Measurement{"least deviation in units of round-off", least, "tangent"},
                   Measurement{"largest deviation in units of round-off", tangent.max(deviation), "tangent"}));
}

Finding balanced_about_every_axis(const ResultTables& tables, const std::string& /*problem*/) {
  constexpr double rounding_in_long_double = 1e-15;
  constexpr double does_work = 1e-4;
  const Selection rows = tables.rows("invariants_rotations");
  const auto is_structured = [](const Row& row) { return row.text("method") != "tangent"; };
  const Selection linear = rows.where("action", "linear").where(is_structured);
  for (const char* axis : {"1", "2", "3"}) {
    require(!linear.where("axis", axis).empty(), "invariants_rotations.csv has no row of axis {}", axis);
  }
  const auto is_balanced = [&](const Row& row) {
    return row.needed("defect") < rounding_in_long_double && std::abs(row.needed("work")) > does_work;
  };
  const auto defect = [](const Row& row) { return row.needed("defect"); };
  const Selection polar = rows.where("action", "polar").where("method", "dmoc");
  const Selection tangent = rows.where("action", "linear").where("method", "tangent");
  require(!polar.empty() && !tangent.empty(),
          "invariants_rotations.csv needs rows in polar coordinates and of tangent");
  return found(std::ranges::all_of(linear, is_balanced),
               "three axes, {} trajectories of 400 steps by DMOC and Hamiltonian: the largest |change of J - work| is "
               "{:.1e}",
               linear.group_by({"problem", "method"}).size(), Measurement{"largest defect", linear.max(defect)})
      .also(worded("with tangent-space collocation up to {:.1e}",
                   Measurement{"largest defect", tangent.max(defect), "tangent"}))
      .also(worded("with DMOC in polar coordinates on the sphere up to {:.1e}",
                   Measurement{"largest defect", polar.max(defect), "dmoc", "polar coordinates"}));
}

}  // namespace

/// Momentum along optimal motions.
Claims optimal_momentum_claims() {
  return {{.id = "momentum_of_optimal_motions",
           .problems = examples,
           .where = "section 3.3, th:discforcNoe",
           .whose = Whose::paper,
           .states = "where the force is orthogonal to the group action, the momentum is also preserved in the optimal "
                     "control problem",
           .judge = optimal_motions_keep_momentum,
           .evidence = {"invariants_orthogonal_forces.csv"}}};
}

/// Momentum about three axes.
Claims rotation_claims() {
  return {{.id = "rotations_about_three_axes",
           .problems = simulated,
           .where = "section 2.2, eq:noether_force_d",
           .whose = Whose::paper,
           .states = "the momentum about every axis changes by the work of the discrete forces, also for a group that "
                     "is not abelian",
           .judge = balanced_about_every_axis,
           .condition = "the discrete Lagrangian must be invariant, which holds where rotations act linearly on the "
                        "coordinates; in polar coordinates it is invariant only about one axis",
           .evidence = {"invariants_rotations.csv"}}};
}

}  // namespace dmocbench
