#pragma once

#include <concepts>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/bounds.hpp"
#include "methods/mechanics/problem_card.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

class PhasedProblem;

/// A number of a problem that its user may set.
struct Parameter {
  std::string name;                                         ///< as on the command line: `--set name=value`
  double value = 0.0;                                       ///< the default, until set
  std::string unit;                                         ///< "kg", "km^3/s^2", "" for a pure number
  std::string meaning;                                      ///< one phrase
  double lower = -std::numeric_limits<double>::infinity();  ///< smallest allowed value
  double upper = std::numeric_limits<double>::infinity();   ///< largest allowed value
  bool whole = false;                                       ///< whole numbers only
  /// A solve chooses it in its range, from its value on: a constant of the motion that formulas read by
  /// `Problem::varying`.
  bool is_unknown = false;

  /// The allowed values in words: "a whole number in [1, 100]".
  [[nodiscard]] std::string range() const;
  /// Throws `Error` that names the parameter, its range and the value if `candidate` is not allowed.
  void check(double candidate) const;
};

/// A mechanical optimal control problem, (eq:LOCP) of the paper:
///
///   minimise  ∫₀ᵀ C(q, q̇, u) dt + Φ(q(T), q̇(T), T)
///   such that  δ∫₀ᵀ L(q, q̇) dt + ∫₀ᵀ f(q, q̇, u)·δq dt = 0,   h(q, q̇, u) >= 0,   r(q(0), q̇(0), q(T), q̇(T)) = 0,
///
/// where further states y may enter every formula, with rates ẏ = g(q, q̇, u, y) and held fixed in the variation, and
/// with bounds on both ends, on q, q̇ and u along the motion, on T and on further integrals ∫₀ᵀ c dt. Every formula may
/// depend on time, and on parameters of which some may be unknowns too. The simplest problem states L, f, C, two ends
/// and T, all of them fixed; all that it does not override is absent.
///
/// A problem states its formulas once, as traced expressions; no derivative, mass matrix or Hamiltonian is ever
/// required. L must be regular: L_vv invertible along the motion. Formulas are plain C++ on `Expression`: they may loop
/// and call functions, but not branch on a traced value.
///
/// n is the number of configuration names, m of control names, l of first-order states. All numbers are in
/// the units in which the problem is solved.
class Problem {
 public:
  virtual ~Problem() = default;

  /// snake_case, as on the command line. Default: from the class name, pendulum_swing_up for PendulumSwingUp.
  [[nodiscard]] virtual std::string name() const;
  /// A copy, with the parameters as they are set. (A variant of a problem is a class derived from it that overrides
  /// the differences.) Default: throws `Error` that shows how to implement it, in one line:
  /// `std::unique_ptr<Problem> clone() const override { return copy_of(*this); }`.
  [[nodiscard]] virtual std::unique_ptr<Problem> clone() const;
  /// Description, source, units, reference optimum, names of constraints and a picture, for people.
  [[nodiscard]] virtual ProblemCard card() const { return {}; }

  /// Names of q_1 to q_n; they name the columns of result files.
  [[nodiscard]] virtual std::vector<std::string> configuration_names() const = 0;
  /// Names of u_1 to u_m.
  [[nodiscard]] virtual std::vector<std::string> control_names() const = 0;

  /// Names of the first-order states y_1 to y_l: quantities that have rates, but no inertia, such as a mass, a current
  /// or a force that grows no faster than its actuator lets it. Default: none.
  [[nodiscard]] virtual std::vector<std::string> first_order_names() const { return {}; }
  /// ẏ = g(q, v, u, y, t), l entries. Forces may contain ẏ by calling this function.
  [[nodiscard]] virtual ExpressionVector first_order_rates(const ControlledState& /*x*/) const { return {}; }

  /// The Lagrangian L(q, v, t).
  [[nodiscard]] virtual Expression lagrangian(const State& x) const = 0;
  /// The Lagrangian control force f(q, v, u, t), n entries; damping belongs here too.
  [[nodiscard]] virtual ExpressionVector force(const ControlledState& x) const = 0;
  /// The integrand C(q, v, u, t) of the cost.
  [[nodiscard]] virtual Expression running_cost(const ControlledState& x) const = 0;

  /// (q⁰, q̇⁰) and (q^T, q̇^T). Where the bounds of an end leave a component free, the guess takes this value.
  [[nodiscard]] virtual BoundaryState initial_state() const = 0;
  /// The state at T: (q^T, q̇^T). Where the bounds of this end leave a component free, the guess takes this value.
  [[nodiscard]] virtual BoundaryState final_state() const = 0;
  /// T > 0; where T is free, the guess takes this value.
  [[nodiscard]] virtual double horizon() const = 0;

  // Optional parts of a problem.

  /// Bounds on the ends, on T and along the motion. Default: both ends and T fixed, nothing else bounded. Overrides
  /// start from `Problem::bounds()`.
  [[nodiscard]] virtual ProblemBounds bounds() const;
  /// h(q, q̇, u, t) >= 0 at every stage (eq:LOCP4), (eq:gDLOCP5): as many entries as there are constraints. With
  /// `ProblemBounds::path` lower <= h <= upper, entry by entry; equal bounds make an equality along the motion, of
  /// which there may be at most m. Bounds on forces of constraint read `constraint_multipliers`.
  [[nodiscard]] virtual ExpressionVector path_constraints(const ControlledState& /*x*/) const { return {}; }
  /// g(q) = 0, c entries, of a mechanism in redundant coordinates: the forces of constraint -(∂g/∂q)ᵀλ hold the motion
  /// there. G = ∂g/∂q needs full rank along the motion, and c < n; L_vv may then be singular as long as
  /// (L_vv, Gᵀ; G, 0) is not. Forces are evaluated off g = 0 too, and have to be smooth there. Default: none.
  [[nodiscard]] virtual ExpressionVector constraints(const ExpressionVector& /*q*/) const { return {}; }
  /// A(q) q̇ = 0 that is not the rate of any g, of a blade or of a wheel that rolls: the entries of A(q) v, each linear
  /// in v. The forces of constraint -A(q)ᵀλ hold the motion there by the Lagrange-d'Alembert principle, so that motions
  /// are not varied along A. G and A together need full rank along the motion, and fewer than n rows. Default: none.
  [[nodiscard]] virtual ExpressionVector velocity_constraints(const ExpressionVector& /*q*/,
                                                              const ExpressionVector& /*v*/) const {
    return {};
  }
  /// q = Φ(θ), n entries, of n - c coordinates θ with g(Φ(θ)) = 0: `EmbeddedProblem` takes it in the place of
  /// multipliers. Default: none.
  [[nodiscard]] virtual ExpressionVector embedding(const ExpressionVector& /*theta*/) const { return {}; }
  /// q = Φ(θ, t), where no chart of the manifold is regular along the whole motion: a chart that moves with it, at
  /// every node another one. Default: `embedding(theta)`.
  [[nodiscard]] virtual ExpressionVector moving_embedding(const ExpressionVector& theta,
                                                          const Expression& /*t*/) const {
    return embedding(theta);
  }
  /// The problem with constraints whose `embedding` has the coordinates of this one, an `EmbeddedProblem`: stages are
  /// in its coordinates. Default: null.
  [[nodiscard]] virtual const Problem* redundant() const { return nullptr; }
  /// This problem as phases that follow each other; null of other problems.
  [[nodiscard]] virtual const PhasedProblem* phased() const { return nullptr; }
  /// c(q, q̇, u, t) of the integral constraints lower <= ∫₀ᵀ c dt <= upper, whose bounds are
  /// `ProblemBounds::integrals`: as many entries as there are. Every method integrates them as it does the cost.
  [[nodiscard]] virtual ExpressionVector integrands(const ControlledState& /*x*/) const { return {}; }
  /// r(q(0), q̇(0), q(T), q̇(T)) = 0 (eq:LOCP5), (eq:gDLOCP6), periodicity among them: as many entries as there are
  /// conditions. `last.t` is T.
  [[nodiscard]] virtual ExpressionVector boundary_conditions(const State& /*first*/, const State& /*last*/) const {
    return {};
  }
  /// The Mayer term Φ(q(T), q̇(T), T); `last.t` is T, so that `return last.t` states a minimum-time problem.
  [[nodiscard]] virtual Expression final_cost(const State& /*last*/) const { return {}; }

  /// The factor by which solvers see the cost, so that its optimum is of order 1: the same for every method, grid and
  /// solver. Tolerances of solvers apply to the scaled cost; tables show the true cost, and metadata the factor.
  ///
  /// Default: the power of two (which changes no digit) nearest to 1/c, where c = ∫ |C| dt + |Φ| along the guess, by
  /// the midpoint rule with 64 points; 1 where that is between 1/32 and 32, or c vanishes or is not a number.
  [[nodiscard]] virtual double cost_scale() const;

  /// The infinitesimal generator ξ(q) of a group action under which the momentum p·ξ(q) is worth watching: L or its
  /// kinetic part is invariant under it. n entries; none if the problem has no symmetry to show.
  [[nodiscard]] virtual std::optional<ExpressionVector> symmetry(const ExpressionVector& /*q*/) const { return {}; }

  /// The motion from which solves start at time t: straight lines, constants, or an elementary formula of a few
  /// numbers. Default: q and y on straight lines between the ends, v constant, u = 0. `ProblemCard::guess` states it in
  /// words.
  [[nodiscard]] virtual MotionPoint guess(double t) const;

  /// The optimal motion at time 0 <= t <= T in closed form, at a jump of the costate its value after the jump. Default:
  /// empty, as where the parameters permit no motion.
  [[nodiscard]] virtual std::optional<OptimalPoint> optimum(double /*t*/) const { return {}; }

  [[nodiscard]] Eigen::Index configuration_size() const;  ///< n.
  [[nodiscard]] Eigen::Index control_size() const;        ///< m.
  [[nodiscard]] Eigen::Index first_order_size() const;    ///< l.

  /// All parameters with their values, in the order of the constructor; of a `ForwardingProblem` the original's.
  [[nodiscard]] virtual const std::vector<Parameter>& parameters() const noexcept { return parameters_; }
  /// The value of a parameter, as this thread sees it (`ParameterScope`). Throws `Error` if the name is unknown.
  [[nodiscard]] double parameter(std::string_view name) const;
  /// A parameter for formulas whose value may change without a new trace. In a transcription that keeps the parameter
  /// open (`OpenParameters`) it is an input of the trace; everywhere else it is its present value. Throws as
  /// `parameter`.
  [[nodiscard]] Expression varying(std::string_view name) const;
  /// The indices of the unknown parameters (`Parameter::is_unknown`) among all parameters.
  [[nodiscard]] std::vector<std::size_t> unknowns() const;
  /// Sets a parameter. Throws `Error` if the name is unknown, the value is not allowed or it is another problem's.
  void set_parameter(std::string_view name, double value);
  /// True if every parameter, except the ones named in `except`, has its default value. A certified optimum holds only
  /// for the data with which it was computed.
  [[nodiscard]] bool has_default_parameters(std::initializer_list<std::string_view> except = {}) const;

  /// The parameters that differ from their defaults, as on the command line: "mass=2 length=0.5"; empty if none does.
  [[nodiscard]] virtual std::string settings() const;

 protected:
  /// With these parameters, at their defaults.
  explicit Problem(std::vector<Parameter> parameters = {});
  // Classes of problems are copied, never a problem by its base.
  Problem(const Problem&) = default;
  Problem& operator=(const Problem&) = default;
  Problem(Problem&&) = default;
  Problem& operator=(Problem&&) = default;

  /// For `clone`. Throws `Error` if the problem is of a class derived from `Class`, whose additions would be lost.
  template <std::derived_from<Problem> Class>
  [[nodiscard]] static std::unique_ptr<Problem> copy_of(const Class& problem) {
    if (typeid(problem) != typeid(Class)) static_cast<void>(problem.Problem::clone());
    return std::make_unique<Class>(problem);
  }

 private:
  std::vector<Parameter> parameters_;
  std::vector<double> defaults_;
};

/// The picture of the motion at a point: from the problem's card, or else q and u by their names.
[[nodiscard]] Picture pictured_quantities(const Problem& problem, const ControlledState& x);

}  // namespace dmocbench
