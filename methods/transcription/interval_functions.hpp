#pragma once

#include <vector>

#include "methods/mechanics/traced_problem.hpp"
#include "methods/transcription/derivatives/local_functions.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

/// Properties of the problem, besides its formulas, on which the functions of an interval depend.
struct IntervalRules {
  double cost_scale = 1.0;    ///< `Problem::cost_scale`
  bool mayer = false;         ///< the cost so far is a further unknown of every node, (eq:gDLOCP_mayer)
  bool free_horizon = false;  ///< T is an unknown
  std::vector<Eigen::Index> bounded_velocities = {};  ///< the i whose q̇_i has bounds
};

/// All functions of an interval, traced and differentiated once for all intervals.
///
/// Inputs: `LocalInputs`, the open parameters first.
/// Local unknowns: as in `IntervalUnknowns`, in its order; z_k and z_{k+1}, the sums up to either node: the cost in
/// Mayer form, then the integrals; T where it is free; unknown parameters.
/// Local constraints (rows): left and right terms and stage equations of the element, Ẏ_i = g of first-order
/// states; path constraints, which are not
/// equalities of the element: per stage the bounded velocities, then h(Q_i, Q̇_i, U_i); z_{k+1} - z_k less the
/// interval's contribution to each sum. `adjoint` is ∂ℓ/∂(left node), then ∂ℓ/∂(right node).
struct IntervalFunctions : LocalFunctions {
  bool has_stage_unknowns = true;    ///< of the element
  Tableau rates;                     ///< `Element::rates`
  Tableau controls;                  ///< `Element::controls`
  Eigen::Index node_rows = 0;        ///< equations that belong to nodes
  Eigen::Index stage_equations = 0;  ///< stage equations of the element
  Eigen::Index path_rows = 0;        ///< path constraints, at all stages
  bool mayer = false;                ///< the cost so far is an unknown of the nodes
  bool free_horizon = false;         ///< T is an unknown

  Eigen::Index integrals = 0;  ///< integral constraints

  Eigen::Index multipliers = 0;          ///< of constraints, in all
  std::vector<Eigen::Index> conditions;  ///< how many of them each vector has, and rows of its condition

  Schedule momenta;  ///< left momentum, right momentum; with constraints left impulse, right impulse, forces at stages
  Schedule stages;   ///< per stage: Q_i, Q̇_i, t_i, U_i, Y_i, Ẏ_i
};

/// The equation that ties the velocity of a node between the ends, an unknown of its own, to the momentum of the node:
/// p_{k+1} - L_v(q_{k+1}, v, t_{k+1}, y_{k+1}) = 0, p_{k+1} as interval k sees it. Local unknowns: as in
/// `IntervalFunctions`, then v. Local constraints: n.
[[nodiscard]] LocalFunctions trace_velocity_tie(const TracedProblem& traced, const Element& element,
                                                const Tableau& tableau, const IntervalRules& rules);

/// Traces the formulas of one interval of an element and differentiates them.
[[nodiscard]] IntervalFunctions trace_interval(const TracedProblem& traced, const Element& element,
                                               const Tableau& tableau, const IntervalRules& rules);

}  // namespace dmocbench
