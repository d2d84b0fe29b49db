#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/program/nonlinear_program.hpp"

namespace dmocbench {

/// Where a local quantity of the intervals stands in a long array: that of interval k at `first + k`; a quantity of the
/// whole horizon, which all intervals share, at `first`.
struct ColumnPlace {
  // NOLINTNEXTLINE(google-explicit-constructor): a bare number is the usual place.
  ColumnPlace(std::size_t first_entry = 0, bool is_shared = false) : first(first_entry), shared(is_shared) {}

  std::size_t first;
  bool shared;

  [[nodiscard]] std::size_t at(std::size_t interval) const noexcept { return shared ? first : first + interval; }
  friend bool operator==(const ColumnPlace&, const ColumnPlace&) = default;
};

/// What becomes of the entries of an array that is assembled.
enum class AssemblyMode : std::uint8_t {
  whole,  ///< all are written; those that no column reaches are set to 0
  part,   ///< columns are added to what is there
};

/// Puts columns of one value per interval together to one long array.
///
/// Where columns meet (the right end of one interval is the left end of the next, so one's `first` is one more than the
/// other's) their values are added, and so are all values of a column with a shared place. Between `open` and `close`
/// whoever computes the columns writes all of them.
class ColumnAssembly {
 public:
  /// `size` is the length of the array, `intervals` that of a column. Throws `Error` if a column leaves the array.
  ColumnAssembly(std::vector<ColumnPlace> places, std::size_t size, std::size_t intervals,
                 AssemblyMode mode = AssemblyMode::whole);

  /// Where the columns are to be written: most of them in `result` itself. Valid until the next call. Allocates
  /// nothing. Throws `Error` if `result` has not `size` entries.
  [[nodiscard]] std::span<double* const> open(VectorOut& result);
  /// Makes `result` whole, once every column has been written. Allocates nothing.
  void close(VectorOut& result) const;

  [[nodiscard]] std::size_t columns() const noexcept { return places_.size(); }
  [[nodiscard]] std::size_t intervals() const noexcept { return intervals_; }

 private:
  struct Addition {
    std::size_t column = 0;   // goes to a scratch column first
    std::size_t scratch = 0;  // where that begins
    ColumnPlace place;        // and is added from this entry on
  };

  void add_later(std::size_t column);

  std::vector<ColumnPlace> places_;
  std::size_t size_;
  std::size_t intervals_;
  std::vector<Addition> additions_;
  std::vector<std::size_t> zeros_;
  std::vector<double> scratch_;
  std::vector<double*> columns_;
};

}  // namespace dmocbench
