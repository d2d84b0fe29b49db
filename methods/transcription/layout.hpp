#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/program/interval_structure.hpp"
#include "methods/transcription/column_assembly.hpp"
#include "methods/transcription/element.hpp"
#include "methods/transcription/tableau.hpp"

namespace dmocbench {

/// What a layout is made for.
struct LayoutShape {
  std::size_t intervals = 0;
  Eigen::Index configuration_size = 0;
  Eigen::Index control_size = 0;
  NodeState node_state = NodeState::configuration;
  Eigen::Index stages = 1;
  bool shares_controls = false;
  Eigen::Index node_rows = 0;        ///< per node
  Eigen::Index stage_equations = 0;  ///< per interval: the element's own
  Eigen::Index path_rows = 0;        ///< per interval
  bool mayer = false;                ///< nodes carry the cost so far, z_k, and intervals have a row for it
  bool first_has_velocity = false;   ///< v_0, or v_N, is an unknown beside the nodes'
  bool last_has_velocity = false;
  bool free_horizon = false;    ///< T is an unknown
  Eigen::Index conditions = 0;  ///< boundary conditions

  /// Rows per interval: the element's own, path rows, that of the Mayer form.
  [[nodiscard]] Eigen::Index interval_rows() const noexcept { return stage_equations + path_rows + (mayer ? 1 : 0); }
};

/// Where the unknowns and rows of all intervals stand in the program's vectors.
///
/// Vectors are stored column by column: all q_1 of all nodes, all q_2, ..., then p or v, interior slopes, controls, z;
/// at last v_0, v_N and T where they are unknowns. Every local quantity of an element is therefore contiguous over the
/// intervals: that of interval k stands at `first` + k. For a quantity of the left node `first` is the head of its
/// column, for the same quantity of the right node one more. Rows: those of the nodes, those of the intervals, then p =
/// L_v(q, v) of the ends (Hamiltonian only) and the boundary conditions.
class Layout {
 public:
  explicit Layout(const LayoutShape& shape);

  [[nodiscard]] std::size_t intervals() const noexcept { return shape_.intervals; }
  [[nodiscard]] std::size_t variable_count() const noexcept { return structure_.unknowns.size(); }
  [[nodiscard]] std::size_t row_count() const noexcept { return structure_.rows.size(); }

  /// Place of every local unknown of an interval, in the order of `IntervalFunctions`.
  [[nodiscard]] const std::vector<ColumnPlace>& unknown_places() const noexcept { return unknown_places_; }
  /// Place of every local row of an interval.
  [[nodiscard]] const std::vector<ColumnPlace>& row_places() const noexcept { return row_places_; }
  /// Place of every unknown and row of the ends, in the order of `EndFunctions`.
  [[nodiscard]] const std::vector<ColumnPlace>& end_unknown_places() const noexcept { return end_unknown_places_; }
  [[nodiscard]] const std::vector<ColumnPlace>& end_row_places() const noexcept { return end_row_places_; }

  // Heads of columns. A node column has N + 1 entries, an interval column N.
  [[nodiscard]] std::size_t configuration_column(Eigen::Index i) const noexcept;
  [[nodiscard]] std::size_t second_column(Eigen::Index i) const noexcept;  ///< of p_i or v_i
  [[nodiscard]] std::size_t rate_column(Eigen::Index stage, Eigen::Index i) const noexcept;
  [[nodiscard]] std::size_t second_rate_column(Eigen::Index stage, Eigen::Index i) const noexcept;
  [[nodiscard]] std::size_t control_column(Eigen::Index stage, Eigen::Index i) const noexcept;
  [[nodiscard]] std::size_t cost_column() const noexcept { return cost_column_; }  ///< of z, in Mayer form
  [[nodiscard]] std::size_t node_row_column(Eigen::Index i) const noexcept;
  [[nodiscard]] std::size_t interval_row_column(Eigen::Index i) const noexcept;

  // Single unknowns, where they are there.
  [[nodiscard]] std::size_t first_velocity(Eigen::Index i) const noexcept;
  [[nodiscard]] std::size_t last_velocity(Eigen::Index i) const noexcept;
  [[nodiscard]] std::size_t horizon() const noexcept { return variable_count() - 1; }

  [[nodiscard]] const LayoutShape& shape() const noexcept { return shape_; }
  [[nodiscard]] NodeState node_state() const noexcept { return shape_.node_state; }
  [[nodiscard]] Eigen::Index interior_stages() const noexcept { return shape_.stages - 1; }
  [[nodiscard]] Eigen::Index stages() const noexcept { return shape_.stages; }
  [[nodiscard]] const IntervalStructure& structure() const noexcept { return structure_; }

 private:
  [[nodiscard]] Eigen::Index node_columns() const noexcept;
  /// One of each configuration at one node.
  void append_singles(Places& places, std::size_t node) const;
  void append_unknowns();
  void append_rows();
  void place_interval();
  void place_ends();

  LayoutShape shape_;
  std::size_t cost_column_ = 0;
  std::size_t single_unknowns_ = 0;  // where v_0, v_N, T begin
  std::size_t single_rows_ = 0;      // where the rows of the ends begin
  IntervalStructure structure_;
  std::vector<ColumnPlace> unknown_places_;
  std::vector<ColumnPlace> row_places_;
  std::vector<ColumnPlace> end_unknown_places_;
  std::vector<ColumnPlace> end_row_places_;
};

}  // namespace dmocbench
