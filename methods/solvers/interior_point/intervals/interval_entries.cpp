#include "methods/solvers/interior_point/intervals/interval_entries.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace dmocbench::interior_point {

namespace {

/// The first unknown, or row, of a run of `Places`; the others follow it node by node, interval by interval, or shared
/// unknown by shared unknown.
struct Member {
  Place::Kind kind = Place::Kind::border;
  std::size_t at = 0;  ///< node or interval
  int column = -1;     ///< number among the quantities of its kind; -1 for what single nodes have, and border rows
  bool is_inequality = false;  ///< rows only
};

bool in_column(const Member& m, Place::Kind kind) { return m.kind == kind && m.column >= 0; }

class EntryTable {
 public:
  EntryTable(const NonlinearProgram& program, const IntervalStructure& structure)
      : program_(program), structure_(structure) {}

  tl::expected<IntervalEntries, std::string> make() {
    result_.intervals = structure_.intervals;
    place_unknowns();
    place_rows();
    result_.shape = {.node = count(result_.node_unknowns),
                     .node_sums = count(result_.node_rows),
                     .global = count(result_.shared_unknowns),
                     .interval = count(result_.inner_unknowns),
                     .rows = count(result_.node_rows) + count(result_.interval_rows),
                     .inequalities = count(result_.inequality_rows)};
    if (free_size(result_.shape) < 0) refuse("an interval has more equalities than unknowns");
    require_free_between_ends();
    if (refusal_.empty()) {
      for (const PatternRun& run : program_.hessian_structure().runs()) place(Source::hessian, run);
      for (const PatternRun& run : program_.jacobian_structure().runs()) place(Source::jacobian, run);
    }
    append_columns();
    append_vectors();
    if (!refusal_.empty()) return tl::unexpected(std::move(refusal_));
    return std::move(result_);
  }

 private:
  using Key = std::tuple<LocalEntry::Block, int, int>;
  /// A block's entry over a stretch of intervals.
  struct Stretch {
    std::size_t first = 0;
    std::size_t begin = 0;
    std::size_t length = 0;
    Source source = Source::hessian;
  };

  static int count(const std::vector<std::size_t>& list) { return static_cast<int>(list.size()); }

  /// The first reason counts.
  void refuse(const char* why) {
    if (refusal_.empty()) refusal_ = why;
  }

  [[nodiscard]] bool is_of_all(const PlaceRun& run, Place::Kind kind) const {
    const std::size_t all = kind == Place::Kind::node ? structure_.intervals + 1 : structure_.intervals;
    return run.kind == kind && run.index == 0 && run.count == all;
  }

  void place_unknowns() {
    for (const PlaceRun& run : structure_.unknowns.runs()) {
      Member member{.kind = run.kind, .at = run.index};
      if (run.kind == Place::Kind::border) {
        member.column = count(result_.shared_unknowns);
        append_members(run, result_.shared_unknowns);
      } else if (is_of_all(run, Place::Kind::node) || is_of_all(run, Place::Kind::interval)) {
        auto& list = run.kind == Place::Kind::node ? result_.node_unknowns : result_.inner_unknowns;
        member.column = count(list);
        list.push_back(run.first);
      } else if (is_of_an_end(run)) {
        append_members(run, result_.single_unknowns[run.index == 0 ? 0 : 1]);
      } else {
        refuse("an unknown between the ends belongs to no column of its kind");
      }
      unknowns_.push_back(member);
    }
  }

  void place_rows() {
    for (const PlaceRun& run : structure_.rows.runs()) {
      Member member{.kind = run.kind, .at = run.index};
      if (is_of_all(run, Place::Kind::node)) {
        member.column = count(result_.node_rows);
        result_.node_rows.push_back(run.first);
        if (inequalities_in(run) > 0) refuse("a row of a node is an inequality");
      } else if (is_of_all(run, Place::Kind::interval)) {
        const Eigen::Index inequalities = inequalities_in(run);
        member.is_inequality = inequalities > 0;
        auto& list = member.is_inequality ? result_.inequality_rows : result_.interval_rows;
        member.column = count(list);
        list.push_back(run.first);
        if (member.is_inequality && inequalities < static_cast<Eigen::Index>(run.count)) {
          refuse("a row is an equality in some intervals only");
        }
      } else {
        if (run.kind != Place::Kind::border && !is_of_an_end(run)) {
          refuse("a row between the ends belongs to no column of its kind");
        }
        append_members(run, result_.single_rows);
      }
      rows_.push_back(member);
    }
  }

  [[nodiscard]] bool is_of_an_end(const PlaceRun& run) const {
    return run.kind == Place::Kind::node && run.count == 1 && (run.index == 0 || run.index == structure_.intervals);
  }
  static void append_members(const PlaceRun& run, std::vector<std::size_t>& list) {
    for (std::size_t i = 0; i < run.count; ++i) list.push_back(run.first + i);
  }

  [[nodiscard]] Eigen::Index inequalities_in(const PlaceRun& run) const {
    return different(program_.constraint_lower(), program_.constraint_upper(), run.first, run.count);
  }
  [[nodiscard]] Eigen::Index fixed_in(std::size_t first, std::size_t length) const {
    const auto free = different(program_.variable_lower(), program_.variable_upper(), first, length);
    return static_cast<Eigen::Index>(length) - free;
  }
  static Eigen::Index different(const Eigen::VectorXd& a, const Eigen::VectorXd& b, std::size_t first,
                                std::size_t length) {
    const auto begin = static_cast<Eigen::Index>(first);
    const auto size = static_cast<Eigen::Index>(length);
    return (a.segment(begin, size).array() != b.segment(begin, size).array()).count();
  }

  void require_free_between_ends() {
    for (const std::size_t first : result_.node_unknowns) {
      if (fixed_in(first + 1, result_.intervals - 1) > 0) refuse("an unknown of a node between the ends is fixed");
    }
    for (const std::size_t first : result_.inner_unknowns) {
      const Eigen::Index fixed = fixed_in(first, result_.intervals);
      result_.inner_is_fixed.push_back(fixed > 0);
      if (fixed > 0 && fixed < static_cast<Eigen::Index>(result_.intervals)) {
        refuse("an unknown is fixed in some intervals only");
      }
    }
  }

  [[nodiscard]] Member unknown(Eigen::Index number) const { return member_of(structure_.unknowns, unknowns_, number); }
  [[nodiscard]] Member row(Eigen::Index number) const { return member_of(structure_.rows, rows_, number); }
  static Member member_of(const Places& places, const std::vector<Member>& firsts, Eigen::Index number) {
    const std::size_t run = places.run_of(static_cast<std::size_t>(number));
    const std::size_t way = static_cast<std::size_t>(number) - places.runs()[run].first;
    Member member = firsts[run];
    if (member.kind != Place::Kind::border) {
      member.at += way;
    } else if (member.column >= 0) {
      member.column += static_cast<int>(way);
    }
    return member;
  }

  // Columns in the natural order of an interval's unknowns.
  [[nodiscard]] static int next_node(const Member& m) { return m.column; }
  [[nodiscard]] int inner(const Member& m) const { return result_.shape.node + m.column; }
  [[nodiscard]] int this_node(const Member& m) const { return next_size(result_.shape) + m.column; }
  [[nodiscard]] int shared(const Member& m) const {
    return next_size(result_.shape) + result_.shape.node + result_.shape.node_sums + m.column;
  }

  /// Where an unknown is seen from interval k; -1 if it does not belong to it.
  [[nodiscard]] int seen_from(const Member& m, std::size_t interval) const {
    if (m.column < 0) return -1;
    if (m.kind == Place::Kind::border) return shared(m);
    if (m.kind == Place::Kind::interval) return m.at == interval ? inner(m) : -1;
    if (m.at == interval + 1) return next_node(m);
    return m.at == interval ? this_node(m) : -1;
  }

  /// The block of an interval that an entry of a matrix goes to; none if it goes to the ends.
  struct Target {
    Key key;
    std::size_t interval;
  };
  using Destination = std::optional<Target>;

  /// True if all entries of a run but the first and the last go to the same block: if it does not leave the quantities
  /// that it begins in, and moves through both of them, or through one beside something of the whole horizon.
  [[nodiscard]] bool is_of_one_block(const PatternRun& run, const Places& places_of_rows) const {
    const auto stays = [&](const Places& places, Eigen::Index first, Eigen::Index step) {
      const auto last = static_cast<std::size_t>(first + step * (run.length - 1));
      return places.run_of(static_cast<std::size_t>(first)) == places.run_of(last);
    };
    const auto is_of_horizon = [](const Places& places, Eigen::Index number) {
      return places.runs()[places.run_of(static_cast<std::size_t>(number))].kind == Place::Kind::border;
    };
    return stays(places_of_rows, run.row, run.row_step) && stays(structure_.unknowns, run.column, run.column_step) &&
           (run.row_step == run.column_step || is_of_horizon(places_of_rows, run.row) ||
            is_of_horizon(structure_.unknowns, run.column));
  }

  void place(Source source, const PatternRun& run) {
    const bool is_hessian = source == Source::hessian;
    const bool is_block = is_of_one_block(run, is_hessian ? structure_.unknowns : structure_.rows);
    for (Eigen::Index begin = 0; begin < run.length;) {
      const Eigen::Index end = is_block && begin == 1 ? std::max<Eigen::Index>(2, run.length - 1) : begin + 1;
      const Eigen::Index i = run.row + begin * run.row_step;
      const Member j = unknown(run.column + begin * run.column_step);
      const bool is_nowhere = is_fixed_inner(j) || (is_hessian && is_fixed_inner(unknown(i)));
      if (!is_nowhere) {
        put(is_hessian ? hessian_destination(unknown(i), j) : jacobian_destination(row(i), j), source, run, begin, end);
      }
      begin = end;
    }
  }

  /// Entries `begin` .. `end` - 1 of a run.
  void put(const Destination& to, Source source, const PatternRun& run, Eigen::Index begin, Eigen::Index end) {
    const auto number = [](Eigen::Index i) { return static_cast<std::size_t>(i); };
    if (!to) {
      for (Eigen::Index i = begin; i < end; ++i) {
        result_.ends.push_back({source, number(run.entry + i), number(run.row + i * run.row_step),
                                number(run.column + i * run.column_step)});
      }
      return;
    }
    const std::size_t first = number(run.entry + begin);
    Stretch& stretch = stretches_[to->key];
    if (stretch.length == 0) stretch = {first, to->interval, 0, source};
    if (first != stretch.first + stretch.length || to->interval != stretch.begin + stretch.length) {
      refuse("its derivatives are not stored interval by interval");
    }
    stretch.length += number(end - begin);
  }

  [[nodiscard]] Destination hessian_destination(const Member& first, const Member& second) const {
    const auto interval = interval_of(first, second);
    if (!interval) return std::nullopt;
    const int a = seen_from(first, *interval);
    const int b = seen_from(second, *interval);
    const int Z = next_size(result_.shape);
    if (a < 0 || b < 0 || (a >= Z && b >= Z)) return std::nullopt;
    return Target{{LocalEntry::Block::hessian, std::min(a, b), std::max(a, b)}, *interval};
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

  [[nodiscard]] bool is_fixed_inner(const Member& m) const {
    return in_column(m, Place::Kind::interval) && result_.inner_is_fixed[static_cast<std::size_t>(m.column)];
  }

  [[nodiscard]] Destination jacobian_destination(const Member& row, const Member& of) {
    if (row.column < 0) return std::nullopt;
    return row.kind == Place::Kind::interval ? interval_row_destination(row, of) : node_row_destination(row, of);
  }

  [[nodiscard]] Destination interval_row_destination(const Member& row, const Member& of) {
    const int column = seen_from(of, row.at);
    if (column < 0) refuse("a row of an interval reads unknowns of another one");
    if (row.is_inequality) return Target{{LocalEntry::Block::inequality, row.column, column}, row.at};
    const int number = result_.shape.node_sums + row.column;
    return Target{{LocalEntry::Block::equality, number, column}, row.at};
  }

  [[nodiscard]] Destination node_row_destination(const Member& row, const Member& of) const {
    const bool from_before =
        (in_column(of, Place::Kind::interval) || in_column(of, Place::Kind::node)) && of.at + 1 == row.at;
    if (from_before) {
      const int Z = next_size(result_.shape);
      const int seen = seen_from(of, of.at);  // of its own interval, or the left node of it
      const int column = seen >= Z ? seen - Z : result_.shape.node + seen;
      return Target{{LocalEntry::Block::carry, row.column, column}, of.at};
    }
    const int column = row.at == result_.intervals ? -1 : seen_from(of, row.at);
    if (column < 0) return std::nullopt;
    return Target{{LocalEntry::Block::equality, row.column, column}, row.at};
  }

  void append_columns() {
    for (const auto& [key, stretch] : stretches_) {
      const auto& [block, row, column] = key;
      if (stretch.length == result_.intervals) {
        result_.local.push_back({block, row, column, stretch.source, stretch.first});
      } else {
        const std::size_t padded_first = result_.padded.size() * result_.intervals;
        result_.padded.push_back({stretch.source, stretch.first, stretch.begin, stretch.length, padded_first});
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
  IntervalEntries result_;
  std::vector<Member> unknowns_;  // one per run of places
  std::vector<Member> rows_;
  std::map<Key, Stretch> stretches_;
  std::string refusal_;
};

}  // namespace

tl::expected<IntervalEntries, std::string> interval_entries(const NonlinearProgram& program) {
  const IntervalStructure* const structure = program.interval_structure();
  if (structure == nullptr) return tl::unexpected(std::string("it tells no interval structure"));
  if (structure->intervals == 0) return tl::unexpected(std::string("it has no intervals"));
  return EntryTable(program, *structure).make();
}

}  // namespace dmocbench::interior_point
