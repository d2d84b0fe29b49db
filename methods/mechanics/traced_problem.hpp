#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "methods/expression/schedule.hpp"
#include "methods/expression/tape.hpp"
#include "methods/expression/vectors.hpp"
#include "methods/mechanics/problem.hpp"
#include "methods/mechanics/state.hpp"

namespace dmocbench {

/// A problem's formulas, traced once, with the derivatives that the equations of motion contain.
///
/// Every formula is a function of one point (q, v, u, y, t); `at` substitutes other formulas, such as an element
/// stage's, for the point.
class TracedProblem {
 public:
  /// The formulas at one point.
  struct Values {
    ExpressionVector momentum;                   ///< p = L_v, n entries (Legendre transform)
    ExpressionVector generalised_force;          ///< L_q + f = ṗ, n entries
    ExpressionVector configuration_force;        ///< L_q, n entries
    ExpressionVector control_force;              ///< f, n entries
    Expression running_cost;                     ///< C
    ExpressionVector path_constraints;           ///< h, as many entries as there are path constraints
    ExpressionMatrix mass;                       ///< L_vv, n × n
    ExpressionMatrix momentum_by_configuration;  ///< L_vq, n × n: ∂(L_v)_i/∂q_j
    ExpressionVector momentum_by_time;           ///< L_vt, n entries
    ExpressionVector first_order_rates;          ///< g = ẏ, l entries
    ExpressionMatrix momentum_by_first_order;    ///< L_vy, n × l
    ExpressionVector integrands;                 ///< c, as many entries as there are integral constraints
    ExpressionVector symmetry;                   ///< ξ(q), n entries, empty without symmetry
    ExpressionMatrix symmetry_jacobian;          ///< Dξ(q), n × n, empty without symmetry
  };

  /// The c constraints of the motion: the holonomic ones, g(q) = 0, then A(q) q̇ = 0.
  struct ConstraintValues {
    ExpressionVector residual;   ///< g, as many entries as there are holonomic ones
    ExpressionMatrix jacobian;   ///< G = ∂g/∂q, then A, c × n
    ExpressionVector curvature;  ///< Ġ v, c entries: G q̈ = -Ġ v keeps G q̇ = 0
  };

  /// The formulas of both ends of the horizon.
  struct EndValues {
    ExpressionVector conditions;  ///< r, as many entries as there are boundary conditions
    Expression final_cost;        ///< Φ
  };

  /// Calls each formula of the problem once. Throws `Error` that names the formula if a dimension is wrong or the
  /// Lagrangian does not depend on a velocity; that names a control or an unknown that no formula reads; or as
  /// `ParameterTrace` does about the parameters that are kept open.
  explicit TracedProblem(const Problem& problem, const std::vector<std::string>& open_parameters = {});

  /// The parameters that are kept open, by their numbers among all of the problem.
  [[nodiscard]] const std::vector<std::size_t>& open_parameters() const noexcept { return open_; }
  /// Per parameter of the problem, whether a formula contains its value, which can then not be changed.
  [[nodiscard]] const std::vector<bool>& are_constants() const noexcept { return are_constants_; }
  /// The names of those that could be kept open: formulas read them, and only by `Problem::varying`.
  [[nodiscard]] const std::vector<std::string>& varying_parameters() const noexcept { return varying_; }
  /// The present values of the open ones.
  [[nodiscard]] const Eigen::VectorXd& open_values() const noexcept { return open_values_; }
  /// Sets the values of open and of unknown parameters from the values of all parameters. Does not allocate.
  void set_parameters(const Eigen::VectorXd& values);
  /// How many parameters are unknowns of the problem.
  [[nodiscard]] Eigen::Index unknown_count() const noexcept { return unknown_values_.size(); }
  /// Sets the values of the unknown ones: the guess at first.
  void set_unknowns(const Eigen::VectorXd& values) { unknown_values_ = values; }
  /// The same problem whose formulas `at` have the open parameters as inputs 0, 1, ..., and these formulas for the
  /// unknown ones, not their present values.
  [[nodiscard]] TracedProblem with_open_inputs(const ExpressionVector& unknowns) const;

  [[nodiscard]] Eigen::Index configuration_size() const noexcept { return n_; }  ///< n.
  [[nodiscard]] Eigen::Index control_size() const noexcept { return m_; }        ///< m.
  [[nodiscard]] Eigen::Index first_order_size() const noexcept { return l_; }    ///< l.
  /// True if the problem has a symmetry to show.
  [[nodiscard]] bool has_symmetry() const noexcept { return has_symmetry_; }
  /// How many entries h has.
  [[nodiscard]] Eigen::Index path_constraint_count() const noexcept { return path_constraints_; }
  /// How many entries c has.
  [[nodiscard]] Eigen::Index integral_count() const noexcept { return integrals_; }
  /// Throws `Error` if there are constraints of the motion or an embedding in their place, which `method`, "a batch" or
  /// "the modified energy", does not have.
  void require_no_constraints(const char* method) const;
  /// How many constraints of the motion there are, g(q) = 0 and A(q) q̇ = 0: c.
  [[nodiscard]] Eigen::Index constraint_count() const noexcept { return constraint_count_; }
  /// How many of them are g(q) = 0.
  [[nodiscard]] Eigen::Index holonomic_count() const noexcept { return holonomic_count_; }
  /// How many of them are A(q) q̇ = 0.
  [[nodiscard]] Eigen::Index velocity_constraint_count() const noexcept { return constraint_count_ - holonomic_count_; }
  /// True of an `EmbeddedProblem`.
  [[nodiscard]] bool has_embedding() const noexcept { return of_stages_ != nullptr; }
  /// The formulas in the coordinates of stages: with an embedding the redundant statement's, otherwise these.
  [[nodiscard]] const TracedProblem& of_stages() const noexcept { return of_stages_ ? *of_stages_ : *this; }
  /// The configuration of a node at time t in the coordinates of stages: with an embedding Φ(θ, t), otherwise q.
  [[nodiscard]] ExpressionVector in_stages(const ExpressionVector& q, const Expression& t) const;
  /// Whether entry i of h reads a control.
  [[nodiscard]] const std::vector<bool>& constraints_read_controls() const noexcept {
    return constraints_read_controls_;
  }
  /// How many entries r has.
  [[nodiscard]] Eigen::Index boundary_condition_count() const noexcept { return boundary_conditions_; }
  /// True if the conditions or the cost of the ends depend on the velocity of the first or the last end, or on T.
  [[nodiscard]] bool ends_read_first_velocity() const { return ends_read(n_, n_); }
  /// True if r or Φ depends on q̇(T).
  [[nodiscard]] bool ends_read_last_velocity() const { return ends_read(3 * n_ + l_, n_); }
  /// True if r or Φ depends on T.
  [[nodiscard]] bool ends_read_horizon() const { return ends_read(4 * n_ + 2 * l_, 1); }
  /// True if L_v depends on t: then the momentum of a given velocity changes with the horizon.
  [[nodiscard]] bool momentum_depends_on_time() const noexcept { return momentum_depends_on_time_; }
  /// True if L_v depends on a first-order state.
  [[nodiscard]] bool momentum_depends_on_first_order() const noexcept { return momentum_depends_on_first_order_; }
  /// True if L_v depends on an unknown parameter.
  [[nodiscard]] bool momentum_depends_on_unknowns() const noexcept { return momentum_depends_on_unknowns_; }

  /// The formulas at many points, in numbers: row i belongs to points[i] at time times[i]. The columns hold p, L_q and
  /// f (n each), C, h, then L_vv column by column; further columns are not for callers.
  [[nodiscard]] Eigen::MatrixXd table(std::span<const MotionPoint> points, const Eigen::VectorXd& times) const;
  /// The same of points (q, v, u, y, t), one in each row.
  [[nodiscard]] Eigen::MatrixXd table(const Eigen::MatrixXd& rows) const;

  /// All formulas with the given point substituted. Throws `Error` if the point lacks first-order states: not every
  /// method supports them.
  [[nodiscard]] Values at(const ControlledState& point) const;
  /// The constraints of the motion at q and, for their curvature, at v.
  [[nodiscard]] ConstraintValues constraints_at(const ExpressionVector& q, const ExpressionVector& v) const;
  /// The formulas of the ends with the given states substituted.
  [[nodiscard]] EndValues at_ends(const State& first, const State& last) const;
  /// The same with u = 0, for formulas that do not depend on the control (momentum, mass, symmetry).
  [[nodiscard]] Values at(const State& point) const;

 private:
  void require_first_order(Eigen::Index given) const;
  void trace_formulas(const Problem& problem);
  void trace_constraints(const Problem& problem);
  /// Throws `Error` unless `rates` are `by_v` times the inputs v.
  void require_linear(const ExpressionVector& rates, const ExpressionMatrix& by_v, const Problem& problem) const;
  void trace_ends(const Problem& problem);
  /// Whether an input of the ends' formulas is read, numbered without the parameters.
  [[nodiscard]] bool ends_read(Eigen::Index first, Eigen::Index count) const;
  /// The formulas that `at` substitutes for the open and the unknown parameters.
  [[nodiscard]] ExpressionVector parameters() const;
  /// How many of the inputs of all formulas these are.
  [[nodiscard]] std::size_t parameter_inputs() const { return open_.size() + unknowns_.size(); }

  Eigen::Index n_;
  Eigen::Index m_;
  Eigen::Index l_;
  Eigen::Index path_constraints_ = 0;
  Eigen::Index integrals_ = 0;
  Eigen::Index holonomic_count_ = 0;
  Eigen::Index constraint_count_ = 0;
  Eigen::Index boundary_conditions_ = 0;
  bool has_symmetry_ = false;
  bool momentum_depends_on_time_ = false;
  bool momentum_depends_on_first_order_ = false;
  bool momentum_depends_on_unknowns_ = false;
  std::vector<bool> constraints_read_controls_;
  // The inputs of all formulas begin with the open parameters, then the unknown ones.
  std::vector<std::size_t> open_;
  std::vector<std::size_t> unknowns_;
  std::vector<bool> are_constants_;
  std::vector<std::string> varying_;
  Eigen::VectorXd open_values_;
  Eigen::VectorXd unknown_values_;
  bool has_open_inputs_ = false;
  ExpressionVector unknown_inputs_;  // where it has open inputs
  Schedule schedule_;
  Tape tape_;  // of the schedule
  Schedule constraints_;
  Schedule ends_;
  Schedule embedding_;
  std::shared_ptr<const TracedProblem> of_stages_;
};

}  // namespace dmocbench
