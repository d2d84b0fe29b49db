#pragma once

#include <string>

#include "methods/mechanics/problem.hpp"
#include "methods/program/solution.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// What keeps a solve that failed from an answer, in a sentence or two: the row or unknown that its point misses most
/// (`describe_constraint`), by how much, in the unit of the row; which controls and whether the horizon are held by
/// their bounds there; and, where the solver ended at a point of least violation, what cannot be met near it, such as a
/// final state that is out of reach. Empty where the solve ended without a point, or its point misses nothing by more
/// than `tolerance`. `problem` is the one that was transcribed.
[[nodiscard]] std::string describe_violation(const Problem& problem, Transcription& transcription,
                                             const Solution& solution, double tolerance = 1e-8);

}  // namespace dmocbench
