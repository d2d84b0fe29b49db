#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "methods/mechanics/problem_bounds.hpp"
#include "methods/mechanics/traced_problem.hpp"
#include "methods/program/interval_structure.hpp"
#include "methods/transcription/derivatives/series_assembly.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/end_functions.hpp"
#include "methods/transcription/interval_functions.hpp"
#include "methods/transcription/motions/grid.hpp"

namespace dmocbench {

/// The kinds of unknowns.
enum class Quantity : std::uint8_t {
  configuration,     ///< q
  second,            ///< p or v, the second part of a node's state (`NodeState`)
  first_order,       ///< y
  rate,              ///< Q̇ of an interior stage
  second_rate,       ///< Ṗ or V̇
  first_order_rate,  ///< Ẏ
  control,           ///< U of a stage
  multiplier,        ///< λ of constraints; one vector per condition of an interval, or of node N
  cost,              ///< z, the cost so far (Mayer form)
  integral,          ///< each integral so far
  velocity,          ///< v of a node whose state does not contain it
  parameter,         ///< unknown parameters
  horizon,           ///< T
};

/// The kinds of rows.
enum class Equation : std::uint8_t {
  euler_lagrange,      ///< at a node, or a stage
  momentum,            ///< p = L_v at a stage, or at a node that has both p and v
  velocity,            ///< Q̇ = V at a stage
  motion,              ///< q of the next node, by simulation
  second_motion,       ///< p or v of the next node, by simulation
  of_method,           ///< of an element of another family
  constraint,          ///< g(q) = 0 or its rate, or A(q) q̇ = 0
  first_order,         ///< Ẏ = g at a stage
  bounded_velocity,    ///< q̇_i at a stage
  path,                ///< h at a stage
  cost,                ///< z_{k+1} - z_k less the interval's cost
  integral,            ///< the same of integrals
  boundary_condition,  ///< r
};

/// Which nodes or intervals have a block.
enum class Support : std::uint8_t {
  nodes,      ///< all nodes
  intervals,  ///< all intervals
  one_node,   ///< one node alone
  border      ///< the whole horizon
};

/// What the components of a block are named after.
enum class ComponentNames : std::uint8_t {
  configuration,       ///< `Problem::configuration_names`
  first_order,         ///< `Problem::first_order_names`
  control,             ///< `Problem::control_names`
  parameter,           ///< unknown ones of `Problem::parameters`
  path_constraint,     ///< `ProblemCard::path_constraint_names`
  boundary_condition,  ///< `ProblemCard::boundary_condition_names`
  number               ///< nothing: they have numbers alone
};

/// The words for a block.
struct BlockWords {
  ComponentNames names = ComponentNames::number;  ///< of the components
  /// As a message says it; {} is a component.
  std::string_view sentence;
  /// As files of other programs name it: {0} is the name of a component, {1} its number from 1 among all blocks with
  /// the same symbol, {2} the stage from 1, {3} the node.
  std::string_view symbol;
};

/// The stage of a block that has none.
constexpr Eigen::Index no_stage = -1;

/// Unknowns (`Kind` is `Quantity`) or rows (`Equation`) of one kind: `width` components, each one series over all nodes
/// or all intervals, or one number. Series are stored one after the other.
template <class Kind>
struct Block {
  Kind kind = {};                     ///< of its members
  Support support = Support::border;  ///< how long its series are
  Eigen::Index width = 0;             ///< how many components it has; 0 where the program has no such block
  BlockWords words = {};              ///< what they are called
  Eigen::Index stage = no_stage;      ///< of the interval, where it belongs to one
  Eigen::Index component = 0;         ///< number of the first component
  std::size_t node = 0;               ///< of `Support::one_node`
  std::size_t head = 0;               ///< number of the first member
  std::size_t length = 1;             ///< of a series

  /// The number of component i at the first node or in the first interval.
  [[nodiscard]] std::size_t at(Eigen::Index i = 0) const noexcept {
    return head + static_cast<std::size_t>(i) * length;
  }
  /// The same as Eigen counts.
  [[nodiscard]] Eigen::Index index(Eigen::Index i = 0) const noexcept { return static_cast<Eigen::Index>(at(i)); }
  /// Its series of this length in a vector of the program, a column per component.
  [[nodiscard]] Eigen::MatrixXd columns(const Eigen::VectorXd& from, Eigen::Index entries) const {
    return from.segment(index(), entries * width).reshaped(entries, width);
  }
  /// The same block with its series begun `nodes` nodes later.
  [[nodiscard]] Block later(std::size_t nodes) const noexcept {
    Block block = *this;
    block.head += nodes;
    return block;
  }
};

using UnknownBlock = Block<Quantity>;  ///< a block of unknowns
using RowBlock = Block<Equation>;      ///< a block of rows

/// All unknowns and rows of a program, declared once: a table of blocks in the order of the program's vectors.
///
/// Whatever numbers, starts, bounds, names, describes or reads unknowns or rows loops over this table or looks a block
/// up in it, so that a further kind is an entry of `Quantity` or `Equation`, a line that declares its block, and its
/// formulas. Places of an interval and of the ends are the same blocks in the order of `IntervalFunctions` and
/// `EndFunctions`. Every local quantity of an element is contiguous over the intervals: interval k's is at the head of
/// its series + k, the same quantity of the right node one further.
class ProgramBlocks {
 public:
  /// Declares all blocks of a program with functions and ends that are traced, on a grid with nodes at the times of
  /// `ProblemBounds::interior`.
  ProgramBlocks(const Grid& grid, const TracedProblem& traced, const Tableau& tableau, const EndRules& ends,
                const IntervalFunctions& functions, const ProblemBounds& bounds);

  /// All unknowns, in the order of the program's vectors.
  [[nodiscard]] const std::vector<UnknownBlock>& unknowns() const noexcept { return unknowns_; }
  /// All rows, likewise.
  [[nodiscard]] const std::vector<RowBlock>& rows() const noexcept { return rows_; }

  /// Unknowns as interval 0 has them, in the order of `IntervalFunctions`: blocks of nodes twice, and a control that
  /// neighbours share at its first and at its last stage.
  [[nodiscard]] const std::vector<UnknownBlock>& interval_unknowns() const noexcept { return interval_unknowns_; }

  // A block without components stands for one that the program does not have.
  /// The unknowns that interval 0 has at a stage, or at its left node.
  [[nodiscard]] const UnknownBlock& unknown(Quantity kind, Eigen::Index stage = no_stage) const;
  /// Those of one node alone.
  [[nodiscard]] const UnknownBlock& unknown_at(Quantity kind, std::size_t node) const;
  /// The rows of all intervals at a stage, or of all nodes or the whole horizon.
  [[nodiscard]] const RowBlock& row(Equation kind, Eigen::Index stage = no_stage) const;
  /// The rows of one node alone, the first block where there are several.
  [[nodiscard]] const RowBlock& row_at(Equation kind, std::size_t node) const;
  /// The block that has an unknown.
  [[nodiscard]] const UnknownBlock& block_of_unknown(std::size_t number) const;
  /// The block that has a row.
  [[nodiscard]] const RowBlock& block_of_row(std::size_t number) const;

  /// N.
  [[nodiscard]] std::size_t intervals() const noexcept { return structure_.intervals; }
  /// How many unknowns there are.
  [[nodiscard]] std::size_t variable_count() const noexcept { return structure_.unknowns.size(); }
  /// How many rows there are.
  [[nodiscard]] std::size_t constraint_count() const noexcept { return structure_.rows.size(); }
  /// How many unknowns a further interval adds.
  [[nodiscard]] Eigen::Index unknowns_per_interval() const;
  /// How many rows it adds.
  [[nodiscard]] Eigen::Index rows_per_interval() const;

  /// Place of every local unknown of an interval, in the order of `IntervalFunctions`.
  [[nodiscard]] const std::vector<SeriesPlace>& unknown_places() const noexcept { return unknown_places_; }
  /// Place of every local row of an interval.
  [[nodiscard]] const std::vector<SeriesPlace>& row_places() const noexcept { return row_places_; }
  /// Place of every unknown of the ends, in the order of `EndFunctions`.
  [[nodiscard]] const std::vector<SeriesPlace>& end_unknown_places() const noexcept { return end_unknown_places_; }
  /// Place of every row of the ends.
  [[nodiscard]] const std::vector<SeriesPlace>& end_row_places() const noexcept { return end_row_places_; }
  /// To which node, interval or border every unknown and row belongs.
  [[nodiscard]] const IntervalStructure& structure() const noexcept { return structure_; }

 private:
  void place_interval(Eigen::Index control_stages);
  void place_ends();

  IntervalStructure structure_;
  std::vector<UnknownBlock> unknowns_;
  std::vector<RowBlock> rows_;
  std::vector<UnknownBlock> interval_unknowns_;
  std::vector<SeriesPlace> unknown_places_;
  std::vector<SeriesPlace> row_places_;
  std::vector<SeriesPlace> end_unknown_places_;
  std::vector<SeriesPlace> end_row_places_;
};

}  // namespace dmocbench
