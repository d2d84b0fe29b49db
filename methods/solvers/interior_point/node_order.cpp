#include "methods/solvers/interior_point/node_order.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

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
  return {2 * place.index + (of_node ? 0 : 1), is_row == of_node ? 0 : 1};
}

/// A row of the border that reads unknowns of one place only, such as a condition on the state at one end, needs no
/// line of the border: it goes to that place.
void bring_home_rows_of_one_place(const NonlinearProgram& program, std::vector<Key>& keys) {
  const std::size_t unknowns = program.variable_count();
  const SparsityPattern& jacobian = program.jacobian_structure();
  constexpr std::size_t unseen = Key::border - 1;
  std::vector<std::size_t> place(program.constraint_count(), unseen);
  for (std::size_t e = 0; e < jacobian.size(); ++e) {
    const auto row = static_cast<std::size_t>(jacobian.rows[e]);
    if (!keys[unknowns + row].in_border()) continue;
    const std::size_t read = keys[static_cast<std::size_t>(jacobian.columns[e])].place;
    place[row] = place[row] == unseen || place[row] == read ? read : Key::border;
  }
  for (std::size_t row = 0; row < place.size(); ++row) {
    if (!keys[unknowns + row].in_border() || place[row] == unseen || place[row] == Key::border) continue;
    keys[unknowns + row] = {place[row], 0};
  }
}

void measure_bandwidth(const SparsityPattern& pattern, std::size_t first_row, NodeOrder& order) {
  for (std::size_t e = 0; e < pattern.size(); ++e) {
    const NodeOrder::Line& row = order.lines[first_row + static_cast<std::size_t>(pattern.rows[e])];
    const NodeOrder::Line& column = order.lines[static_cast<std::size_t>(pattern.columns[e])];
    if (row.in_border || column.in_border) continue;
    order.half_bandwidth = std::max(order.half_bandwidth, std::max(row.at, column.at) - std::min(row.at, column.at));
  }
}

}  // namespace

std::optional<NodeOrder> node_order(const NonlinearProgram& program, std::string& why) {
  const IntervalStructure* const structure = program.interval_structure();
  if (structure == nullptr) {
    why = "it tells no interval structure";
    return std::nullopt;
  }
  std::vector<Key> keys;
  keys.reserve(structure->unknowns.size() + structure->rows.size());
  for (const Place& place : structure->unknowns) keys.push_back(key_of(place, false));
  for (const Place& place : structure->rows) keys.push_back(key_of(place, true));
  bring_home_rows_of_one_place(program, keys);

  std::vector<std::size_t> sorted(keys.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::stable_sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  NodeOrder order;
  order.lines.resize(keys.size());
  for (const std::size_t line : sorted) {
    const bool in_border = keys[line].in_border();
    order.lines[line] = {in_border, in_border ? order.border_size++ : order.band_size++};
  }
  measure_bandwidth(program.hessian_structure(), 0, order);
  measure_bandwidth(program.jacobian_structure(), program.variable_count(), order);
  return order;
}

}  // namespace dmocbench::interior_point
