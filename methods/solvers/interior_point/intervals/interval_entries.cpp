#include "methods/solvers/interior_point/intervals/interval_entries.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "methods/error.hpp"

namespace dmocbench::interior_point {

namespace {

/// Thrown inside, returned as a sentence.
struct Irregular {
  std::string why;
};

/// A column of unknowns or rows that all nodes, or all intervals, have.
struct Member {
  Place::Kind kind = Place::Kind::border;
  std::size_t at = 0;    // node or interval
  int column = -1;       // number among the columns of its kind; -1 for a single one
  bool is_soft = false;  // rows only
};

/// Finds the columns of one kind, and who belongs to them.
class Columns {
 public:
  Columns(const std::vector<Place>& places, Place::Kind kind, std::size_t count, std::vector<Member>& members) {
    std::vector<std::vector<std::size_t>> lists(count);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].kind == kind) lists.at(places[i].index).push_back(i);
    }
    std::size_t size = lists.empty() ? 0 : lists.front().size();
    for (const auto& list : lists) size = std::min(size, list.size());
    for (std::size_t column = 0; column < size; ++column) {
      firsts.push_back(lists.front()[column]);
      for (std::size_t k = 0; k < count; ++k) {
        if (lists[k][column] != firsts.back() + k)
          throw Irregular{"its unknowns or rows are not stored column by column"};
        members[lists[k][column]] = {kind, k, static_cast<int>(column), false};
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t i = size; i < lists[k].size(); ++i) {
        members[lists[k][i]] = {kind, k, -1, false};
        singles.push_back(lists[k][i]);
      }
    }
  }

  std::vector<std::size_t> firsts;
  std::vector<std::size_t> singles;
};

class Sorter {
 public:
  explicit Sorter(const NonlinearProgram& program) : program_(program) {
    if (program.interval_structure() == nullptr) throw Irregular{"it tells no interval structure"};
    if (program.interval_structure()->intervals == 0) throw Irregular{"it has no intervals"};
  }

  IntervalEntries sort() {
    result_.intervals = structure().intervals;
    find_unknowns();
    find_rows();
    result_.shape = {.node = count(result_.node_unknowns),
                     .carried = count(result_.node_rows),
                     .shared = count(result_.shared_unknowns),
                     .inner = count(result_.inner_unknowns),
                     .rows = count(result_.node_rows) + count(result_.interval_rows),
                     .soft = count(result_.soft_rows)};
    if (free_size(result_.shape) < 0) throw Irregular{"an interval has more equalities than unknowns"};
    require_free_between_ends();
    sort_hessian();
    sort_jacobian();
    append_columns();
    append_vectors();
    return std::move(result_);
  }

 private:
  using Key = std::tuple<LocalEntry::Block, int, int>;
  struct Run {
    std::size_t first = 0;
    std::size_t begin = 0;
    std::size_t length = 0;
    Source source = Source::hessian;
  };

  [[nodiscard]] const IntervalStructure& structure() const { return *program_.interval_structure(); }
  static int count(const std::vector<std::size_t>& list) { return static_cast<int>(list.size()); }

  void find_unknowns() {
    const auto& places = structure().unknowns;
    unknowns_.resize(places.size());
    Columns nodes(places, Place::Kind::node, result_.intervals + 1, unknowns_);
    Columns inner(places, Place::Kind::interval, result_.intervals, unknowns_);
    if (!inner.singles.empty()) throw Irregular{"its intervals have different numbers of unknowns"};
    result_.node_unknowns = nodes.firsts;
    result_.inner_unknowns = inner.firsts;
    for (const std::size_t i : nodes.singles) {
      const std::size_t node = places[i].index;
      if (node != 0 && node != result_.intervals) throw Irregular{"a node between the ends has unknowns of its own"};
      result_.single_unknowns[node == 0 ? 0 : 1].push_back(i);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].kind != Place::Kind::border) continue;
      unknowns_[i] = {Place::Kind::border, 0, static_cast<int>(result_.shared_unknowns.size()), false};
      result_.shared_unknowns.push_back(i);
    }
  }

  void find_rows() {
    const auto& places = structure().rows;
    rows_.resize(places.size());
    Columns nodes(places, Place::Kind::node, result_.intervals + 1, rows_);
    Columns intervals(places, Place::Kind::interval, result_.intervals, rows_);
    if (!intervals.singles.empty()) throw Irregular{"its intervals have different numbers of rows"};
    result_.node_rows = nodes.firsts;
    for (const std::size_t first : nodes.firsts) {
      for (std::size_t k = 0; k <= result_.intervals; ++k) {
        if (is_soft(first + k)) throw Irregular{"a row of a node is an inequality"};
      }
    }
    for (const std::size_t first : intervals.firsts) {
      const bool soft = is_soft(first);
      auto& list = soft ? result_.soft_rows : result_.interval_rows;
      for (std::size_t k = 0; k < result_.intervals; ++k) {
        if (is_soft(first + k) != soft) throw Irregular{"a row is an equality in some intervals only"};
        rows_[first + k] = {Place::Kind::interval, k, count(list), soft};
      }
      list.push_back(first);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (rows_[i].column < 0) result_.single_rows.push_back(i);
    }
  }

  [[nodiscard]] bool is_soft(std::size_t row) const {
    const auto i = static_cast<Eigen::Index>(row);
    return program_.constraint_lower()[i] != program_.constraint_upper()[i];
  }
  [[nodiscard]] bool is_fixed(std::size_t unknown) const {
    const auto i = static_cast<Eigen::Index>(unknown);
    return program_.variable_lower()[i] == program_.variable_upper()[i];
  }

  void require_free_between_ends() {
    for (const std::size_t first : result_.node_unknowns) {
      for (std::size_t k = 1; k < result_.intervals; ++k) {
        if (is_fixed(first + k)) throw Irregular{"an unknown of a node between the ends is fixed"};
      }
    }
    for (const std::size_t first : result_.inner_unknowns) {
      result_.inner_is_fixed.push_back(is_fixed(first));
      for (std::size_t k = 0; k < result_.intervals; ++k) {
        if (is_fixed(first + k) != is_fixed(first)) throw Irregular{"an unknown is fixed in some intervals only"};
      }
    }
  }

  // Columns in the natural order of an interval's unknowns.
  [[nodiscard]] int next_node(const Member& m) const { return m.column; }
  [[nodiscard]] int inner(const Member& m) const { return result_.shape.node + m.column; }
  [[nodiscard]] int this_node(const Member& m) const { return next_size(result_.shape) + m.column; }
  [[nodiscard]] int shared(const Member& m) const {
    return next_size(result_.shape) + result_.shape.node + result_.shape.carried + m.column;
  }

  [[nodiscard]] static bool in_column(const Member& m, Place::Kind kind) { return m.kind == kind && m.column >= 0; }

  /// Where an unknown is seen from interval k; -1 if it does not belong to it.
  [[nodiscard]] int seen_from(const Member& m, std::size_t interval) const {
    if (m.column < 0) return -1;
    if (m.kind == Place::Kind::border) return shared(m);
    if (m.kind == Place::Kind::interval) return m.at == interval ? inner(m) : -1;
    if (m.at == interval + 1) return next_node(m);
    return m.at == interval ? this_node(m) : -1;
  }

  void put(const Key& key, std::size_t interval, const EndEntry& entry) {
    Run& run = runs_[key];
    if (run.length == 0) run = {entry.entry, interval, 0, entry.source};
    if (entry.entry != run.first + run.length || interval != run.begin + run.length) {
      throw Irregular{"its derivatives are not stored column by column"};
    }
    ++run.length;
  }

  void sort_hessian() {
    const SparsityPattern& pattern = program_.hessian_structure();
    for (std::size_t e = 0; e < pattern.size(); ++e) {
      const auto i = static_cast<std::size_t>(pattern.rows[e]);
      const auto j = static_cast<std::size_t>(pattern.columns[e]);
      const EndEntry entry{Source::hessian, e, i, j};
      if (is_fixed_inner(i) || is_fixed_inner(j)) continue;
      const auto interval = interval_of(unknowns_[i], unknowns_[j]);
      const int a = interval ? seen_from(unknowns_[i], *interval) : -1;
      const int b = interval ? seen_from(unknowns_[j], *interval) : -1;
      const int Z = next_size(result_.shape);
      if (a < 0 || b < 0 || (a >= Z && b >= Z)) {
        result_.ends.push_back(entry);
      } else {
        put({LocalEntry::Block::hessian, std::min(a, b), std::max(a, b)}, *interval, entry);
      }
    }
  }

  /// The interval whose blocks hold the Hessian's entry of two unknowns: that before a node for the node's own ones.
  [[nodiscard]] std::optional<std::size_t> interval_of(const Member& a, const Member& b) const {
    for (const Member* m : {&a, &b}) {
      if (in_column(*m, Place::Kind::interval)) return m->at;
    }
    if (!in_column(a, Place::Kind::node) && !in_column(b, Place::Kind::node)) return std::nullopt;
    std::size_t latest = 0;
    for (const Member* m : {&a, &b}) {
      if (in_column(*m, Place::Kind::node)) latest = std::max(latest, m->at);
    }
    if (latest == 0) return std::nullopt;
    return latest - 1;
  }

  [[nodiscard]] bool is_fixed_inner(std::size_t unknown) const {
    const Member& m = unknowns_[unknown];
    return in_column(m, Place::Kind::interval) && result_.inner_is_fixed[static_cast<std::size_t>(m.column)];
  }

  void sort_jacobian() {
    const SparsityPattern& pattern = program_.jacobian_structure();
    for (std::size_t e = 0; e < pattern.size(); ++e) {
      const auto i = static_cast<std::size_t>(pattern.rows[e]);
      const auto j = static_cast<std::size_t>(pattern.columns[e]);
      if (is_fixed_inner(j)) continue;
      const Member& row = rows_[i];
      const EndEntry entry{Source::jacobian, e, i, j};
      if (row.column < 0 || !put_row_entry(row, unknowns_[j], entry)) result_.ends.push_back(entry);
    }
  }

  bool put_row_entry(const Member& row, const Member& unknown, const EndEntry& entry) {
    if (row.kind == Place::Kind::interval) {
      const int column = seen_from(unknown, row.at);
      if (column < 0) throw Irregular{"a row of an interval reads unknowns of another one"};
      const int number = row.is_soft ? row.column : result_.shape.carried + row.column;
      put({row.is_soft ? LocalEntry::Block::soft : LocalEntry::Block::equality, number, column}, row.at, entry);
      return true;
    }
    const bool from_before = (in_column(unknown, Place::Kind::interval) || in_column(unknown, Place::Kind::node)) &&
                             unknown.at + 1 == row.at;
    if (from_before) {
      const int Z = next_size(result_.shape);
      const int seen = seen_from(unknown, unknown.at);  // of its own interval, or the left node of it
      put({LocalEntry::Block::carry, row.column, seen >= Z ? seen - Z : result_.shape.node + seen}, unknown.at, entry);
      return true;
    }
    if (row.at == result_.intervals) return false;
    const int column = seen_from(unknown, row.at);
    if (column < 0) return false;
    put({LocalEntry::Block::equality, row.column, column}, row.at, entry);
    return true;
  }

  void append_columns() {
    for (const auto& [key, run] : runs_) {
      const auto& [block, row, column] = key;
      if (run.length == result_.intervals) {
        result_.local.push_back({block, row, column, run.source, run.first});
      } else {
        const std::size_t padded_first = result_.padded.size() * result_.intervals;
        result_.padded.push_back({run.source, run.first, run.begin, run.length, padded_first});
        result_.local.push_back({block, row, column, Source::padded, padded_first});
      }
    }
  }

  /// Diagonals, slopes and values of rows, whose columns are those of unknowns and rows.
  void append_vectors() {
    const Shape& shape = result_.shape;
    const int one = next_size(shape) + state_size(shape);
    using Block = LocalEntry::Block;
    const auto append_unknown = [&](int column, std::size_t first) {
      result_.local.push_back({Block::hessian, column, column, Source::diagonal, first});
      result_.local.push_back({Block::hessian, column, one, Source::slope, first});
    };
    for (int i = 0; i < shape.node; ++i) append_unknown(i, result_.node_unknowns[static_cast<std::size_t>(i)] + 1);
    for (int i = 0; i < shape.inner; ++i) {
      const auto j = static_cast<std::size_t>(i);
      if (!result_.inner_is_fixed[j]) append_unknown(shape.node + i, result_.inner_unknowns[j]);
    }
    for (int i = 0; i < shape.rows; ++i) {
      const auto j = static_cast<std::size_t>(i);
      const std::size_t first =
          i < shape.carried ? result_.node_rows[j] : result_.interval_rows[j - result_.node_rows.size()];
      result_.local.push_back({Block::equality, i, one, Source::rows, first});
    }
    for (int i = 0; i < shape.soft; ++i) {
      const std::size_t first = result_.soft_rows[static_cast<std::size_t>(i)];
      result_.local.push_back({Block::soft, i, one, Source::rows, first});
      result_.local.push_back({Block::soft, i, -1, Source::softness, first});
    }
  }

  const NonlinearProgram& program_;
  IntervalEntries result_;
  std::vector<Member> unknowns_;
  std::vector<Member> rows_;
  std::map<Key, Run> runs_;
};

}  // namespace

std::optional<IntervalEntries> interval_entries(const NonlinearProgram& program, std::string& why) {
  try {
    return Sorter(program).sort();
  } catch (const Irregular& irregular) {
    why = irregular.why;
    return std::nullopt;
  }
}

}  // namespace dmocbench::interior_point
