#include "methods/solvers/interior_point/dissection_order.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace dmocbench::interior_point {

namespace {

/// Places along the horizon are numbered: 2 k is node k, 2 k + 1 interval k.
std::size_t number_of(const Place& place) {
  return 2 * place.index + (place.kind == Place::Kind::interval ? std::size_t{1} : std::size_t{0});
}

/// Puts the places `begin` .. `end` - 1 into their order of elimination.
void dissect(std::size_t begin, std::size_t end, std::size_t& next, std::vector<std::size_t>& ranks) {
  // Ten intervals and their nodes. Of 5 to 40 intervals none is faster by more than the noise (robot_arm, hang_glider).
  constexpr std::size_t most_together = 20;
  if (end - begin <= most_together) {
    for (std::size_t place = begin; place < end; ++place) ranks[place] = next++;
    return;
  }
  const std::size_t middle = (begin + end) / 4 * 2;
  dissect(begin, middle, next, ranks);
  dissect(middle + 1, end, next, ranks);
  ranks[middle] = next++;
}

}  // namespace

std::vector<int> dissection_order(const NonlinearProgram& program) {
  const IntervalStructure* const structure = program.interval_structure();
  if (structure == nullptr) return {};
  std::vector<std::size_t> ranks(2 * structure->intervals + 1);
  std::size_t next = 0;
  dissect(0, ranks.size(), next, ranks);

  std::vector<std::pair<std::size_t, int>> keys;  // of the lines
  const auto append = [&](const Place& place, bool is_row) {
    const bool in_border = place.kind == Place::Kind::border;
    // Rows of a node stand before its unknowns, those of an interval behind.
    const bool is_first = is_row == (place.kind == Place::Kind::node);
    keys.emplace_back(2 * (in_border ? next : ranks[number_of(place)]) + (is_first ? 0U : 1U),
                      static_cast<int>(keys.size()));
  };
  structure->unknowns.for_each([&](const Place& place) { append(place, false); });
  structure->rows.for_each([&](const Place& place) { append(place, true); });
  std::ranges::sort(keys);
  std::vector<int> positions(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    positions[static_cast<std::size_t>(keys[i].second)] = static_cast<int>(i);
  return positions;
}

}  // namespace dmocbench::interior_point
