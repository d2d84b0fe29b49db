#include "methods/solvers/interior_point/intervals/momentum_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace dmocbench::interior_point {

namespace {

/// Thrown inside, returned as a sentence.
struct NoPairs {
  std::string why;
};

class PairFinder {
 public:
  PairFinder(const NonlinearProgram& program, const IntervalEntries& entries)
      : program_(program), entries_(entries), half_(entries.shape.node / 2) {}

  std::vector<MomentumPair> find() {
    const Shape& shape = entries_.shape;
    if (shape.carried > 0) throw NoPairs{"its equalities are those of nodes already"};
    if (shape.node == 0 || shape.node % 2 != 0) throw NoPairs{"a node has not as many momenta as configurations"};
    if (shape.shared > 0) throw NoPairs{"an unknown belongs to the whole horizon"};
    if (entries_.intervals < 2) throw NoPairs{"it has one interval only"};
    require_linear_momenta();
    std::vector<MomentumPair> pairs;
    for (int momentum = half_; momentum < shape.node; ++momentum) pairs.push_back(pair_of(momentum));
    return pairs;
  }

 private:
  using Block = LocalEntry::Block;

  /// Natural columns of an interval's unknowns, see LocalEntry.
  [[nodiscard]] int this_node(int unknown) const { return next_size(entries_.shape) + unknown; }
  [[nodiscard]] bool is_momentum(int column) const {
    const int Z = next_size(entries_.shape);
    const int node = entries_.shape.node;
    return (column >= half_ && column < node) || (column >= Z + half_ && column < Z + node);
  }

  void require_linear_momenta() const {
    for (const LocalEntry& entry : entries_.local) {
      const bool is_own = entry.source == Source::diagonal || entry.source == Source::slope;
      const bool reads = is_momentum(entry.column) || (entry.block == Block::hessian && is_momentum(entry.row));
      if (!reads || is_own) continue;
      if (entry.block == Block::hessian) throw NoPairs{"its momenta do not enter linearly"};
      if (entry.block == Block::inequality) throw NoPairs{"an inequality reads a momentum"};
    }
    for (int momentum = half_; momentum < entries_.shape.node; ++momentum) {
      const std::size_t first = entries_.node_unknowns[static_cast<std::size_t>(momentum)];
      for (std::size_t k = 1; k < entries_.intervals; ++k) {
        const auto i = static_cast<Eigen::Index>(first + k);
        if (std::isfinite(program_.variable_lower()[i]) || std::isfinite(program_.variable_upper()[i])) {
          throw NoPairs{"a momentum between the ends has a bound"};
        }
      }
    }
  }

  MomentumPair pair_of(int momentum) {
    std::set<int> rows;
    for (const LocalEntry& entry : entries_.local) {
      const bool reads = entry.column == momentum || entry.column == this_node(momentum);
      if (entry.block == Block::equality && reads) rows.insert(entry.row);
    }
    if (rows.size() != 2) {
      throw NoPairs{"a momentum is in " + std::to_string(rows.size()) + " rows of an interval, not in two"};
    }
    MomentumPair pair;
    pair.momentum = entries_.node_unknowns[static_cast<std::size_t>(momentum)];
    std::map<int, MomentumPair::Column> columns;
    for (const std::size_t which : {std::size_t{0}, std::size_t{1}}) {
      const int row = which == 0 ? *rows.begin() : *rows.rbegin();
      if (!taken_.insert(row).second) throw NoPairs{"two momenta are in one row of an interval"};
      pair.rows[which] = entries_.interval_rows[static_cast<std::size_t>(row)];
      pair.at_left[which] = pair.at_right[which] = MomentumPair::none;
      for (const LocalEntry& entry : entries_.local) {
        if (entry.block == Block::equality && entry.row == row) sort(entry, which, momentum, pair, columns);
      }
      if (pair.at_left[which] == MomentumPair::none || pair.at_right[which] == MomentumPair::none) {
        throw NoPairs{"a row of an interval reads a momentum at one end only"};
      }
    }
    for (const auto& [unused, column] : columns) pair.columns.push_back(column);
    return pair;
  }

  void sort(const LocalEntry& entry, std::size_t which, int momentum, MomentumPair& pair,
            std::map<int, MomentumPair::Column>& columns) const {
    if (entry.source == Source::rows) return;
    if (entry.source != Source::jacobian) throw NoPairs{"its equalities differ from interval to interval"};
    if (entry.column == momentum) {
      pair.at_right[which] = entry.first;
    } else if (entry.column == this_node(momentum)) {
      pair.at_left[which] = entry.first;
    } else {
      MomentumPair::Column& column = columns[entry.column];
      column.unknown = unknown_of(entry.column);
      column.entries[which] = entry.first;
    }
  }

  /// The number of the unknown in column `column` of interval 0.
  [[nodiscard]] std::size_t unknown_of(int column) const {
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    const Shape& shape = entries_.shape;
    if (column < shape.node) return entries_.node_unknowns[at(column)] + 1;
    if (column < next_size(shape)) return entries_.inner_unknowns[at(column - shape.node)];
    return entries_.node_unknowns[at(column - next_size(shape))];
  }

  const NonlinearProgram& program_;
  const IntervalEntries& entries_;
  int half_;
  std::set<int> taken_;
};

}  // namespace

std::optional<std::vector<MomentumPair>> momentum_pairs(const NonlinearProgram& program, const IntervalEntries& entries,
                                                        std::string& why) {
  try {
    return PairFinder(program, entries).find();
  } catch (const NoPairs& no_pairs) {
    why = no_pairs.why;
    return std::nullopt;
  }
}

}  // namespace dmocbench::interior_point
