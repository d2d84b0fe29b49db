#include "methods/transcription/derivatives/part_places.hpp"

#include <utility>

namespace dmocbench {

std::vector<SeriesPlace> picked(const std::vector<SeriesPlace>& places, const std::vector<std::size_t>& numbers) {
  std::vector<SeriesPlace> result;
  result.reserve(numbers.size());
  for (const std::size_t number : numbers) result.push_back(places[number]);
  return result;
}

LocalEntries jacobian_entries(const LocalFunctions& functions, const std::vector<SeriesPlace>& rows,
                              const std::vector<SeriesPlace>& unknowns, std::size_t intervals) {
  return {picked(rows, functions.jacobian.rows), picked(unknowns, functions.jacobian.columns), intervals};
}

LocalEntries hessian_entries(const LocalFunctions& functions, const std::vector<SeriesPlace>& unknowns,
                             std::size_t intervals) {
  LocalEntries entries{picked(unknowns, functions.hessian.rows), picked(unknowns, functions.hessian.columns),
                       intervals};
  for (std::size_t e = 0; e < entries.rows.size(); ++e) {
    if (entries.rows[e].first < entries.columns[e].first) std::swap(entries.rows[e], entries.columns[e]);
  }
  return entries;
}

PartPlaces part_places(const LocalFunctions& functions, const std::vector<SeriesPlace>& unknowns,
                       const std::vector<SeriesPlace>& rows, const std::vector<SeriesPlace>& jacobian,
                       const std::vector<SeriesPlace>& hessian, const ProgramArrays& arrays, std::size_t intervals,
                       AssemblyMode mode) {
  const auto plan = [&](std::vector<SeriesPlace> places, std::size_t size) {
    return AssemblyPlan{.places = std::move(places), .size = size, .intervals = intervals, .mode = mode};
  };
  return {.constraints = plan(picked(rows, functions.rows.places), arrays.constraints),
          .derivatives = {.unknowns = unknowns,
                          .rows = rows,
                          .gradient = plan(picked(unknowns, functions.gradient.places), arrays.variables),
                          .jacobian = plan(jacobian, arrays.jacobian),
                          .hessian = plan(hessian, arrays.hessian)}};
}

}  // namespace dmocbench
