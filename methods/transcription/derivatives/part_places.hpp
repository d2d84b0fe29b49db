#pragma once

#include <cstddef>
#include <vector>

#include "methods/transcription/derivatives/derivative_back_end.hpp"
#include "methods/transcription/derivatives/local_functions.hpp"
#include "methods/transcription/derivatives/series_assembly.hpp"

namespace dmocbench {

/// How the values and derivatives of a part make up the program's arrays.
struct PartPlaces {
  AssemblyPlan constraints;      ///< entries in the order of `LocalFunctions::rows`
  DerivativePlaces derivatives;  ///< where unknowns and rows lie, and derivatives go
};

/// The places with these numbers, in their order.
[[nodiscard]] std::vector<SeriesPlace> picked(const std::vector<SeriesPlace>& places,
                                              const std::vector<std::size_t>& numbers);

/// Where the entries of a part's Jacobian stand; `rows` and `unknowns` are the places of all that are local.
[[nodiscard]] LocalEntries jacobian_entries(const LocalFunctions& functions, const std::vector<SeriesPlace>& rows,
                                            const std::vector<SeriesPlace>& unknowns, std::size_t intervals);
/// The places of the entries of its Hessian, in the lower triangle.
[[nodiscard]] LocalEntries hessian_entries(const LocalFunctions& functions, const std::vector<SeriesPlace>& unknowns,
                                           std::size_t intervals);

/// The arrays of a program that its parts make up.
struct ProgramArrays {
  std::size_t variables = 0;    ///< entries of the gradient
  std::size_t constraints = 0;  ///< entries of a
  std::size_t jacobian = 0;     ///< entries of its array
  std::size_t hessian = 0;      ///< entries of its array
};

/// Where a part with these local unknowns and rows stands in a program; `jacobian` and `hessian` are the places of its
/// entries in the assembled patterns.
[[nodiscard]] PartPlaces part_places(const LocalFunctions& functions, const std::vector<SeriesPlace>& unknowns,
                                     const std::vector<SeriesPlace>& rows, const std::vector<SeriesPlace>& jacobian,
                                     const std::vector<SeriesPlace>& hessian, const ProgramArrays& arrays,
                                     std::size_t intervals, AssemblyMode mode = AssemblyMode::whole);

}  // namespace dmocbench
