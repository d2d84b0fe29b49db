#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/expression/tape.hpp"
#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// The place of a local quantity of the intervals in a long array: for interval k at `first + k`; a quantity of the
/// whole horizon, which all intervals share, at `first`.
struct SeriesPlace {
  /// One entry per interval from `first_entry` on, or that entry alone for all of them.
  // NOLINTNEXTLINE(google-explicit-constructor): a bare number is the usual place.
  SeriesPlace(std::size_t first_entry = 0, bool global = false) : first(first_entry), is_global(global) {}

  std::size_t first;  ///< of interval 0
  bool is_global;     ///< one entry for all intervals

  /// The entry of an interval.
  [[nodiscard]] std::size_t at(std::size_t interval) const noexcept { return is_global ? first : first + interval; }
  /// Equal members.
  friend bool operator==(const SeriesPlace&, const SeriesPlace&) = default;
};

/// The entry of local quantity `local` of an interval, as Eigen counts.
[[nodiscard]] inline Eigen::Index index_of(const std::vector<SeriesPlace>& places, Eigen::Index local,
                                           Eigen::Index interval) {
  return static_cast<Eigen::Index>(places[static_cast<std::size_t>(local)].at(static_cast<std::size_t>(interval)));
}

/// How series are combined with the array.
enum class AssemblyMode : std::uint8_t {
  whole,  ///< all are written; those that no series reaches are set to 0
  part,   ///< series are added to the present entries
};

/// How series of one value per interval make up one long array: series e stands at places[e].
struct AssemblyPlan {
  std::vector<SeriesPlace> places;          ///< a place for every series of the results
  std::size_t size = 0;                     ///< length of the array
  std::size_t intervals = 0;                ///< length of a series
  AssemblyMode mode = AssemblyMode::whole;  ///< how series become entries
};

/// Puts series together to one long array.
///
/// Where series meet (the right end of one interval is the left end of the next, so one's `first` is one more than the
/// other's) their values are added, and so are all values of a series with a global place. Between `open` and `close`
/// the caller writes all series.
class SeriesAssembly {
 public:
  /// Throws `Error` if a series leaves the array.
  explicit SeriesAssembly(AssemblyPlan plan);

  /// Where the series are to be written: most of them in `result` itself. Valid until the next call. Allocates
  /// nothing. Throws `Error` if `result` does not have the length of the plan.
  [[nodiscard]] std::span<double* const> open(VectorOut& result);
  /// Completes `result`, once every series has been written. Allocates nothing.
  void close(VectorOut& result) const;

  /// How many series there are.
  [[nodiscard]] std::size_t columns() const noexcept { return columns_.size(); }
  /// N.
  [[nodiscard]] std::size_t intervals() const noexcept { return plan_.intervals; }

 private:
  struct Addition {
    std::size_t column = 0;   // this series is written to scratch memory
    std::size_t scratch = 0;  // that begins here
  };

  struct Stretch {
    std::size_t begin = 0;
    std::size_t end = 0;  // one past the last
  };

  void add_column(const Addition& addition, Stretch within, double* result) const;

  AssemblyPlan plan_;
  std::vector<Addition> additions_;  // series that are added at the end
  std::vector<Stretch> zeros_;       // entries that no series writes
  std::vector<double> scratch_;
  std::vector<double*> columns_;
};

/// A tape whose outputs are the series of one long array.
class AssembledTape {
 public:
  /// Throws `Error` if there is not one place per output, or a series leaves the array.
  AssembledTape(const Schedule& schedule, AssemblyPlan plan);

  /// Writes the whole array, or adds to it. Allocates nothing; long grids by several threads (parallel.hpp), with the
  /// same result.
  void evaluate(std::span<const Tape::Input> inputs, VectorOut result);

 private:
  Tape tape_;
  std::vector<Tape::Workspace> workspaces_;  // one per thread's share of the intervals
  SeriesAssembly assembly_;
};

/// Where the local entries of a part of a program stand in its matrix: entry e of interval k at (rows[e].at(k),
/// columns[e].at(k)).
struct LocalEntries {
  std::vector<SeriesPlace> rows;     ///< of every entry of an interval
  std::vector<SeriesPlace> columns;  ///< of every entry of an interval
  std::size_t intervals = 0;         ///< N
};

/// The pattern of an assembled sparse matrix, and where local entries go in its array of values.
struct AssembledPattern {
  BlockPattern pattern;             ///< where entries lie
  std::vector<SeriesPlace> places;  ///< per local entry, as `SeriesAssembly` wants it
};

/// Merges the local entries of all intervals.
[[nodiscard]] AssembledPattern assemble_pattern(const LocalEntries& entries);

/// Adds the few entries of a part with one interval to a pattern, and returns the place of each.
[[nodiscard]] std::vector<SeriesPlace> extend_pattern(BlockPattern& pattern, const LocalEntries& entries);

}  // namespace dmocbench
