#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/bounds.hpp"
#include "methods/mechanics/parameter.hpp"
#include "methods/mechanics/reference_optimum.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// A unit that figures use: one unit of the problem as solved is `factor` of what `name` says.
struct Unit {
  std::string name;
  double factor = 1.0;
};

/// A quantity that a picture of the motion shows, e.g. the position of a tip.
struct PictureQuantity {
  std::string name;  ///< a column's name, "tip_x"
  std::string unit;  ///< "km", "" for a pure number
  Expression value;
};

/// A mechanical optimal control problem, (eq:LOCP) of the paper:
///
///   minimise  ∫₀ᵀ C(q, q̇, u) dt + Φ(q(T), q̇(T), T)
///   such that  δ∫₀ᵀ L(q, q̇) dt + ∫₀ᵀ f(q, q̇, u)·δq dt = 0,   h(q, q̇, u) >= 0,   r(q(0), q̇(0), q(T), q̇(T)) = 0,
///
/// with bounds on both ends, on q, q̇ and u along the motion, and on T. Every formula may depend on time. What is not
/// overridden is not there: the simplest problem states L, f, C, two ends and T, all of them fixed.
///
/// A problem states its formulas once, as traced expressions; no derivative, mass matrix or Hamiltonian is ever asked
/// of it. L must be regular: L_vv invertible along the motion. Formulas are plain C++ on `Expression`: they may loop
/// and call functions, but not branch on a traced value.
///
/// n is the number of configuration names, m that of control names. All numbers are in the units in which the problem
/// is solved.
class Problem {
 public:
  virtual ~Problem() = default;
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;
  Problem(Problem&&) = delete;
  Problem& operator=(Problem&&) = delete;

  /// snake_case, as on the command line.
  [[nodiscard]] virtual std::string name() const = 0;
  /// One line.
  [[nodiscard]] virtual std::string description() const = 0;
  /// Where the problem comes from.
  [[nodiscard]] virtual std::string source() const = 0;

  /// Names of q_1 .. q_n; they name the columns of result files.
  [[nodiscard]] virtual std::vector<std::string> configuration_names() const = 0;
  /// Names of u_1 .. u_m.
  [[nodiscard]] virtual std::vector<std::string> control_names() const = 0;

  /// The Lagrangian L(q, v, t).
  [[nodiscard]] virtual Expression lagrangian(const State& x) const = 0;
  /// The Lagrangian control force f(q, v, u, t), n entries; damping belongs here too.
  [[nodiscard]] virtual ExpressionVector force(const ControlledState& x) const = 0;
  /// The integrand C(q, v, u, t) of the cost.
  [[nodiscard]] virtual Expression running_cost(const ControlledState& x) const = 0;

  /// (q⁰, q̇⁰) and (q^T, q̇^T). Of a component that the bounds of that end leave free, the value that the guess takes.
  [[nodiscard]] virtual BoundaryState initial_state() const = 0;
  [[nodiscard]] virtual BoundaryState final_state() const = 0;
  /// T > 0; where it is free, the value that the guess takes.
  [[nodiscard]] virtual double horizon() const = 0;

  // What a problem may prescribe besides. Default: both ends and the horizon fixed, nothing else.

  /// Bounds on (q, q̇)(0) and (q, q̇)(T).
  [[nodiscard]] virtual EndBounds initial_bounds() const { return EndBounds::fixed(initial_state()); }
  [[nodiscard]] virtual EndBounds final_bounds() const { return EndBounds::fixed(final_state()); }
  [[nodiscard]] virtual HorizonBounds horizon_bounds() const { return {horizon(), horizon()}; }
  /// Bounds on q at every node, n entries or none.
  [[nodiscard]] virtual Bounds configuration_bounds() const { return {}; }
  /// Bounds on q̇ at every stage, n entries or none.
  [[nodiscard]] virtual Bounds velocity_bounds() const { return {}; }
  /// Bounds on u at every stage, m entries or none.
  [[nodiscard]] virtual Bounds control_bounds() const { return {}; }
  /// h(q, q̇, u, t) >= 0 at every stage (eq:LOCP4), (eq:gDLOCP5): as many entries as there are constraints.
  [[nodiscard]] virtual ExpressionVector path_constraints(const ControlledState& x) const;
  /// r(q(0), q̇(0), q(T), q̇(T)) = 0 (eq:LOCP5), (eq:gDLOCP6), periodicity among them: as many entries as there are
  /// conditions. `last.t` is T.
  [[nodiscard]] virtual ExpressionVector boundary_conditions(const State& first, const State& last) const;
  /// The Mayer term Φ(q(T), q̇(T), T); `last.t` is T, so that `return last.t` asks for the shortest time.
  [[nodiscard]] virtual Expression final_cost(const State& last) const;

  /// The least cost as far as it is known, for the parameters as they are set.
  [[nodiscard]] virtual std::optional<ReferenceOptimum> reference_optimum() const { return std::nullopt; }

  /// What the cost is multiplied by before a solver sees it, so that its optimum is of order 1. Tables show the true
  /// cost.
  [[nodiscard]] virtual double cost_scale() const { return 1.0; }

  /// The infinitesimal generator ξ(q) of a group action under which the momentum p·ξ(q) is worth watching: L or its
  /// kinetic part is invariant under it. n entries; none if the problem has no symmetry to show.
  [[nodiscard]] virtual std::optional<ExpressionVector> symmetry(const ExpressionVector& q) const;

  /// The motion from which solves start at time t: straight lines, constants, or an elementary formula of a few
  /// numbers. Default: q on the straight line between the ends, v its slope, u = 0.
  [[nodiscard]] virtual MotionPoint guess(double t) const;
  /// The guess in words.
  [[nodiscard]] virtual std::string guess_description() const;

  /// The unit of time that tables use for the step, and figures for the time axis.
  [[nodiscard]] virtual Unit time_unit() const { return {"s", 1.0}; }
  /// What a picture of the motion shows. Default: q and u by their names.
  [[nodiscard]] virtual std::vector<PictureQuantity> picture(const ControlledState& x) const;

  [[nodiscard]] Eigen::Index configuration_size() const;
  [[nodiscard]] Eigen::Index control_size() const;

  [[nodiscard]] const std::vector<Parameter>& parameters() const noexcept { return parameters_; }
  /// The value of a parameter. Throws `Error` if there is none of that name.
  [[nodiscard]] double parameter(std::string_view name) const;
  /// Sets a parameter. Throws `Error` if there is none of that name or the value is not allowed.
  void set_parameter(std::string_view name, double value);

 protected:
  explicit Problem(std::vector<Parameter> parameters = {});

 private:
  [[nodiscard]] std::size_t parameter_index(std::string_view name) const;
  std::vector<Parameter> parameters_;
};

}  // namespace dmocbench
