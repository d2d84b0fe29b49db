#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "methods/expression/vectors.hpp"
#include "methods/mechanics/state.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

/// The second part of a node's state besides its configuration q_k.
enum class NodeState : std::uint8_t {
  configuration,  ///< nothing: x_k = q_k
  momentum,       ///< x_k = (q_k, p_k)
  velocity,       ///< x_k = (q_k, v_k)
};

/// The unknowns of one interval [t_k, t_{k+1}], as traced numbers.
struct IntervalUnknowns {
  ExpressionVector left_q;        ///< q_k, n entries
  ExpressionVector left_second;   ///< p_k or v_k, n entries; empty where nodes carry q alone
  ExpressionVector right_q;       ///< q_{k+1}
  ExpressionVector right_second;  ///< p_{k+1} or v_{k+1}
  /// Q̇_1 .. Q̇_{s-1} at the stages of `Element::rates`, the last stage rate is eliminated; none of shooting.
  std::vector<ExpressionVector> rates_q;
  std::vector<ExpressionVector> rates_second;  ///< Ṗ_j or V̇_j, j = 1 .. s-1; none of shooting
  std::vector<ExpressionVector> controls;      ///< U_1 .. U_s at the stages of `Element::controls`, m entries each
  ExpressionVector left_y;                     ///< y_k, l entries
  ExpressionVector right_y;                    ///< y_{k+1}
  std::vector<ExpressionVector> rates_y;       ///< Ẏ_1 .. Ẏ_s of which the last is eliminated; none without y
  std::vector<ExpressionVector> stages_y;      ///< Y_i = y_k + h Σ_j a_ij Ẏ_j; none without y
  /// λ of the constraints, `Element::multipliers` vectors: of all c constraints, or of g(q) = 0 alone; none without
  /// constraints.
  std::vector<ExpressionVector> multipliers;
  Expression h;  ///< the step
  Expression t;  ///< t_k

  /// Y_i; without entries where there are no first-order states.
  [[nodiscard]] ExpressionVector stage_y(std::size_t i) const {
    return stages_y.empty() ? ExpressionVector() : stages_y[i];
  }
};

/// The formulas of an element for one interval.
struct IntervalTrace {
  ExpressionVector left_rows;        ///< added to the equations of node k; n entries or none
  ExpressionVector right_rows;       ///< added to the equations of node k + 1
  ExpressionVector stage_equations;  ///< equations of this interval alone, each equal to 0
  Expression cost;                   ///< h Σ b_i C(Q_i, Q̇_i, U_i)
  /// (Q_i, Q̇_i, U_i, t_k + c_i h, Y_i); V_i for tangent-space collocation. In the coordinates of
  /// `TracedProblem::of_stages`.
  std::vector<ControlledState> stages;
  ExpressionVector left_momentum;   ///< p_k seen from this interval, n entries
  ExpressionVector right_momentum;  ///< p_{k+1} seen from this interval, n entries
  /// The impulses of the forces of constraint at node k and at node k + 1 that belong to this interval, n entries each;
  /// empty without constraints. With them p_{k+1}·ξ(q_{k+1}) - p_k·ξ(q_k) balances the work along a symmetry ξ.
  ExpressionVector left_impulse;
  ExpressionVector right_impulse;              ///< see `left_impulse`
  std::vector<ExpressionVector> stage_forces;  ///< the forces of constraint at the stages; none where all are impulses
};

/// One interval of a direct transcription, for any Butcher tableau: the part that distinguishes methods.
///
/// The motion between the nodes x_k and x_{k+1} is replaced by finitely many numbers: s stage rates, of which the last
/// is eliminated, and s controls U_1 .. U_s. An element is a rule, not data: given the formulas of a problem and traced
/// unknowns, it returns the formulas of an interval (`IntervalTrace`),
///   e(x_k, rates, x_{k+1}, U) = 0          its stage equations,
///   l, r                                   its share of the equations of node k and of node k + 1,
///   c = ∫ C dt + O(h^(r+1))                its share of the cost, r the order of the method,
///   p_k⁻, p_{k+1}⁺                         the momenta at both ends, as the interval sees them.
/// The program is then: minimise Σ c over all intervals such that e = 0 on each interval and r + l = 0 at each inner
/// node, r from the interval before it and l from the one after it. Numbering, sparsity, derivatives, boundary
/// conditions and costates are generic (`Transcription`).
///
/// First-order states are collocated by the tableau, the same for every element: Ẏ_i = g at the stages. An element
/// takes Y_i where its formulas read y, and holds it fixed where it varies q.
///
/// With n the number of configurations, m of controls and d the size of a node, n for `NodeState::configuration` and 2n
/// otherwise, every element satisfies four identities, which `broken_identities` (methods/diagnostics) checks.
///
/// 1. Counts. An interval has as many equations as unknowns besides its controls (rem:savings): e and l together have d
///    entries for its node and d for each interior stage rate; with rates and controls at its s stages that is
///      DMOC                  n of l,  (s - 1) n of e          for sn + sm unknowns,
///      collocation           none,    2sn of e                for 2sn + sm unknowns,
///      no stage unknowns     none,    2n of e                 for 2n + sm unknowns.
///    r has as many entries as l. Stage i is at the time t_k + c_i h and has the control U_i; where controls have nodes
///    of their own, the value of the polynomial through them.
///
/// 2. Consistency. p_k⁻ = p and e = 0 determine all unknowns of an interval but q_k and the controls. Started on an
///    exact motion, with the exact controls at the stage times, this map (q_k, p_k) ↦ (q_{k+1}, p_{k+1}⁺) and the cost
///    miss the motion and its cost by O(h^(r+1)). For DMOC and collocation r is the order of the tableau; for shooting
///    it is the smaller one of this and the order of the integrator.
///
/// 3. Momenta. l = -p_k⁻ and r = p_{k+1}⁺ where nodes carry q alone: the forced discrete Legendre transforms
///    (eq:varmech_dlegf), whose two values at a node add up to the equation of the node. Otherwise the momenta are
///    the nodes' p_k, or L_v(q_k, v_k, t_k).
///
/// 4. Costates. With multipliers μ, λ for which ℓ = c + μ·(p_k⁻ - p) + λ·e + w·(q_{k+1}, p_{k+1}⁺) is stationary in all
///    unknowns of the map, (∂ℓ/∂q_k, -μ) is the gradient by (q_k, p_k) of the cost to go c + w·(q_{k+1}, p_{k+1}⁺), for
///    every w. Hence ψ_k is the derivative of the Lagrangian of an interval by its left node (`costates`).
class Element {
 public:
  virtual ~Element() = default;
  Element(const Element&) = delete;
  Element& operator=(const Element&) = delete;

  /// As on the command line.
  [[nodiscard]] std::string name() const { return name_; }
  /// One line.
  [[nodiscard]] std::string description() const { return description_; }
  /// The second part of the nodes' states.
  [[nodiscard]] NodeState node_state() const noexcept { return node_state_; }
  /// True if the stages are unknowns of the program, with equations of their own; false if an interval is a map of its
  /// left node and controls (shooting).
  [[nodiscard]] virtual bool has_stage_unknowns() const { return true; }
  /// How many multipliers each holonomic constraint has per interval: as many as its conditions among the stage
  /// equations. Throws `Error` if constraints are not offered with the tableau; default: with none.
  [[nodiscard]] virtual Eigen::Index multipliers(const Tableau& tableau) const;
  /// For each of them, whether velocity constraints have it too, and its condition. Throws likewise.
  [[nodiscard]] virtual std::vector<bool> velocity_multipliers(const Tableau& tableau) const;
  /// Whether nodes may carry θ of an embedding q = Φ(θ) instead (`EmbeddedProblem`); default: no.
  [[nodiscard]] virtual bool takes_embedding(const Tableau& tableau) const;
  /// The tableau at whose stages rates of q are unknowns, all but the last. Throws `Error` if the element cannot be
  /// used with this tableau.
  [[nodiscard]] virtual Tableau rates(const Tableau& tableau) const { return tableau; }
  /// The tableau at whose stages the controls are unknowns, and whether neighbouring intervals share one. Throws
  /// likewise.
  [[nodiscard]] virtual Tableau controls(const Tableau& tableau) const { return tableau; }
  /// The formulas of one interval; all vectors have the sizes that `IntervalTrace` names.
  [[nodiscard]] virtual IntervalTrace trace(const TracedProblem& problem, const Tableau& tableau,
                                            const IntervalUnknowns& unknowns) const = 0;

 protected:
  /// See `name()`, `description()` and `node_state()`.
  Element(std::string name, std::string description, NodeState node_state)
      : name_(std::move(name)), description_(std::move(description)), node_state_(node_state) {}

 private:
  std::string name_;
  std::string description_;
  NodeState node_state_;
};

/// The unknowns of an interval of an element as the next inputs of `counter`: nodes (q, p or v, y), rates of q, of p or
/// v and of y, controls, multipliers of constraints. h, t, the last rate of y and its stages are left to the
/// caller.
[[nodiscard]] IntervalUnknowns take_unknowns(InputCounter& counter, const TracedProblem& problem,
                                             const Element& element, const Tableau& tableau);

/// The element of a method of one of the registered families (`Family`). Throws `Error` that lists the methods if there
/// is no such method, or names the missing part of a name with an integrator.
[[nodiscard]] std::unique_ptr<Element> make_element(std::string_view name);

/// Whether a tableau has stages at both ends of an interval, as Lobatto's has.
[[nodiscard]] bool has_stages_at_nodes(const Tableau& tableau);

/// Whether a method has the constraints of the motion of a problem with a tableau, or takes its embedding; true of
/// problems without.
[[nodiscard]] bool takes_constraints(const Element& element, const TracedProblem& problem, const Tableau& tableau);

// Formulas that the families share.

/// -Gᵀλ at a configuration: the force of the constraints, n entries; λ of the first ones, or of all.
[[nodiscard]] ExpressionVector constraint_force(const TracedProblem& problem, const ExpressionVector& q,
                                                const ExpressionVector& multiplier);

/// A(q) v of the velocity constraints, an entry each.
[[nodiscard]] ExpressionVector velocity_conditions(const TracedProblem& problem, const ExpressionVector& q,
                                                   const ExpressionVector& v);

/// All s stage rates: the interior ones and the last, K_s = ((x_{k+1} - x_k)/h - Σ_{j<s} b_j K_j) / b_s.
[[nodiscard]] std::vector<ExpressionVector> stage_rates(const ExpressionVector& left, const ExpressionVector& right,
                                                        const std::vector<ExpressionVector>& interior,
                                                        const Eigen::VectorXd& b, const Expression& h);

/// The stages X_i = x_k + h Σ_j a_ij K_j.
[[nodiscard]] std::vector<ExpressionVector> stage_values(const ExpressionVector& left,
                                                         const std::vector<ExpressionVector>& rates,
                                                         const Eigen::MatrixXd& a, const Expression& h);

/// The value at τ of the polynomial through values at the times c: Σ_j ℓ_j(τ) x_j.
[[nodiscard]] ExpressionVector polynomial_at(const Eigen::VectorXd& c, const std::vector<ExpressionVector>& values,
                                             double tau);

/// A quantity that varies and the force that does work on its variation.
struct ConjugatePair {
  ExpressionVector moved;  ///< X, e.g. the configuration Q_i of a stage
  ExpressionVector force;  ///< y, as many entries as X
};

/// h Σ_i b_i Σ_X (∂X/∂x)ᵀ y, the sum over the pairs of each stage: the gradient of an action, or a virtual work, in the
/// unknowns x, which are inputs. As many entries as x.
[[nodiscard]] ExpressionVector variation(const ExpressionVector& x,
                                         const std::vector<std::vector<ConjugatePair>>& stages,
                                         const Eigen::VectorXd& b, const Expression& h);

/// The virtual work h Σ b_i f·∂Q_i/∂x of the control forces alone.
[[nodiscard]] ExpressionVector work_of_control(const TracedProblem& problem, const std::vector<ControlledState>& stages,
                                               const ExpressionVector& x, const Eigen::VectorXd& b,
                                               const Expression& h);

/// h Σ b_i C(stage i).
[[nodiscard]] Expression quadrature_of_cost(const std::vector<TracedProblem::Values>& stages, const Eigen::VectorXd& b,
                                            const Expression& h);

}  // namespace dmocbench
