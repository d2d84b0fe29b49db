#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/parameter.hpp"
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

/// A mechanical optimal control problem, (eq:LOCP) of the paper with both ends and the horizon fixed:
///
///   minimise  ∫₀ᵀ C(q, q̇, u) dt   such that   δ∫₀ᵀ L(q, q̇) dt + ∫₀ᵀ f(q, q̇, u)·δq dt = 0,
///   (q, q̇)(0) = (q⁰, q̇⁰),  (q, q̇)(T) = (q^T, q̇^T).
///
/// A problem states L, f and C once, as traced expressions; no derivative, mass matrix or Hamiltonian is ever asked of
/// it. L must be regular: L_vv invertible along the motion. Formulas are plain C++ on `Expression`: they may loop and
/// call functions, but not branch on a traced value.
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

  [[nodiscard]] virtual BoundaryState initial_state() const = 0;
  [[nodiscard]] virtual BoundaryState final_state() const = 0;
  /// T > 0.
  [[nodiscard]] virtual double horizon() const = 0;

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
