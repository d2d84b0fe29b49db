#pragma once

#include <array>

#include <Eigen/Core>

#include "methods/mechanics/state.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

/// By how much the least cost grows per unit of the bound that acts: positive for a lower bound, negative for an upper
/// one, 0 where none acts. Tables without columns belong to quantities without bounds.
///
/// A bound at the stages acts all along: its price is per unit of time, so that moving the bound by e(t) changes the
/// least cost by Σ h b_i price_i e(t_i). A bound at a node acts at that time alone. Values that are given at the ends
/// have no price here; the costates are theirs.
struct BoundMultipliers {
  Eigen::MatrixXd q;         ///< of bounds of q at the nodes, between the ends too, (N + 1) × n
  Eigen::MatrixXd v;         ///< of bounds of q̇ at ends and at times between them, (N + 1) × n
  Eigen::MatrixXd y;         ///< of bounds of first-order states at the nodes, (N + 1) × l
  Eigen::MatrixXd stage_v;   ///< of bounds of q̇ along the motion, N s × n
  Eigen::MatrixXd stage_u;   ///< of bounds of the controls, N s × m, where they are unknowns at the stages; neighbours
                             ///< share the price of a control that they share
  Eigen::MatrixXd path;      ///< of bounds of path constraints, N s × as many
  Eigen::VectorXd unknowns;  ///< of the ranges of unknown parameters
  double horizon = 0.0;      ///< of the bounds of T
};

/// A discrete motion in the same form for every method; diagnostics, tables and figures are made from it.
///
/// Units are the problem's as solved. Row k of a node table is node k = 0 .. N; row k s + i of a stage table is
/// stage i of interval k.
struct Trajectory {
  Tableau tableau;  ///< of the method

  Eigen::VectorXd node_times;  ///< t_0 to t_N
  Eigen::MatrixXd q;           ///< (N + 1) × n
  Eigen::MatrixXd p;           ///< (N + 1) × n, by the forced discrete Legendre transform (eq:varmech_dlegf) for DMOC
  Eigen::MatrixXd v;           ///< (N + 1) × n, with p = L_v(q, v)

  Eigen::VectorXd stage_times;  ///< t_k + c_i h_k, N s entries
  Eigen::MatrixXd stage_q;      ///< Q_i, N s × n
  Eigen::MatrixXd stage_v;      ///< Q̇_i (V_i for tangent-space collocation, equal to it), N s × n
  Eigen::MatrixXd stage_u;      ///< U_i, N s × m
  Eigen::MatrixXd stage_p;      ///< P_i = L_v(Q_i, Q̇_i), N s × n

  Eigen::MatrixXd y;              ///< first-order states at the nodes, (N + 1) × l
  Eigen::MatrixXd stage_y;        ///< Y_i, N s × l
  Eigen::MatrixXd stage_y_rates;  ///< Ẏ_i, N s × l
  Eigen::MatrixXd psi_y;          ///< derivative of the optimal cost-to-go at fixed (q, p), (N + 1) × l; or empty

  /// Gradient of the optimal cost-to-go in (q, p) at the nodes, (N + 1) × n each; empty (0 × 0) without multipliers.
  Eigen::MatrixXd psi_q;
  Eigen::MatrixXd psi_p;  ///< see `psi_q`
  /// The same at the stages (`stage_costates`), N s × n each; empty without multipliers, where bounds on velocities,
  /// path constraints and constraints of the motion have multipliers of their own there, and of shooting, whose stages
  /// are not unknowns.
  Eigen::MatrixXd stage_psi_q;
  Eigen::MatrixXd stage_psi_p;  ///< see `stage_psi_q`
  Eigen::MatrixXd stage_psi_y;  ///< of first-order states, N s × l; see `stage_psi_q`

  /// The impulses of the forces of constraint at both nodes of interval k that act within it, N × n each; empty without
  /// constraints. With the projected momenta, p_{k+1} = right_impulses + P_{k+1}, p_k = P_k - left_impulses, where P
  /// are the momenta of the motion between both nodes without impulses at them (DMOC and Hamiltonian collocation).
  Eigen::MatrixXd left_impulses;
  Eigen::MatrixXd right_impulses;           ///< see `left_impulses`
  Eigen::MatrixXd stage_constraint_forces;  ///< forces of constraint at the stages, N s × n; without rows where all of
                                            ///< them are impulses

  double cost = 0.0;  ///< the true cost, not the scaled one

  Eigen::VectorXd unknowns;   ///< unknown parameters, in the order of `Problem::unknowns`
  Eigen::VectorXd integrals;  ///< of `Problem::integrands` over [0, T]
  /// By how much the least cost grows per unit of the active bound of each integral, as many; empty without
  /// multipliers.
  Eigen::VectorXd integral_prices;

  BoundMultipliers prices;  ///< of all other bounds; without columns where there are no multipliers

  /// h_k = t_{k+1} - t_k.
  [[nodiscard]] double step(Eigen::Index k) const { return node_times[k + 1] - node_times[k]; }
  /// (q_k, v_k, y_k), without a control.
  [[nodiscard]] MotionPoint node(Eigen::Index k) const {
    return {q.row(k).transpose(), v.row(k).transpose(), {}, row_of(y, k)};
  }
  /// (Q_i, Q̇_i, U_i, Y_i) in a row of the stage tables.
  [[nodiscard]] MotionPoint stage(Eigen::Index row) const {
    return {stage_q.row(row).transpose(), stage_v.row(row).transpose(), stage_u.row(row).transpose(),
            row_of(stage_y, row)};
  }
  /// A row of a table of first-order states; without entries where the problem has none.
  [[nodiscard]] static Eigen::VectorXd row_of(const Eigen::MatrixXd& table, Eigen::Index row) {
    return table.cols() == 0 ? Eigen::VectorXd() : Eigen::VectorXd(table.row(row).transpose());
  }

  /// N.
  [[nodiscard]] Eigen::Index intervals() const noexcept { return node_times.size() - 1; }
  [[nodiscard]] Eigen::Index stages() const noexcept { return tableau.stages(); }  ///< s.
  /// True if there are costates at the nodes.
  [[nodiscard]] bool has_costates() const noexcept { return psi_q.size() > 0; }
  /// True if there are costates at the stages.
  [[nodiscard]] bool has_stage_costates() const noexcept { return stage_psi_q.size() > 0; }
};

/// A table of a trajectory.
struct TrajectoryTable {
  const char* name;                     ///< as in Python
  Eigen::MatrixXd Trajectory::*values;  ///< the table
  char columns;                         ///< one per configuration 'q', per control 'u' or per first-order state 'y'
  bool is_per_time = false;             ///< whether its entries are per unit of time
};

/// All of them.
inline constexpr auto trajectory_tables =
    std::to_array<TrajectoryTable>({{"q", &Trajectory::q, 'q'},
                                    {"v", &Trajectory::v, 'q', true},
                                    {"p", &Trajectory::p, 'q'},
                                    {"y", &Trajectory::y, 'y'},
                                    {"psi_q", &Trajectory::psi_q, 'q'},
                                    {"psi_p", &Trajectory::psi_p, 'q'},
                                    {"psi_y", &Trajectory::psi_y, 'y'},
                                    {"left_impulses", &Trajectory::left_impulses, 'q'},
                                    {"right_impulses", &Trajectory::right_impulses, 'q'},
                                    {"stage_q", &Trajectory::stage_q, 'q'},
                                    {"stage_v", &Trajectory::stage_v, 'q', true},
                                    {"stage_u", &Trajectory::stage_u, 'u'},
                                    {"stage_p", &Trajectory::stage_p, 'q'},
                                    {"stage_y", &Trajectory::stage_y, 'y'},
                                    {"stage_y_rates", &Trajectory::stage_y_rates, 'y', true},
                                    {"stage_psi_q", &Trajectory::stage_psi_q, 'q'},
                                    {"stage_psi_p", &Trajectory::stage_psi_p, 'q'},
                                    {"stage_psi_y", &Trajectory::stage_psi_y, 'y'},
                                    {"stage_constraint_forces", &Trajectory::stage_constraint_forces, 'q', true}});

}  // namespace dmocbench
