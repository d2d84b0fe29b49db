#pragma once

#include <cstddef>
#include <vector>

#include "methods/extensions/primitives/primitive_library.hpp"
#include "methods/extensions/primitives/solve_primitives.hpp"
#include "methods/extensions/primitives/trim.hpp"
#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// A library whose states are trims.
[[nodiscard]] PrimitiveLibrary library_of_trims(const Problem& problem, const std::vector<Trim>& trims, double step,
                                                int intervals_per_step);

/// Solves the requests and keeps, of those with the same two states, turn of the frame and duration, the `most`
/// cheapest.
void solve_cheapest(const Problem& problem, const std::vector<PrimitiveRequest>& requests, std::size_t most,
                    PrimitiveLibrary& library, const PrimitiveOptions& options);

}  // namespace dmocbench
