#include "methods/solvers/interior_point/intervals/columns.hpp"

#include <algorithm>
#include <iterator>

namespace dmocbench::interior_point {

Columns::Columns(const std::vector<Place>& places, std::size_t intervals) : places_(places) {
  for (std::size_t i = 0; i < places.size();) {
    const Place::Kind kind = places[i].kind;
    const std::size_t length = kind == Place::Kind::border ? 1 : intervals + (kind == Place::Kind::node ? 1 : 0);
    std::size_t count = 0;
    while (i + count < places.size() && count < length && places[i + count].kind == kind &&
           places[i + count].index == count) {
      ++count;
    }
    const bool is_column = kind != Place::Kind::border && count == length;
    if (is_column) {
      std::vector<std::size_t>& firsts = kind == Place::Kind::node ? nodes_ : inner_;
      columns_.push_back({i, length, kind, static_cast<int>(firsts.size()), false});
      firsts.push_back(i);
      i += length;
    } else {
      singles_.push_back(i);
      ++i;
    }
  }
}

Member Columns::member(std::size_t place) const {
  const auto behind = std::ranges::upper_bound(columns_, place, {}, &Column::first);
  if (behind != columns_.begin()) {
    const Column& column = *std::prev(behind);
    if (place - column.first < column.length) {
      return {column.kind, place - column.first, column.number, column.is_inequality};
    }
  }
  return {places_[place].kind, places_[place].index, -1, false};
}

void Columns::renumber(std::size_t first, int number, bool is_inequality) {
  const auto found = std::ranges::find(columns_, first, &Column::first);
  found->number = number;
  found->is_inequality = is_inequality;
}

}  // namespace dmocbench::interior_point
