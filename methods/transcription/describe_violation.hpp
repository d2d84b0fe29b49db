#pragma once

#include <cstddef>
#include <string>

#include "methods/mechanics/problem.hpp"
#include "methods/program/solution.hpp"
#include "methods/transcription/transcription.hpp"

namespace dmocbench {

/// The meaning of a constraint (row), or of an unknown, of a transcribed problem: the functions of the problem that it
/// is made of, the quantity, and the place, as in "lagrangian and force: the Euler-Lagrange equation of q[1] (theta) in
/// interval 17 (t = 0.53 to 0.5625)". Indices count from 0; times belong to the point `x` (variable_count()
/// entries), in the units of the problem as solved. `problem` is the one that was transcribed.
[[nodiscard]] std::string describe_constraint(const Problem& problem, const Transcription& transcription,
                                              const Eigen::VectorXd& x, std::size_t row);
/// An unknown of the program in words: the quantity, and its node or interval.
[[nodiscard]] std::string describe_unknown(const Problem& problem, const Transcription& transcription,
                                           const Eigen::VectorXd& x, std::size_t unknown);

/// A path constraint that the guess violates where its derivatives by the unknown that would repair it vanish
/// (`flat_rows`), in a sentence; empty if there is none.
[[nodiscard]] std::string describe_flat_constraint(const Problem& problem, Transcription& transcription);

/// Why a solve failed, in a sentence or two: the constraint or bound that its point violates most
/// (`describe_constraint`), and by how much, in the unit of the constraint; which controls, and whether the horizon,
/// are at their bounds there; boundary conditions whose derivatives vanish there, or
/// else constraints whose gradients depend on each other (`dependent_rows`); whether the problem has no freedom; a
/// constraint that is flat on the guess (`describe_flat_constraint`); and, where the solver ended at a
/// point of least violation, the bounds on q and q̇ that the violation presses against most and conditions that cannot
/// be met near it, such as an unreachable final state. A formula that is not a number at that point is named first,
/// with the interval (`undefined_stage`); it alone where the evaluation failed. Empty where the solve ended without a
/// point, or its point violates nothing by more than `tolerance`. `problem` is the one that was transcribed.
[[nodiscard]] std::string describe_violation(const Problem& problem, Transcription& transcription,
                                             const Solution& solution, double tolerance = 1e-8);

/// Why a solve failed.
struct Failure {
  std::string words;               ///< as `describe_violation` has them; may be empty
  bool formula_undefined = false;  ///< a formula, a row or an unknown is not a number at its last point
};
/// The same with what the words state as a value.
[[nodiscard]] Failure failure_of(const Problem& problem, Transcription& transcription, const Solution& solution,
                                 double tolerance = 1e-8);

}  // namespace dmocbench
