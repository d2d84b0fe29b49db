#include "methods/kkt/intervals/interval_entries.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "methods/runtime/long_vectors.hpp"

namespace dmocbench::kkt {

namespace {

using Block = LocalEntry::Block;

/// The role of a run of unknowns, or of rows.
struct Quantity {
  int number = -1;  ///< among the quantities of its kind; -1 for quantities of single nodes, and rows of the border
  bool is_inequality = false;
};

/// The unknown, or row, that a run of a pattern begins with.
struct Member : Quantity {
  Place::Kind kind;
  Eigen::Index index;   ///< of its node or interval
  Eigen::Index length;  ///< of its run of places, from here on
};

/// The blocks' entry that a run goes to: its entry i to interval `first` + i, or to the ends where there is none.
struct Target {
  std::tuple<Block, int, int> position;
  Eigen::Index first;
};

class EntryTable {
 public:
  EntryTable(const NonlinearProgram& program, const IntervalStructure& structure)
      : program_(program), structure_(structure) {}

  tl::expected<IntervalEntries, std::string> make() {
    made_.intervals = static_cast<Eigen::Index>(structure_.intervals);
    for (const PlaceRun& run : structure_.unknowns.runs()) unknowns_.push_back({unknown_of(run)});
    for (const PlaceRun& run : structure_.rows.runs()) rows_.push_back(row_of(run));
    made_.shape = {.node = count(made_.node_unknowns),
                   .node_sums = count(made_.equality_rows),
                   .global = count(made_.global_unknowns),
                   .interval = count(made_.interval_unknowns),
                   .rows = count(made_.equality_rows) + count(own_rows_),
                   .inequalities = count(made_.inequality_rows)};
    made_.equality_rows.insert(made_.equality_rows.end(), own_rows_.begin(), own_rows_.end());
    if (free_size(made_.shape) < 0) refuse("an interval has more equalities than unknowns");
    if (refusal_.empty()) {
      for (const PatternRun& run : program_.hessian_structure().runs()) place(Source::hessian, run);
      for (const PatternRun& run : program_.jacobian_structure().runs()) place(Source::jacobian, run);
    }
    if (!refusal_.empty()) return tl::unexpected(std::move(refusal_));
    append_matrices();
    append_vectors();
    return std::move(made_);
  }

 private:
  static int count(const std::vector<Eigen::Index>& list) { return static_cast<int>(list.size()); }
  /// Adds numbers to a list, and returns the position of the first.
  static int append(const PlaceRun& run, std::size_t length, std::vector<Eigen::Index>& list) {
    const int at = count(list);
    for (std::size_t i = 0; i < length; ++i) list.push_back(static_cast<Eigen::Index>(run.first + i));
    return at;
  }

  /// The first reason counts.
  void refuse(const char* reason) {
    if (refusal_.empty()) refusal_ = reason;
  }

  [[nodiscard]] bool is_of_all(const PlaceRun& run, Place::Kind kind) const {
    return run.kind == kind && run.index == 0 &&
           run.count == structure_.intervals + (kind == Place::Kind::node ? 1 : 0);
  }
  [[nodiscard]] bool is_of_an_end(const PlaceRun& run) const {
    return run.kind == Place::Kind::node && run.count == 1 && (run.index == 0 || run.index == structure_.intervals);
  }
  /// The number of equal bounds among some consecutive ones.
  static Eigen::Index equal_bounds(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, std::size_t first,
                                   Eigen::Index length) {
    const auto begin = static_cast<Eigen::Index>(first);
    const double equal = sum_of_stretches(length, [&](Eigen::Index from, Eigen::Index count) {
      const auto some = lower.segment(begin + from, count).array() == upper.segment(begin + from, count).array();
      return static_cast<double>(some.count());
    });
    return static_cast<Eigen::Index>(equal);
  }

  int unknown_of(const PlaceRun& run) {
    const auto fixed = [&](std::size_t first, Eigen::Index length) {
      return equal_bounds(program_.variable_lower(), program_.variable_upper(), first, length);
    };
    if (run.kind == Place::Kind::border) return append(run, run.count, made_.global_unknowns);
    if (is_of_all(run, Place::Kind::node)) {
      const bool holds_some = fixed(run.first + 1, made_.intervals - 1) > 0;
      for (Eigen::Index k = 1; holds_some && k < made_.intervals; ++k) {
        const auto unknown = static_cast<Eigen::Index>(run.first) + k;
        if (dmocbench::is_fixed(program_, unknown)) made_.held_unknowns.push_back(unknown);
      }
      return append(run, 1, made_.node_unknowns);
    }
    if (is_of_all(run, Place::Kind::interval)) {
      const Eigen::Index fixed_ones = fixed(run.first, made_.intervals);
      if (fixed_ones > 0 && fixed_ones < made_.intervals) refuse("an unknown is fixed in only some of the intervals");
      made_.is_fixed.push_back(fixed_ones > 0);
      return append(run, 1, made_.interval_unknowns);
    }
    if (!is_of_an_end(run)) refuse("an unknown exists in only some of the intervals or nodes");
    append(run, run.count, made_.end_unknowns[run.index == 0 ? 0 : 1]);
    return -1;
  }

  Quantity row_of(const PlaceRun& run) {
    const auto length = static_cast<Eigen::Index>(run.count);
    const Eigen::Index equalities =
        equal_bounds(program_.constraint_lower(), program_.constraint_upper(), run.first, length);
    if (is_of_all(run, Place::Kind::node)) {
      if (equalities < length) refuse("a constraint of a node is an inequality");
      return {append(run, 1, made_.equality_rows)};
    }
    if (is_of_all(run, Place::Kind::interval)) {
      if (equalities > 0 && equalities < length) refuse("a constraint is an equality in only some of the intervals");
      const bool is_inequality = equalities < length;
      return {append(run, 1, is_inequality ? made_.inequality_rows : own_rows_), is_inequality};
    }
    if (run.kind != Place::Kind::border && !is_of_an_end(run)) {
      refuse("a constraint exists in only some of the intervals or nodes");
    }
    append(run, run.count, made_.end_rows);
    return {};
  }

  static Member member(const Places& places, const std::vector<Quantity>& quantities, Eigen::Index number) {
    const std::size_t run = places.run_of(static_cast<std::size_t>(number));
    const PlaceRun& place = places.runs()[run];
    const Eigen::Index offset = number - static_cast<Eigen::Index>(place.first);
    Member member{quantities[run], place.kind, static_cast<Eigen::Index>(place.index) + offset,
                  static_cast<Eigen::Index>(place.count) - offset};
    if (member.kind == Place::Kind::border && member.number >= 0) member.number += static_cast<int>(offset);
    return member;
  }

  /// The column of an interval's blocks that an unknown stands in; -1 if the interval does not see it.
  [[nodiscard]] int column_in(Eigen::Index interval, const Member& m) const {
    const Shape& shape = made_.shape;
    const int this_node = next_size(shape);
    if (m.number < 0) return -1;
    if (m.kind == Place::Kind::border) return this_node + shape.node + shape.node_sums + m.number;
    if (m.kind == Place::Kind::interval) return m.index == interval ? shape.node + m.number : -1;
    if (m.index == interval + 1) return m.number;
    return m.index == interval ? this_node + m.number : -1;
  }

  /// Quantity by quantity: with a single interval, a run may extend from one to the next.
  void place(Source source, PatternRun rest) {
    while (rest.length > 0) {
      const Member column = member(structure_.unknowns, unknowns_, rest.column);
      const Member row = source == Source::hessian ? member(structure_.unknowns, unknowns_, rest.row)
                                                   : member(structure_.rows, rows_, rest.row);
      PatternRun run = rest;
      if (run.row_step == 1) run.length = std::min(run.length, row.length);
      if (run.column_step == 1) run.length = std::min(run.length, column.length);
      place(source, run, row, column);
      rest.entry += run.length;
      rest.row += run.length * run.row_step;
      rest.column += run.length * run.column_step;
      rest.length -= run.length;
    }
  }

  void place(Source source, const PatternRun& run, const Member& row, const Member& column) {
    const bool is_hessian = source == Source::hessian;
    if (is_fixed(column) || (is_hessian && is_fixed(row))) return;
    const std::optional<Target> to = is_hessian ? hessian_target(row, column) : jacobian_target(row, column);
    const Eigen::Index begin = to ? std::clamp<Eigen::Index>(-to->first, 0, run.length) : run.length;
    const Eigen::Index end = to ? std::clamp(made_.intervals - to->first, begin, run.length) : run.length;
    const auto add_to_ends = [&](Eigen::Index i) {
      made_.ends.push_back({source, run.entry + i, run.row + i * run.row_step, run.column + i * run.column_step});
    };
    for (Eigen::Index i = 0; i < begin; ++i) add_to_ends(i);
    for (Eigen::Index i = end; i < run.length; ++i) add_to_ends(i);
    if (!to || begin == end) return;
    const auto moves = [&](const Member& m, Eigen::Index step) {
      return (m.kind != Place::Kind::border) == (step == 1);
    };
    const PaddedRun some{source, run.entry + begin, to->first + begin, end - begin, 0};
    const auto [found, is_new] = runs_.try_emplace(to->position, some);
    PaddedRun& known = found->second;
    const bool follows = some.entry == known.entry + known.length && some.begin == known.begin + known.length;
    const bool is_straight = run.length == 1 || (moves(row, run.row_step) && moves(column, run.column_step));
    if (!is_straight || !(is_new || follows)) refuse("its derivatives are not stored interval by interval");
    if (!is_new) known.length += some.length;
  }

  [[nodiscard]] bool is_fixed(const Member& m) const {
    return m.kind == Place::Kind::interval && m.number >= 0 && made_.is_fixed_column(made_.shape.node + m.number);
  }

  /// In the blocks of the interval before a node stand the node's own entries.
  [[nodiscard]] std::optional<Target> hessian_target(const Member& a, const Member& b) const {
    const auto interval_of = [](const Member& m) {
      return m.kind == Place::Kind::border ? -1 : m.index - (m.kind == Place::Kind::node ? 1 : 0);
    };
    const Eigen::Index interval = std::max(interval_of(a), interval_of(b));
    const auto [row, column] = std::minmax({column_in(interval, a), column_in(interval, b)});
    if (row < 0 || row >= next_size(made_.shape)) return std::nullopt;
    return Target{{Block::hessian, row, column}, interval};
  }

  [[nodiscard]] std::optional<Target> jacobian_target(const Member& row, const Member& of) {
    if (row.number < 0) return std::nullopt;
    const bool is_of_node = row.kind == Place::Kind::node;
    if (is_of_node && of.number >= 0 && of.kind != Place::Kind::border && of.index + 1 == row.index) {
      const int next = of.kind == Place::Kind::node ? 0 : 2 * made_.shape.node;
      return Target{{Block::carry, row.number, next + of.number}, of.index};
    }
    const int column = column_in(row.index, of);
    if (column < 0) {
      if (!is_of_node) refuse("a constraint of an interval reads unknowns of another interval");
      return std::nullopt;
    }
    if (row.is_inequality) return Target{{Block::inequality, row.number, column}, row.index};
    return Target{{Block::equality, (is_of_node ? 0 : made_.shape.node_sums) + row.number, column}, row.index};
  }

  void append_matrices() {
    for (auto& [position, run] : runs_) {
      const auto& [block, row, column] = position;
      if (run.length == made_.intervals) {
        made_.local.push_back({block, row, column, run.source, run.entry});
      } else {
        run.padded_first = static_cast<Eigen::Index>(made_.padded.size()) * made_.intervals;
        made_.local.push_back({block, row, column, Source::padded, run.padded_first});
        made_.padded.push_back(run);
      }
    }
  }

  /// Diagonals, gradients and values of rows.
  void append_vectors() {
    const int one = next_size(made_.shape) + state_size(made_.shape);
    for (int column = 0; column < next_size(made_.shape); ++column) {
      if (made_.is_fixed_column(column)) continue;
      made_.local.push_back({Block::hessian, column, column, Source::diagonal, made_.unknown_in(column)});
      made_.local.push_back({Block::hessian, column, one, Source::gradient, made_.unknown_in(column)});
    }
    for (int i = 0; const Eigen::Index first : made_.equality_rows) {
      made_.local.push_back({Block::equality, i++, one, Source::rows, first});
    }
    for (int i = 0; const Eigen::Index first : made_.inequality_rows) {
      made_.local.push_back({Block::inequality, i, one, Source::rows, first});
      made_.local.push_back({Block::inequality, i++, -1, Source::compliance, first});
    }
  }

  const NonlinearProgram& program_;
  const IntervalStructure& structure_;
  IntervalEntries made_;
  std::vector<Eigen::Index> own_rows_;  // equalities of intervals
  std::vector<Quantity> unknowns_;      // one per run of places
  std::vector<Quantity> rows_;
  std::map<std::tuple<Block, int, int>, PaddedRun> runs_;
  std::string refusal_;
};

}  // namespace

Eigen::Index IntervalEntries::unknown_in(int column) const {
  const auto in = [](const std::vector<Eigen::Index>& list, int i) { return list[static_cast<std::size_t>(i)]; };
  if (column < shape.node) return in(node_unknowns, column) + 1;
  if (column < next_size(shape)) return in(interval_unknowns, column - shape.node);
  const int state = column - next_size(shape);
  return state < shape.node ? in(node_unknowns, state) : in(global_unknowns, state - shape.node - shape.node_sums);
}

bool IntervalEntries::is_fixed_column(int column) const {
  return column >= shape.node && column < next_size(shape) && is_fixed[static_cast<std::size_t>(column - shape.node)];
}

Eigen::VectorXd IntervalEntries::make_padded(Eigen::Index width) const {
  return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(padded.size()) * intervals * width);
}

void IntervalEntries::copy_padded(const NewtonArrays& arrays, Eigen::Index width, Eigen::VectorXd& to) const {
  for (const PaddedRun& run : padded) {
    const double* const first = arrays.of(run.source) + run.entry * width;
    double* const copies = to.data() + (run.padded_first + run.begin) * width;
    for_stretches(run.length * width, [&](std::size_t, Eigen::Index begin, Eigen::Index length) {
      std::copy_n(first + begin, length, copies + begin);
    });
  }
}

void IntervalEntries::write_fixed(Eigen::Index width, double* primal) const {
  for (int column = 0; column < next_size(shape); ++column) {
    if (is_fixed_column(column)) std::fill_n(primal + unknown_in(column) * width, intervals * width, 0.0);
  }
}

void IntervalEntries::write_inequality_multipliers(const NewtonArrays& arrays, Eigen::Index width, const double* primal,
                                                   double* multipliers) const {
  using Numbers = Eigen::Map<const Eigen::ArrayXd>;
  const Eigen::Index count = intervals * width;
  const auto of_row = [&](Eigen::Index row) { return Eigen::Map<Eigen::ArrayXd>(multipliers + row * width, count); };
  for (const Eigen::Index row : inequality_rows) {
    of_row(row) = Numbers(arrays.of(Source::rows) + row * width, count);
  }
  const int one = next_size(shape) + state_size(shape);
  for (const LocalEntry& entry : local) {
    if (entry.block != LocalEntry::Block::inequality || entry.column < 0 || entry.column == one) continue;
    const double* const steps = primal + unknown_in(entry.column) * width;
    auto sum = of_row(inequality_rows[static_cast<std::size_t>(entry.row)]);
    const Numbers derivative(arrays.of(entry.source) + entry.first * width, count);
    if (entry.column >= one - shape.global) {
      sum += derivative * *steps;
    } else {
      sum += derivative * Numbers(steps, count);
    }
  }
  for (const Eigen::Index row : inequality_rows) {
    of_row(row) /= Numbers(arrays.of(Source::compliance) + row * width, count);
  }
}

tl::expected<IntervalEntries, std::string> interval_entries(const NonlinearProgram& program) {
  const IntervalStructure* const structure = program.interval_structure();
  if (structure == nullptr) return tl::unexpected(std::string("it has no interval structure"));
  if (structure->intervals == 0) return tl::unexpected(std::string("it has no intervals"));
  return EntryTable(program, *structure).make();
}

const char* reason_of_free_ends(const NonlinearProgram& program, const IntervalEntries& entries) {
  if (!entries.held_unknowns.empty()) return "an unknown of a node between the ends is fixed";
  if (!entries.global_unknowns.empty()) return "an unknown belongs to the whole horizon";
  if (!entries.end_unknowns[0].empty() || !entries.end_unknowns[1].empty()) return "an end has unknowns of its own";
  if (!entries.end_rows.empty()) return "there are boundary conditions";
  for (const Eigen::Index first : entries.node_unknowns) {
    if (!is_fixed(program, first)) return "the state at the start is not given";
    if (!is_fixed(program, first + entries.intervals)) return "the state at the end is not given";
  }
  return nullptr;
}

}  // namespace dmocbench::kkt
