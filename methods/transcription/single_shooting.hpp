#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "methods/expression/tape.hpp"
#include "methods/program/nonlinear_program.hpp"
#include "methods/program/solution.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// Direct single shooting (section 3.3 of the paper): the program of multiple shooting without its nodes.
///
/// The remaining unknowns w are the controls, the state of node 0 (fixed or free) and a free horizon. The
/// states follow by forward simulation, x_{k+1} = Φ(x_k, U_k). Constraints: bounds of the nodes 1 .. N where there are
/// any, a prescribed final state among them, then path constraints and boundary conditions. With S = ∂x/∂w,
///   gradient       φ_w + (∂a/∂w)ᵀμ with (∂a/∂x)ᵀμ = -φ_x, a the equations of the intervals: the adjoint sweep,
///   Hessian        ZᵀHZ, Z = (I; S), H the Hessian of multiple shooting with these μ,
/// exact both, from the tapes of multiple shooting. S, the Jacobian and the Hessian are dense.
///
/// Where the simulation leaves the domain of a formula all values are NaN, by which solvers reject a trial point.
class SingleShooting final : public NonlinearProgram {
 public:
  /// `program` is one of shooting and must outlive this object. Throws `Error` if it has stage unknowns, is in Mayer
  /// form, or would need larger dense matrices than `most_entries`.
  explicit SingleShooting(Transcription& program);

  /// Entries of S; eight bytes each.
  static constexpr Eigen::Index most_entries = 100'000'000;

  [[nodiscard]] std::size_t variable_count() const override { return kept_.size(); }
  [[nodiscard]] std::size_t constraint_count() const override { return bounded_.size() + rows_.size(); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return variable_lower_; }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return variable_upper_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return constraint_lower_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return constraint_upper_; }
  [[nodiscard]] const BlockPattern& jacobian_structure() const override { return jacobian_structure_; }
  [[nodiscard]] const BlockPattern& hessian_structure() const override { return hessian_structure_; }
  [[nodiscard]] double objective(const VectorIn& x) override;
  void gradient(const VectorIn& x, VectorOut result) override;
  void constraints(const VectorIn& x, VectorOut result) override;
  void jacobian(const VectorIn& x, VectorOut values) override;
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override;

  /// The unknowns of a point of multiple shooting that are kept.
  [[nodiscard]] Eigen::VectorXd reduced(const Eigen::VectorXd& primal) const;
  /// A solution in the unknowns and constraints of multiple shooting: the states by simulation, the multipliers of the
  /// intervals by the adjoint sweep. Where the simulation stops, the states after it are NaN, and there are no
  /// multipliers.
  [[nodiscard]] Solution expanded(Solution solution);

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  void sort_unknowns();
  void sort_rows();
  void set_structures();
  /// Simulates from the unknowns, unless the last simulation was theirs, and sets `is_defined_` to whether it came to
  /// the end.
  void simulate(const VectorIn& x);
  /// The derivatives of the equations at the simulated motion, and S; nothing where there is none.
  void linearise(const VectorIn& x);
  /// Whether the simulation did not come to its end; the values are then set to NaN.
  [[nodiscard]] bool is_undefined(VectorOut values) const;
  /// The multipliers of all rows of multiple shooting for which the Lagrangian is stationary in the states.
  [[nodiscard]] Eigen::VectorXd adjoint(double objective_factor, const VectorIn& multipliers);
  /// One row per simulated state, in the order of `simulated_`.
  [[nodiscard]] Eigen::VectorXd of_states(const Eigen::VectorXd& all) const { return all(simulated_); }

  Transcription& program_;
  std::vector<Eigen::Index> kept_;       // unknowns of multiple shooting that are unknowns here
  std::vector<Eigen::Index> simulated_;  // the others: node by node, q then v
  std::vector<Eigen::Index> equations_;  // rows of multiple shooting that the simulation meets, in the same order
  std::vector<Eigen::Index> rows_;       // its other rows
  std::vector<Eigen::Index> bounded_;    // entries of `simulated_` with bounds
  Eigen::VectorXd variable_lower_;
  Eigen::VectorXd variable_upper_;
  Eigen::VectorXd constraint_lower_;
  Eigen::VectorXd constraint_upper_;
  BlockPattern jacobian_structure_;
  BlockPattern hessian_structure_;

  Tape interval_;  // the rows of one interval
  Tape::Workspace workspace_;
  Eigen::MatrixXd outputs_;         // of every interval, a row each
  Eigen::VectorXd simulated_from_;  // w of the last simulation
  bool is_defined_ = false;         // whether it came to the end
  Eigen::VectorXd linearised_at_;   // w of the last linearisation
  Eigen::VectorXd primal_;          // of multiple shooting, at the simulated motion
  Eigen::VectorXd gradient_;        // of multiple shooting
  Matrix states_;                   // ∂a/∂x, rows and columns in the order of the simulation: lower triangular
  Matrix controls_;                 // ∂a/∂w
  Matrix rows_by_states_;
  Matrix rows_by_controls_;
  Eigen::MatrixXd sensitivities_;  // S
};

}  // namespace dmocbench
