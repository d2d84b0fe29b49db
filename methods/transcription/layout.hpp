#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "methods/program/interval_structure.hpp"
#include "methods/transcription/derivatives/series_assembly.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/elements/tableau.hpp"

namespace dmocbench {

/// The sizes from which a layout follows.
struct LayoutShape {
  std::size_t intervals = 0;                        ///< N
  Eigen::Index configuration_size = 0;              ///< n
  Eigen::Index control_size = 0;                    ///< m
  NodeState node_state = NodeState::configuration;  ///< the second part of the nodes' states
  Eigen::Index stages = 1;                          ///< s
  Eigen::Index rate_stages = 1;                     ///< of `Element::rates`
  Eigen::Index control_stages = 1;                  ///< of `Element::controls`
  bool shares_controls = false;                     ///< neighbouring intervals share the control at their node
  bool has_stage_unknowns = true;                   ///< `Element::has_stage_unknowns`
  Eigen::Index node_rows = 0;                       ///< per node
  Eigen::Index stage_equations = 0;                 ///< per interval: the element's own
  Eigen::Index path_rows = 0;                       ///< per interval
  bool mayer = false;               ///< nodes carry the cost so far, z_k, and intervals have a row for it
  bool first_has_velocity = false;  ///< v_0, or v_N, is an unknown in addition to the nodes'
  bool last_has_velocity = false;   ///< the velocity at T is an unknown of its own
  bool free_horizon = false;        ///< T is an unknown
  Eigen::Index conditions = 0;      ///< boundary conditions
  /// Nodes between the ends whose velocity is an unknown of its own, tied to their momentum.
  std::vector<std::size_t> interior_velocities = {};
  bool has_interior_equations = false;  ///< `IntervalStructure::has_interior_equations`
  Eigen::Index first_order_size = 0;    ///< l: nodes carry y besides
  Eigen::Index integrals = 0;           ///< nodes carry each so far, and intervals have a row for it
  Eigen::Index multipliers = 0;         ///< per interval, of holonomic constraints
  Eigen::Index last_multipliers = 0;    ///< of node N alone
  Eigen::Index first_holonomic = 0;     ///< rows of holonomic constraints at the first end
  Eigen::Index last_holonomic = 0;      ///< rows at the last end that no interval has
  Eigen::Index unknown_parameters = 0;  ///< each is an unknown of the whole horizon

  /// Sums that nodes carry: the cost in Mayer form, then the integrals.
  [[nodiscard]] Eigen::Index sums() const noexcept { return integrals + (mayer ? 1 : 0); }
  /// Rows per interval: the element's own, path rows, rows of the sums.
  [[nodiscard]] Eigen::Index interval_rows() const noexcept { return stage_equations + path_rows + sums(); }
};

/// Where the unknowns and rows of all intervals stand in the program's vectors.
///
/// Vectors are stored column by column: q_1 of all nodes, q_2 of all nodes, ..., then p or v, y, interior rates,
/// controls, multipliers of holonomic constraints, z; at last v_0, v_N, multipliers of node N, velocities between the
/// ends, unknown parameters and T where they are unknowns. Every local quantity of an element is therefore contiguous
/// over the intervals: interval k's is at `first` + k. For a quantity of the left node `first` is the head of its
/// series, for the same quantity of the right node one more. Rows: of the nodes, of the intervals, then p = L_v(q, v)
/// of the ends (Hamiltonian only), holonomic constraints of the ends, p = L_v(q, v) of nodes between them, and the
/// boundary conditions.
class Layout {
 public:
  /// Numbers all unknowns and rows of a program of this shape.
  explicit Layout(const LayoutShape& shape);

  /// N.
  [[nodiscard]] std::size_t intervals() const noexcept { return shape_.intervals; }
  /// How many unknowns there are.
  [[nodiscard]] std::size_t variable_count() const noexcept { return structure_.unknowns.size(); }
  /// How many constraints there are.
  [[nodiscard]] std::size_t constraint_count() const noexcept { return structure_.rows.size(); }

  /// Place of every local unknown of an interval, in the order of `IntervalFunctions`.
  [[nodiscard]] const std::vector<SeriesPlace>& unknown_places() const noexcept { return unknown_places_; }
  /// Place of every local row of an interval.
  [[nodiscard]] const std::vector<SeriesPlace>& row_places() const noexcept { return row_places_; }
  /// Place of every unknown and row of the ends, in the order of `EndFunctions`.
  [[nodiscard]] const std::vector<SeriesPlace>& end_unknown_places() const noexcept { return end_unknown_places_; }
  /// Where the rows of the ends lie.
  [[nodiscard]] const std::vector<SeriesPlace>& end_row_places() const noexcept { return end_row_places_; }

  // Heads of series. The series of a quantity of the nodes has N + 1 entries, of a quantity of the intervals N.
  /// Of q_i of the nodes.
  [[nodiscard]] std::size_t configuration_head(Eigen::Index i) const noexcept {
    return static_cast<std::size_t>(i) * (shape_.intervals + 1);
  }
  [[nodiscard]] std::size_t second_head(Eigen::Index i) const noexcept {  ///< of p_i or v_i
    return configuration_head(shape_.configuration_size + i);
  }
  [[nodiscard]] std::size_t first_order_head(Eigen::Index i) const noexcept {  ///< of y_i
    return configuration_head(node_columns() - shape_.first_order_size + i);
  }
  /// Of component i of Ẏ_stage.
  [[nodiscard]] std::size_t first_order_rate_head(Eigen::Index stage, Eigen::Index i) const noexcept {
    return interval_head(rates_, interior_rates() + stage * shape_.first_order_size + i);
  }
  /// Of component i of the stage rate Q̇_stage.
  [[nodiscard]] std::size_t rate_head(Eigen::Index stage, Eigen::Index i) const noexcept {
    return interval_head(rates_, stage * shape_.configuration_size + i);
  }
  /// Of component i of Ṗ_stage or V̇_stage.
  [[nodiscard]] std::size_t second_rate_head(Eigen::Index stage, Eigen::Index i) const noexcept {
    return rate_head(interior_stages() + stage, i);
  }
  /// Of multiplier i of an interval.
  [[nodiscard]] std::size_t multiplier_head(Eigen::Index i) const noexcept { return interval_head(multipliers_, i); }
  /// Of component i of U_stage, a stage of `Element::controls`.
  [[nodiscard]] std::size_t control_head(Eigen::Index stage, Eigen::Index i) const noexcept;
  [[nodiscard]] std::size_t cost_head() const noexcept { return sum_head(0); }  ///< of z, in Mayer form
  /// Of the i-th sum, the cost first.
  [[nodiscard]] std::size_t sum_head(Eigen::Index i) const noexcept {
    return sums_ + static_cast<std::size_t>(i) * (shape_.intervals + 1);
  }
  /// Of integral i so far.
  [[nodiscard]] std::size_t integral_head(Eigen::Index i) const noexcept {
    return sum_head(shape_.sums() - shape_.integrals + i);
  }
  /// Of the equation of the i-th sum.
  [[nodiscard]] std::size_t sum_row_head(Eigen::Index i) const noexcept {
    return interval_row_head(shape_.interval_rows() - shape_.sums() + i);
  }
  /// Of the i-th equation of the nodes.
  [[nodiscard]] std::size_t node_row_head(Eigen::Index i) const noexcept { return configuration_head(i); }
  /// Of the i-th equation of the intervals.
  [[nodiscard]] std::size_t interval_row_head(Eigen::Index i) const noexcept {
    return interval_head(interval_rows_, i);
  }

  // Single unknowns, in programs that have them.
  /// The number of component i of the velocity at 0, where that is an unknown.
  [[nodiscard]] std::size_t first_velocity(Eigen::Index i) const noexcept {
    return single_unknowns_ + static_cast<std::size_t>(i);
  }
  /// The number of component i of the velocity at T, where that is an unknown.
  [[nodiscard]] std::size_t last_velocity(Eigen::Index i) const noexcept {
    return first_velocity((shape_.first_has_velocity ? shape_.configuration_size : 0) + i);
  }
  /// The number of multiplier i of node N.
  [[nodiscard]] std::size_t last_multiplier(Eigen::Index i) const noexcept {
    return last_velocity((shape_.last_has_velocity ? shape_.configuration_size : 0) + i);
  }
  /// The number of component i of the velocity at the j-th of `LayoutShape::interior_velocities`.
  [[nodiscard]] std::size_t interior_velocity(Eigen::Index j, Eigen::Index i) const noexcept {
    return last_multiplier(shape_.last_multipliers + j * shape_.configuration_size + i);
  }
  /// The number of the equation that ties it to the momentum.
  [[nodiscard]] std::size_t interior_tie(Eigen::Index j, Eigen::Index i) const noexcept {
    return interior_ties_ + static_cast<std::size_t>(j * shape_.configuration_size + i);
  }
  /// The number of the i-th unknown parameter.
  [[nodiscard]] std::size_t unknown_parameter(Eigen::Index i) const noexcept {
    return variable_count() - (shape_.free_horizon ? 1 : 0) - static_cast<std::size_t>(shape_.unknown_parameters - i);
  }
  /// The number of T, where that is an unknown.
  [[nodiscard]] std::size_t horizon() const noexcept { return variable_count() - 1; }

  /// The shape that it was made for.
  [[nodiscard]] const LayoutShape& shape() const noexcept { return shape_; }
  /// The second part of the nodes' states.
  [[nodiscard]] NodeState node_state() const noexcept { return shape_.node_state; }
  /// Stages whose rates of q, and of p or v, are unknowns.
  [[nodiscard]] Eigen::Index interior_stages() const noexcept {
    return shape_.has_stage_unknowns ? shape_.rate_stages - 1 : 0;
  }
  /// Those whose rates of y are unknowns.
  [[nodiscard]] Eigen::Index interior_first_order_stages() const noexcept {
    return shape_.has_stage_unknowns ? shape_.stages - 1 : 0;
  }
  [[nodiscard]] Eigen::Index stages() const noexcept { return shape_.stages; }  ///< s.
  /// To which node, interval or border every unknown and row belongs.
  [[nodiscard]] const IntervalStructure& structure() const noexcept { return structure_; }

 private:
  /// Of q, of p or v, and of y.
  [[nodiscard]] Eigen::Index node_columns() const noexcept {
    return (node_state() == NodeState::configuration ? 1 : 2) * shape_.configuration_size + shape_.first_order_size;
  }
  /// Interior rates of q, and of p or v.
  [[nodiscard]] Eigen::Index interior_rates() const noexcept {
    return interior_stages() * (node_columns() - shape_.first_order_size);
  }
  /// All interior rates.
  [[nodiscard]] Eigen::Index interior_columns() const noexcept {
    return interior_rates() + interior_first_order_stages() * shape_.first_order_size;
  }
  /// The head of series i of the intervals after `first`.
  [[nodiscard]] std::size_t interval_head(std::size_t first, Eigen::Index i) const noexcept {
    return first + static_cast<std::size_t>(i) * shape_.intervals;
  }
  /// `count` runs of one kind. Returns the head of the first.
  std::size_t append(Places& places, Place::Kind kind, Eigen::Index count, bool are_controls = false) const;
  /// `count` at one node.
  static void append_singles(Places& places, std::size_t node, Eigen::Index count);
  void append_unknowns();
  void append_rows();
  void place_interval();
  void place_ends();

  LayoutShape shape_;
  std::size_t rates_ = 0;           // head of the interior rates
  std::size_t controls_ = 0;        // of the controls
  std::size_t inner_controls_ = 0;  // of those that no other interval shares
  std::size_t multipliers_ = 0;
  std::size_t sums_ = 0;
  std::size_t interval_rows_ = 0;
  std::size_t single_unknowns_ = 0;  // where v_0, v_N, the multipliers of node N, unknown parameters, T begin
  std::size_t single_rows_ = 0;      // where the rows of the ends begin
  std::size_t interior_ties_ = 0;    // the rows of velocities between the ends
  IntervalStructure structure_;
  std::vector<SeriesPlace> unknown_places_;
  std::vector<SeriesPlace> row_places_;
  std::vector<SeriesPlace> end_unknown_places_;
  std::vector<SeriesPlace> end_row_places_;
};

}  // namespace dmocbench
