#include "bench/structure_advantage/node_order.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "methods/error.hpp"

namespace dmocbench::interior_point {

namespace {

/// Where a line of the KKT matrix stands along the horizon; lines are sorted by it.
struct Key {
  std::size_t place = border;  // 2 k for node k, 2 k + 1 for interval k
  int rank = 0;                // at one place
  friend bool operator<(const Key& a, const Key& b) { return std::tie(a.place, a.rank) < std::tie(b.place, b.rank); }
  [[nodiscard]] bool in_border() const { return place == border; }
  static constexpr std::size_t border = std::numeric_limits<std::size_t>::max();
};

/// Rows of a node stand before its unknowns, those of an interval behind: so an interval's rows stand between the two
/// nodes that they couple.
Key key_of(const Place& place, bool is_row) {
  if (place.kind == Place::Kind::border) return {};
  const bool of_node = place.kind == Place::Kind::node;
  return {2 * place.index + (of_node ? 0 : 1), is_row == of_node ? 1 : 2};
}
constexpr Key key_of_copy(std::size_t interval) { return {2 * interval + 1, 1}; }
constexpr Key key_of_tie(std::size_t interval) { return {2 * interval + 2, 0}; }

/// A row of the border that reads unknowns of one place only, such as a condition on the state at one end, needs no
/// line of the border: it goes to that place.
void bring_home_rows_of_one_place(const NonlinearProgram& program, std::vector<Key>& keys) {
  constexpr std::size_t unseen = Key::border - 1;
  const std::size_t unknowns = program.variable_count();
  std::vector<std::size_t> place(program.constraint_count(), unseen);
  program.jacobian_structure().for_each([&](Eigen::Index /*entry*/, int i, int j) {
    const auto row = static_cast<std::size_t>(i);
    const std::size_t read = keys[static_cast<std::size_t>(j)].place;
    if (!keys[unknowns + row].in_border() || read == Key::border) return;  // T is everywhere
    place[row] = place[row] == unseen || place[row] == read ? read : Key::border;
  });
  for (std::size_t row = 0; row < place.size(); ++row) {
    if (!keys[unknowns + row].in_border() || place[row] == Key::border) continue;
    keys[unknowns + row] = {place[row] == unseen ? 0 : place[row], 1};
  }
}

void append_copies(const std::vector<Key>& keys, std::size_t unknowns, std::size_t intervals, NodeOrder& order) {
  for (std::size_t unknown = 0; unknown < unknowns; ++unknown) {
    if (!keys[unknown].in_border()) continue;
    order.copies.push_back({unknown, std::vector<std::size_t>(intervals), std::vector<std::size_t>(intervals - 1)});
  }
}

/// Gives every line, copy and tie its position.
void number(const std::vector<Key>& keys, std::size_t unknowns, NodeOrder& order) {
  struct Item {
    Key key;
    std::size_t* position;
  };
  std::vector<Item> items;
  for (std::size_t line = 0; line < keys.size(); ++line) {
    const bool is_copied = line < unknowns && keys[line].in_border();
    if (keys[line].in_border() && !is_copied) {
      order.lines[line] = {true, order.border_size++};
    } else if (!is_copied) {
      items.push_back({keys[line], &order.lines[line].at});
    }
  }
  for (NodeOrder::Copies& copies : order.copies) {
    for (std::size_t k = 0; k < copies.of_intervals.size(); ++k) {
      items.push_back({key_of_copy(k), &copies.of_intervals[k]});
      if (k < copies.ties.size()) items.push_back({key_of_tie(k), &copies.ties[k]});
    }
  }
  std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.key < b.key; });
  for (const Item& item : items) *item.position = order.band_size++;
  for (const NodeOrder::Copies& copies : order.copies) order.lines[copies.unknown].at = copies.of_intervals.front();
}

std::size_t distance(std::size_t a, std::size_t b) { return std::max(a, b) - std::min(a, b); }

void measure_bandwidth(const BlockPattern& pattern, std::size_t first_row, NodeOrder& order) {
  pattern.for_each([&](Eigen::Index /*entry*/, int of_row, int of_column) {
    const std::size_t row = first_row + static_cast<std::size_t>(of_row);
    const auto column = static_cast<std::size_t>(of_column);
    const NodeOrder::Line i = order.place(row, column);
    const NodeOrder::Line j = order.place(column, row);
    if (!i.in_border && !j.in_border) order.half_bandwidth = std::max(order.half_bandwidth, distance(i.at, j.at));
  });
}

void measure_bandwidth_of_ties(NodeOrder& order) {
  for (const NodeOrder::Copies& copies : order.copies) {
    for (std::size_t k = 0; k < copies.ties.size(); ++k) {
      for (const std::size_t copy : {copies.of_intervals[k], copies.of_intervals[k + 1]}) {
        order.half_bandwidth = std::max(order.half_bandwidth, distance(copies.ties[k], copy));
      }
    }
  }
}

}  // namespace

NodeOrder::Line NodeOrder::place(std::size_t line, std::size_t other) const {
  for (const Copies& of_one : copies) {
    if (of_one.unknown == line) return {false, of_one.of_intervals[intervals[other]]};
  }
  return lines[line];
}

NodeOrder node_order(const NonlinearProgram& program) {
  const IntervalStructure* const structure = program.interval_structure();
  if (structure == nullptr || structure->intervals == 0) {
    throw Error("a program without an interval structure has no band");
  }
  std::vector<Key> keys;
  keys.reserve(structure->unknowns.size() + structure->rows.size());
  structure->unknowns.for_each([&](const Place& place) { keys.push_back(key_of(place, false)); });
  structure->rows.for_each([&](const Place& place) { keys.push_back(key_of(place, true)); });
  bring_home_rows_of_one_place(program, keys);

  const std::size_t unknowns = program.variable_count();
  NodeOrder order;
  order.lines.resize(keys.size());
  for (const Key& key : keys) {
    order.intervals.push_back(key.in_border() ? 0 : std::min(key.place / 2, structure->intervals - 1));
  }
  append_copies(keys, unknowns, structure->intervals, order);
  number(keys, unknowns, order);
  measure_bandwidth(program.hessian_structure(), 0, order);
  measure_bandwidth(program.jacobian_structure(), unknowns, order);
  measure_bandwidth_of_ties(order);
  return order;
}

}  // namespace dmocbench::interior_point
