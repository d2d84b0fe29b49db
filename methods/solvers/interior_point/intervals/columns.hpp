#pragma once

#include <cstddef>
#include <vector>

#include "methods/program/interval_structure.hpp"

namespace dmocbench::interior_point {

/// Where an unknown or a row stands.
struct Member {
  Place::Kind kind = Place::Kind::border;
  std::size_t at = 0;          ///< node or interval
  int column = -1;             ///< number among the columns of its kind; -1 for a single one
  bool is_inequality = false;  ///< rows only
};

/// The columns of a program's unknowns or rows: stretches of places of one kind that count all nodes, or all intervals,
/// from the first to the last. What belongs to no column is single.
class Columns {
 public:
  /// `places` are referred to.
  Columns(const std::vector<Place>& places, std::size_t intervals);

  [[nodiscard]] const std::vector<std::size_t>& nodes() const noexcept { return nodes_; }  ///< first places of columns
  [[nodiscard]] const std::vector<std::size_t>& inner() const noexcept { return inner_; }  ///< those of intervals
  [[nodiscard]] const std::vector<std::size_t>& singles() const noexcept { return singles_; }

  [[nodiscard]] Member member(std::size_t place) const;

  /// Gives the column of intervals that begins at `first` another number, among those that are inequalities too, or are not.
  void renumber(std::size_t first, int number, bool is_inequality);

 private:
  struct Column {
    std::size_t first;
    std::size_t length;
    Place::Kind kind;
    int number;
    bool is_inequality;
  };

  const std::vector<Place>& places_;
  std::vector<Column> columns_;  // by their first places
  std::vector<std::size_t> nodes_;
  std::vector<std::size_t> inner_;
  std::vector<std::size_t> singles_;
};

}  // namespace dmocbench::interior_point
