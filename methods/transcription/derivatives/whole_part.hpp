#pragma once

#include <cstddef>
#include <vector>

#include "methods/transcription/derivatives/derivative_back_end.hpp"

namespace dmocbench {

/// A part seen as one function of all its unknowns, without regard to intervals.
///
/// Unknowns and rows are numbered in the order of their places in the program's vectors.
struct WholePart {
  /// An entry of a matrix, of which the program's array has one.
  struct Entry {
    std::size_t value;   ///< its place in the array
    std::size_t row;     ///< number of the row, in a Hessian of an unknown
    std::size_t column;  ///< number of the unknown
  };

  /// Merges the local entries of all intervals.
  WholePart(const LocalFunctions& functions, const DerivativePlaces& places);
  /// The number of a local unknown of an interval.
  [[nodiscard]] std::size_t unknown(std::size_t local, std::size_t interval) const;
  /// The number of a local row of an interval.
  [[nodiscard]] std::size_t row(std::size_t local, std::size_t interval) const;

  std::size_t intervals;                    ///< N
  std::vector<std::size_t> unknowns;        ///< their places
  std::vector<std::size_t> rows;            ///< their places
  std::vector<bool> is_global;              ///< of every unknown: all intervals share it
  std::vector<std::size_t> gradient;        ///< numbers of the unknowns that the cost reads
  std::vector<Entry> jacobian;              ///< all entries
  std::vector<Entry> hessian;               ///< one triangle
  std::vector<SeriesPlace> unknown_series;  ///< places of local unknowns
  std::vector<SeriesPlace> row_series;      ///< places of local rows
};

/// Sets an array to zero where the part writes all of it; where it adds to it, its entries stay.
void begin_whole(const AssemblyPlan& plan, VectorOut& result);

}  // namespace dmocbench
