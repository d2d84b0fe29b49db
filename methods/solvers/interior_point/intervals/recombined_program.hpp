#pragma once

#include <cstddef>
#include <vector>

#include "methods/program/nonlinear_program.hpp"
#include "methods/solvers/interior_point/intervals/momentum_pairs.hpp"

namespace dmocbench::interior_point {

/// What entries of the recombined Jacobian are made of: entry `first` + k is, or is increased by, what column `column`
/// of pair `pair` is in the combination of its rows for the left or for the right node of interval k.
struct RecombinedTerm {
  std::size_t pair;
  std::size_t column;
  bool of_right_node;
  bool adds;  ///< on the diagonal, where the row of a node reads it from both sides, the second one
  std::size_t first;
};

/// The structure of a program whose pairs of rows (momentum_pairs.hpp) are combined such that one has p_k alone, with
/// coefficient 1, and the other p_{k+1}, and are added where they meet: the unknown p_k between the ends drops out, and
/// what is left has DMOC's unknowns and its rows, one per node and configuration,
///
///   node k: (row with p_k of interval k) - (row with p_k of interval k - 1).
///
/// p_0 and p_N stay, as further unknowns of the ends. It has sizes, bounds and patterns, and cannot be evaluated: the
/// values come from `RecombinedKkt`. The Hessian's entries are those of the program, in its order.
class RecombinedProgram final : public NonlinearProgram {
 public:
  RecombinedProgram(const NonlinearProgram& program, const std::vector<MomentumPair>& pairs);

  [[nodiscard]] std::size_t variable_count() const override { return unknowns_.size(); }
  [[nodiscard]] std::size_t constraint_count() const override { return structure_.rows.size(); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return variable_lower_; }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return variable_upper_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return row_lower_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return row_upper_; }
  [[nodiscard]] const SparsityPattern& jacobian_structure() const override { return jacobian_; }
  [[nodiscard]] const SparsityPattern& hessian_structure() const override { return hessian_; }
  [[nodiscard]] const IntervalStructure* interval_structure() const override { return &structure_; }

  // Throw `Error`.
  [[nodiscard]] double objective(const VectorIn& x) override;
  void gradient(const VectorIn& x, VectorOut result) override;
  void constraints(const VectorIn& x, VectorOut result) override;
  void jacobian(const VectorIn& x, VectorOut values) override;
  void hessian(const VectorIn& x, double objective_factor, const VectorIn& multipliers, VectorOut values) override;

  /// The program's numbers of our unknowns.
  [[nodiscard]] const std::vector<Eigen::Index>& unknowns() const noexcept { return unknowns_; }
  /// The program's numbers of our rows from first_kept_row() on; those before are the combined ones, node by node for
  /// each pair.
  [[nodiscard]] const std::vector<Eigen::Index>& kept_rows() const noexcept { return kept_rows_; }
  [[nodiscard]] Eigen::Index first_kept_row() const noexcept { return first_kept_row_; }
  /// The program's numbers of our Jacobian's entries from first_kept_entry() on; those before are made of `terms()`,
  /// which come first, and of the ends' momenta.
  [[nodiscard]] const std::vector<Eigen::Index>& kept_entries() const noexcept { return kept_entries_; }
  [[nodiscard]] Eigen::Index first_kept_entry() const noexcept { return first_kept_entry_; }
  [[nodiscard]] const std::vector<RecombinedTerm>& terms() const noexcept { return terms_; }
  /// Entries of the Jacobian that are constant: derivatives with respect to p_0 and p_N.
  struct Constant {
    Eigen::Index entry;
    double value;
  };
  [[nodiscard]] const std::vector<Constant>& constants() const noexcept { return constants_; }

 private:
  void number_unknowns(const NonlinearProgram& program, const std::vector<MomentumPair>& pairs);
  void number_rows(const NonlinearProgram& program, const std::vector<MomentumPair>& pairs);
  void append_pair(std::size_t number, const MomentumPair& pair);
  void append_entry(std::size_t row, std::size_t unknown);
  void append_column(std::size_t row, std::size_t unknown, std::size_t length);
  void append_ends(std::size_t number, const MomentumPair& pair);
  void append_kept_entries(const SparsityPattern& jacobian);
  [[nodiscard]] bool is_node(std::size_t unknown) const;

  const IntervalStructure& original_;
  IntervalStructure structure_;
  std::vector<Eigen::Index> unknowns_;
  std::vector<int> number_of_unknown_;  // ours, by the program's; -1 for what drops out
  std::vector<int> number_of_row_;
  std::vector<Eigen::Index> kept_rows_;
  Eigen::Index first_kept_row_ = 0;
  std::vector<Eigen::Index> kept_entries_;
  Eigen::Index first_kept_entry_ = 0;
  std::vector<RecombinedTerm> terms_;
  std::vector<Constant> constants_;
  Eigen::VectorXd variable_lower_;
  Eigen::VectorXd variable_upper_;
  Eigen::VectorXd row_lower_;
  Eigen::VectorXd row_upper_;
  SparsityPattern jacobian_;
  SparsityPattern hessian_;
};

}  // namespace dmocbench::interior_point
