#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/program/interval_structure.hpp"
#include "methods/transcription/element.hpp"
#include "methods/transcription/tableau.hpp"

namespace dmocbench {

/// Where the unknowns and rows of all intervals stand in the program's vectors.
///
/// Vectors are stored column by column: all q_1 of all nodes, all q_2, ..., then p or v, interior slopes, controls.
/// Every local quantity of an element is therefore contiguous over the intervals: that of interval k stands at `first`
/// + k. For a quantity of the left node `first` is the head of its column, for the same quantity of the right node one
/// more.
class Layout {
 public:
  Layout(std::size_t intervals, Eigen::Index configuration_size, Eigen::Index control_size, NodeState node_state,
         Eigen::Index stages, bool shares_controls, Eigen::Index node_rows, Eigen::Index private_rows);

  [[nodiscard]] std::size_t intervals() const noexcept { return intervals_; }
  [[nodiscard]] std::size_t variable_count() const noexcept { return structure_.unknowns.size(); }
  [[nodiscard]] std::size_t row_count() const noexcept { return structure_.rows.size(); }

  /// `first` of every local unknown in the order left q, left y, right q, right y, slopes of q (one after the other),
  /// slopes of y, controls (stage by stage).
  [[nodiscard]] const std::vector<std::size_t>& unknown_firsts() const noexcept { return unknown_firsts_; }
  /// `first` of every local row in the order left rows, right rows, private rows.
  [[nodiscard]] const std::vector<std::size_t>& row_firsts() const noexcept { return row_firsts_; }

  // Heads of columns. A node column has N + 1 entries, an interval column N.
  [[nodiscard]] std::size_t configuration_column(Eigen::Index i) const noexcept;
  [[nodiscard]] std::size_t second_column(Eigen::Index i) const noexcept;  ///< of p_i or v_i
  [[nodiscard]] std::size_t slope_q_column(Eigen::Index stage, Eigen::Index i) const noexcept;
  [[nodiscard]] std::size_t slope_y_column(Eigen::Index stage, Eigen::Index i) const noexcept;
  [[nodiscard]] std::size_t control_column(Eigen::Index stage, Eigen::Index i) const noexcept;
  [[nodiscard]] std::size_t node_row_column(Eigen::Index i) const noexcept;

  [[nodiscard]] NodeState node_state() const noexcept { return node_state_; }
  [[nodiscard]] Eigen::Index interior_stages() const noexcept { return stages_ - 1; }
  [[nodiscard]] Eigen::Index stages() const noexcept { return stages_; }
  [[nodiscard]] const IntervalStructure& structure() const noexcept { return structure_; }

 private:
  void append_column(std::vector<Place>& places, Place::Kind kind) const;

  std::size_t intervals_;
  Eigen::Index n_;
  Eigen::Index m_;
  NodeState node_state_;
  Eigen::Index stages_;
  bool shares_controls_;
  IntervalStructure structure_;
  std::vector<std::size_t> unknown_firsts_;
  std::vector<std::size_t> row_firsts_;
};

}  // namespace dmocbench
