#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace dmocbench {

/// The place of an unknown or a row of a transcribed program: a node k from 0 to N, an interval k from 0 to N -
/// 1, or the border (a quantity of the whole horizon).
struct Place {
  /// A node, an interval, or the whole horizon.
  enum class Kind : std::uint8_t { node, interval, border };
  Kind kind = Kind::border;  ///< where it belongs
  std::size_t index = 0;     ///< which node or interval, from 0
};

/// Consecutive unknowns, or rows, of one kind: number `first` + i belongs to node, or interval, `index` + i.
struct PlaceRun {
  Place::Kind kind = Place::Kind::border;  ///< where they belong
  std::size_t index = 0;                   ///< of the first one's node or interval
  std::size_t count = 0;                   ///< how many there are
  std::size_t first = 0;                   ///< the first one's number
  /// Whether they are values of a control, or rates of first-order states, which follow from it at their stage.
  bool is_control = false;
};

/// The places of all unknowns, or of all rows, as runs. A quantity of all nodes is one run of N + 1, a quantity of all
/// intervals one of N; a shorter run is a quantity of its nodes alone.
class Places {
 public:
  /// Adds a run and returns the number of its first member.
  std::size_t append(Place::Kind kind, std::size_t index, std::size_t count, bool is_control = false) {
    runs_.push_back({kind, index, count, size_, is_control});
    size_ += count;
    return runs_.back().first;
  }

  /// All runs; together they name every unknown, or row, once.
  [[nodiscard]] const std::vector<PlaceRun>& runs() const noexcept { return runs_; }
  /// The number of places.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// The number of the run that a member belongs to.
  [[nodiscard]] std::size_t run_of(std::size_t number) const {
    const auto behind = std::ranges::upper_bound(runs_, number, {}, &PlaceRun::first);
    return static_cast<std::size_t>(std::distance(runs_.begin(), behind)) - 1;
  }
  /// The place of a member.
  [[nodiscard]] Place operator[](std::size_t number) const {
    const PlaceRun& run = runs_[run_of(number)];
    return {run.kind, run.kind == Place::Kind::border ? 0 : run.index + number - run.first};
  }
  /// Calls visit(place) for every member in order.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const PlaceRun& run : runs_) {
      for (std::size_t i = 0; i < run.count; ++i) {
        visit(Place{run.kind, run.kind == Place::Kind::border ? 0 : run.index + i});
      }
    }
  }

 private:
  std::vector<PlaceRun> runs_;
  std::size_t size_ = 0;
};

/// The structure that solvers by intervals need: a row of interval k reads unknowns of nodes k and k + 1, of interval k
/// and of the border only; a row of node k also unknowns of intervals k - 1 and k. A run of the Jacobian's pattern
/// keeps within one run of `rows` and one of `unknowns`, a run of the Hessian's within two of `unknowns`.
struct IntervalStructure {
  std::size_t intervals = 0;  ///< N
  Places unknowns;            ///< one for every unknown
  Places rows;                ///< one for every row
  /// A node between the ends has fixed unknowns or equations that the others lack: its linear systems are not the same
  /// in all intervals.
  bool has_interior_equations = false;
};

}  // namespace dmocbench
