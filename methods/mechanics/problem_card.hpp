#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// A unit that tables and figures use: one unit of the problem as solved is `factor` times the unit `name`.
struct Unit {
  std::string name;     ///< "s", "m", "" where the problem has none
  double factor = 1.0;  ///< how many of these a unit of the problem as solved is
};

/// A published value of a problem's least cost.
struct PublishedOptimum {
  double objective = 0.0;  ///< the cost
  std::string source;      ///< where it was published
};

/// The known least cost of a problem: a closed form, or a number on which independent methods agree.
struct ReferenceOptimum {
  double objective = 0.0;  ///< the least cost
  /// Significant digits of `objective` that are certain; 16 for a closed form.
  int digits = 0;
  /// How it is known: "closed form", or which independent routes agree to that many digits.
  std::string certificate = {};
  std::vector<PublishedOptimum> published = {};  ///< by others, with their sources
  /// Where the published values differ from `objective`, and why; empty if they do not.
  std::string remark = {};
};

/// A quantity that a picture of the motion shows, e.g. the position of a tip.
struct PictureQuantity {
  std::string name;  ///< a column's name, "tip_x"
  std::string unit;  ///< "km", "" for a pure number
  Expression value;  ///< as a formula of the state and the control
};

/// All that a picture of the motion shows.
using Picture = std::vector<PictureQuantity>;

/// The units of what figures draw, as the problem is solved: "N m", "dimensionless" for a pure number, "" where none is
/// stated. The time axis has `ProblemCard::time_unit`.
struct AxisUnits {
  std::string state = {};     ///< of q
  std::string control = {};   ///< of u
  std::string momentum = {};  ///< of p
  std::string cost = {};      ///< of the cost
  std::string energy = {};    ///< of L

  /// All quantities are pure numbers.
  [[nodiscard]] static AxisUnits pure_numbers() {
    return {"dimensionless", "dimensionless", "dimensionless", "dimensionless", "dimensionless"};
  }
};

/// Words, units, a reference and a picture for people who read about a problem. No solver uses them.
struct ProblemCard {
  std::string description = {};  ///< one line
  std::string title = {};        ///< of figures, "Cart-pole swing-up"; by default the problem's name in words
  AxisUnits axis_units = {};     ///< of figures
  std::string source = {};       ///< where the problem comes from
  /// `Problem::guess` in words.
  std::string guess = "q on the straight line from q(0) to q(T) with slope v, u = 0";
  /// The unit of time that tables use for the step and figures for the time axis.
  Unit time_unit = {"s", 1.0};
  /// The units of q_1 .. q_n, "m" or "rad"; empty where none are stated. Figures show quantities of one unit in one
  /// panel, and their velocities per unit of the problem's time.
  std::vector<std::string> configuration_units = {};
  /// The units of u_1 .. u_m; empty where none are stated.
  std::vector<std::string> control_units = {};
  /// The least cost as far as it is known, for the parameters as they are set.
  std::optional<ReferenceOptimum> reference = {};
  /// Names of the entries of `Problem::path_constraints` in messages of failed solves; by default their numbers.
  std::vector<std::string> path_constraint_names = {};
  /// The same for `Problem::boundary_conditions`.
  std::vector<std::string> boundary_condition_names = {};
  /// The quantities in pictures of the motion; q and u by their names if empty (`pictured_quantities`). It may read
  /// the problem's parameters: the problem must outlive its use.
  std::function<Picture(const ControlledState& x)> picture = {};
};

}  // namespace dmocbench
