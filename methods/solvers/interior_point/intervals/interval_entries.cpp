#include "methods/solvers/interior_point/intervals/interval_entries.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "methods/solvers/interior_point/intervals/columns.hpp"

namespace dmocbench::interior_point {

namespace {

/// Thrown inside, returned as a sentence.
struct Irregular {
  std::string why;
};

class Sorter {
 public:
  Sorter(const NonlinearProgram& program, const IntervalStructure& structure)
      : program_(program),
        structure_(structure),
        variable_lower_(program.variable_lower()),
        variable_upper_(program.variable_upper()),
        constraint_lower_(program.constraint_lower()),
        constraint_upper_(program.constraint_upper()),
        unknowns_(structure.unknowns, structure.intervals),
        rows_(structure.rows, structure.intervals) {}

  IntervalEntries sort(const ProgramRuns& runs) {
    result_.intervals = structure_.intervals;
    find_unknowns();
    find_rows();
    result_.shape = {.node = count(result_.node_unknowns),
                     .node_sums = count(result_.node_rows),
                     .global = count(result_.shared_unknowns),
                     .interval = count(result_.inner_unknowns),
                     .rows = count(result_.node_rows) + count(result_.interval_rows),
                     .inequalities = count(result_.inequality_rows)};
    if (free_size(result_.shape) < 0) throw Irregular{"an interval has more equalities than unknowns"};
    require_free_between_ends();
    sort(Source::hessian, program_.hessian_structure(), runs.hessian,
         [this](std::size_t i, std::size_t j) { return hessian_destination(i, j); });
    sort(Source::jacobian, program_.jacobian_structure(), runs.jacobian,
         [this](std::size_t i, std::size_t j) { return jacobian_destination(i, j); });
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

  static int count(const std::vector<std::size_t>& list) { return static_cast<int>(list.size()); }

  void find_unknowns() {
    const auto& places = structure_.unknowns;
    result_.node_unknowns = unknowns_.nodes();
    result_.inner_unknowns = unknowns_.inner();
    for (const std::size_t i : unknowns_.singles()) {
      if (places[i].kind == Place::Kind::border) {
        result_.shared_unknowns.push_back(i);
      } else {
        result_.single_unknowns[end_of(places[i], "an unknown")].push_back(i);
      }
    }
  }

  /// 0 for the first node, 1 for the last.
  [[nodiscard]] std::size_t end_of(const Place& place, const std::string& what) const {
    const bool is_end = place.kind == Place::Kind::node && (place.index == 0 || place.index == result_.intervals);
    if (!is_end) throw Irregular{what + " between the ends belongs to no column of its kind"};
    return place.index == 0 ? 0 : 1;
  }

  void find_rows() {
    const auto& places = structure_.rows;
    result_.node_rows = rows_.nodes();
    for (const std::size_t first : rows_.nodes()) {
      for (std::size_t k = 0; k <= result_.intervals; ++k) {
        if (is_inequality(first + k)) throw Irregular{"a row of a node is an inequality"};
      }
    }
    for (const std::size_t first : rows_.inner()) {
      const bool inequality = is_inequality(first);
      auto& list = inequality ? result_.inequality_rows : result_.interval_rows;
      for (std::size_t k = 0; k < result_.intervals; ++k) {
        if (is_inequality(first + k) != inequality) throw Irregular{"a row is an equality in some intervals only"};
      }
      rows_.renumber(first, count(list), inequality);
      list.push_back(first);
    }
    for (const std::size_t i : rows_.singles()) {
      if (places[i].kind != Place::Kind::border) static_cast<void>(end_of(places[i], "a row"));
      result_.single_rows.push_back(i);
    }
  }

  [[nodiscard]] bool is_inequality(std::size_t row) const {
    const auto i = static_cast<Eigen::Index>(row);
    return constraint_lower_[i] != constraint_upper_[i];
  }
  [[nodiscard]] bool is_fixed(std::size_t unknown) const {
    const auto i = static_cast<Eigen::Index>(unknown);
    return variable_lower_[i] == variable_upper_[i];
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
  [[nodiscard]] static int next_node(const Member& m) { return m.column; }
  [[nodiscard]] int inner(const Member& m) const { return result_.shape.node + m.column; }
  [[nodiscard]] int this_node(const Member& m) const { return next_size(result_.shape) + m.column; }
  [[nodiscard]] int shared(const Member& m) const {
    return next_size(result_.shape) + result_.shape.node + result_.shape.node_sums + m.column;
  }

  [[nodiscard]] Member unknown(std::size_t i) const {
    Member m = unknowns_.member(i);
    if (m.kind == Place::Kind::border) {
      const auto& shared = result_.shared_unknowns;
      m = {Place::Kind::border, 0, static_cast<int>(std::ranges::lower_bound(shared, i) - shared.begin()), false};
    }
    return m;
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

  /// Where an entry of a matrix goes: to a block of an interval, to the ends, or nowhere (fixed unknowns).
  struct Destination {
    enum class Where : unsigned char { interval, ends, nowhere };
    Where where = Where::nowhere;
    Key key{};
    std::size_t interval = 0;
  };

  static Destination to_ends() { return {Destination::Where::ends, {}, 0}; }

  void put(const Destination& to, Source source, std::size_t first_entry, std::size_t length) {
    Run& run = runs_[to.key];
    if (run.length == 0) run = {first_entry, to.interval, 0, source};
    if (first_entry != run.first + run.length || to.interval != run.begin + run.length) {
      throw Irregular{"its derivatives are not stored column by column"};
    }
    run.length += length;
  }

  /// Sorts the entries of a pattern run by run; only their first and last two are looked at where these tell that all
  /// between go to the same block.
  template <class DestinationOf>
  void sort(Source source, const SparsityPattern& pattern, const std::vector<PatternRun>& runs,
            const DestinationOf& destination_of) {
    const auto at = [&](std::size_t e) {
      return destination_of(static_cast<std::size_t>(pattern.rows[e]), static_cast<std::size_t>(pattern.columns[e]));
    };
    const auto sort_one = [&](std::size_t e) {
      const Destination to = at(e);
      if (to.where == Destination::Where::ends) {
        result_.ends.push_back(
            {source, e, static_cast<std::size_t>(pattern.rows[e]), static_cast<std::size_t>(pattern.columns[e])});
      } else if (to.where == Destination::Where::interval) {
        put(to, source, e, 1);
      }
    };
    for (const PatternRun& run : runs) {
      const auto first = static_cast<std::size_t>(run.entry);
      const auto length = static_cast<std::size_t>(run.length);
      constexpr std::size_t shortest = 4;
      const Destination second = length > shortest ? at(first + 1) : Destination{};
      const Destination last_but_one = length > shortest ? at(first + length - 2) : Destination{};
      const bool is_column = length > shortest && second.where == Destination::Where::interval &&
                             last_but_one.where == second.where && last_but_one.key == second.key &&
                             last_but_one.interval == second.interval + length - 3;
      sort_one(first);
      if (is_column) {
        put(second, source, first + 1, length - 2);
      } else {
        for (std::size_t e = 1; e + 1 < length; ++e) sort_one(first + e);
      }
      if (length > 1) sort_one(first + length - 1);
    }
  }

  [[nodiscard]] Destination hessian_destination(std::size_t i, std::size_t j) const {
    if (is_fixed_inner(i) || is_fixed_inner(j)) return {};
    const Member first = unknown(i);
    const Member second = unknown(j);
    const auto interval = interval_of(first, second);
    if (!interval) return to_ends();
    const int a = seen_from(first, *interval);
    const int b = seen_from(second, *interval);
    const int Z = next_size(result_.shape);
    if (a < 0 || b < 0 || (a >= Z && b >= Z)) return to_ends();
    return {Destination::Where::interval, {LocalEntry::Block::hessian, std::min(a, b), std::max(a, b)}, *interval};
  }

  /// The interval whose blocks hold the Hessian's entry of two unknowns: that before a node for the node's own ones.
  [[nodiscard]] static std::optional<std::size_t> interval_of(const Member& a, const Member& b) {
    for (const Member* m : {&a, &b}) {
      if (in_column(*m, Place::Kind::interval)) return m->at;
    }
    std::size_t latest = 0;
    for (const Member* m : {&a, &b}) {
      if (in_column(*m, Place::Kind::node)) latest = std::max(latest, m->at);
    }
    if (latest == 0) return std::nullopt;
    return latest - 1;
  }

  [[nodiscard]] bool is_fixed_inner(std::size_t i) const {
    const Member m = unknown(i);
    return in_column(m, Place::Kind::interval) && result_.inner_is_fixed[static_cast<std::size_t>(m.column)];
  }

  [[nodiscard]] Destination jacobian_destination(std::size_t i, std::size_t j) const {
    const Member row = rows_.member(i);
    if (is_fixed_inner(j)) return {};
    if (row.column < 0) return to_ends();
    return row.kind == Place::Kind::interval ? interval_row_destination(row, unknown(j))
                                             : node_row_destination(row, unknown(j));
  }

  [[nodiscard]] Destination interval_row_destination(const Member& row, const Member& of) const {
    const int column = seen_from(of, row.at);
    if (column < 0) throw Irregular{"a row of an interval reads unknowns of another one"};
    if (row.is_inequality)
      return {Destination::Where::interval, {LocalEntry::Block::inequality, row.column, column}, row.at};
    const int number = result_.shape.node_sums + row.column;
    return {Destination::Where::interval, {LocalEntry::Block::equality, number, column}, row.at};
  }

  [[nodiscard]] Destination node_row_destination(const Member& row, const Member& of) const {
    const bool from_before =
        (in_column(of, Place::Kind::interval) || in_column(of, Place::Kind::node)) && of.at + 1 == row.at;
    if (from_before) {
      const int Z = next_size(result_.shape);
      const int seen = seen_from(of, of.at);  // of its own interval, or the left node of it
      const int column = seen >= Z ? seen - Z : result_.shape.node + seen;
      return {Destination::Where::interval, {LocalEntry::Block::carry, row.column, column}, of.at};
    }
    const int column = row.at == result_.intervals ? -1 : seen_from(of, row.at);
    if (column < 0) return to_ends();
    return {Destination::Where::interval, {LocalEntry::Block::equality, row.column, column}, row.at};
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
      result_.local.push_back({Block::hessian, column, one, Source::gradient, first});
    };
    for (int i = 0; i < shape.node; ++i) append_unknown(i, result_.node_unknowns[static_cast<std::size_t>(i)] + 1);
    for (int i = 0; i < shape.interval; ++i) {
      const auto j = static_cast<std::size_t>(i);
      if (!result_.inner_is_fixed[j]) append_unknown(shape.node + i, result_.inner_unknowns[j]);
    }
    for (int i = 0; i < shape.rows; ++i) {
      const auto j = static_cast<std::size_t>(i);
      const std::size_t first =
          i < shape.node_sums ? result_.node_rows[j] : result_.interval_rows[j - result_.node_rows.size()];
      result_.local.push_back({Block::equality, i, one, Source::rows, first});
    }
    for (int i = 0; i < shape.inequalities; ++i) {
      const std::size_t first = result_.inequality_rows[static_cast<std::size_t>(i)];
      result_.local.push_back({Block::inequality, i, one, Source::rows, first});
      result_.local.push_back({Block::inequality, i, -1, Source::compliance, first});
    }
  }

  const NonlinearProgram& program_;
  const IntervalStructure& structure_;
  const Eigen::VectorXd& variable_lower_;
  const Eigen::VectorXd& variable_upper_;
  const Eigen::VectorXd& constraint_lower_;
  const Eigen::VectorXd& constraint_upper_;
  IntervalEntries result_;
  Columns unknowns_;
  Columns rows_;
  std::map<Key, Run> runs_;
};

}  // namespace

std::optional<IntervalEntries> interval_entries(const NonlinearProgram& program, const ProgramRuns& runs,
                                                std::string& why) {
  const IntervalStructure* const structure = program.interval_structure();
  try {
    if (structure == nullptr) throw Irregular{"it tells no interval structure"};
    if (structure->intervals == 0) throw Irregular{"it has no intervals"};
    return Sorter(program, *structure).sort(runs);
  } catch (const Irregular& irregular) {
    why = irregular.why;
    return std::nullopt;
  }
}

}  // namespace dmocbench::interior_point
