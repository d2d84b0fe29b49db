#include "methods/transcription/derivatives/whole_part.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

std::vector<std::size_t> all_places(const std::vector<SeriesPlace>& series, std::size_t intervals) {
  std::set<std::size_t> places;
  for (const SeriesPlace& one : series) {
    for (std::size_t k = 0; k < intervals; ++k) places.insert(one.at(k));
  }
  return {places.begin(), places.end()};
}

std::size_t number_of(const std::vector<std::size_t>& places, std::size_t place) {
  return static_cast<std::size_t>(std::ranges::lower_bound(places, place) - places.begin());
}

/// The entries of a plan, with the numbers of their rows and columns.
template <class RowOf, class ColumnOf>
std::vector<WholePart::Entry> entries_of(const AssemblyPlan& plan, const RowOf& row_of, const ColumnOf& column_of) {
  std::map<std::size_t, WholePart::Entry> entries;
  for (std::size_t e = 0; e < plan.places.size(); ++e) {
    for (std::size_t k = 0; k < plan.intervals; ++k) {
      const std::size_t value = plan.places[e].at(k);
      entries.insert({value, {value, row_of(e, k), column_of(e, k)}});
    }
  }
  std::vector<WholePart::Entry> result;
  for (const auto& [value, entry] : entries) result.push_back(entry);
  return result;
}

}  // namespace

WholePart::WholePart(const LocalFunctions& functions, const DerivativePlaces& places)
    : intervals(places.gradient.intervals),
      unknowns(all_places(places.unknowns, intervals)),
      rows(all_places(places.rows, intervals)),
      is_global(unknowns.size()),
      unknown_series(places.unknowns),
      row_series(places.rows) {
  for (const SeriesPlace& place : unknown_series) {
    if (place.is_global) is_global[number_of(unknowns, place.first)] = true;
  }
  const auto unknown_of = [&](const std::vector<std::size_t>& locals) {
    return [&](std::size_t e, std::size_t k) { return unknown(locals[e], k); };
  };
  const auto row_of = [&](std::size_t e, std::size_t k) { return row(functions.jacobian.rows[e], k); };
  const auto of_cost = unknown_of(functions.gradient.places);
  for (const Entry& entry : entries_of(places.gradient, of_cost, of_cost)) gradient.push_back(entry.column);
  jacobian = entries_of(places.jacobian, row_of, unknown_of(functions.jacobian.columns));
  hessian = entries_of(places.hessian, unknown_of(functions.hessian.rows), unknown_of(functions.hessian.columns));
}

std::size_t WholePart::unknown(std::size_t local, std::size_t interval) const {
  return number_of(unknowns, unknown_series[local].at(interval));
}

std::size_t WholePart::row(std::size_t local, std::size_t interval) const {
  return number_of(rows, row_series[local].at(interval));
}

void begin_whole(const AssemblyPlan& plan, VectorOut& result) {
  if (static_cast<std::size_t>(result.size()) != plan.size) {
    throw Error("derivatives are written to an array of the wrong length");
  }
  if (plan.mode == AssemblyMode::whole) result.setZero();
}

}  // namespace dmocbench
