#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/run/solve_case.hpp"

namespace dmocbench {

/// Cases in a row that differ in their grid only, together.
[[nodiscard]] std::vector<std::vector<Case>> curves_of(std::span<const Case> cases);

/// The chosen names in the order of `known`, each once. Throws `Error` on one that is not known: "OPTION takes a or b,
/// not c".
[[nodiscard]] std::vector<std::string> chosen_of(const std::string& option, const std::vector<std::string>& known,
                                                 const std::vector<std::string>& chosen);

/// The labels of the variants that a case is solved in; an empty label leaves it unchanged.
using LabelsOfCase = std::function<std::vector<std::string>(const Case&)>;
/// Each curve once for each of its variants, which its first case determines.
[[nodiscard]] std::vector<Case> vary(const std::vector<Case>& cases, const LabelsOfCase& labels_of);

/// Labels that are numbers: "0", "1", ...
[[nodiscard]] std::vector<std::string> numbers_below(std::size_t count);

/// Each case once for each of its starts, by number: `count_of` returns how many it has, `motion_of` makes the motion
/// of a number from the one that --start names, for a case's problem.
[[nodiscard]] std::vector<Case> from_starts(
    const std::vector<Case>& cases, const std::function<long long(const Case&)>& count_of,
    const std::function<Motion(const Motion& chosen, const Problem& problem, std::size_t number)>& motion_of);

/// The index of the case of a curve that is solved first: its reference, or 0.
[[nodiscard]] std::size_t reference_of(const std::vector<Case>& curve);

/// The cases once for each tolerance that is compared, curve after curve; unchanged if no tolerances are compared.
[[nodiscard]] std::vector<Case> with_tolerances(const std::vector<Case>& cases, const std::vector<double>& tolerances);

/// Cases of one problem, by number: from `first` up to `end`, which is not one of them.
struct CaseSpan {
  std::size_t first = 0;  ///< number of the first case
  std::size_t end = 0;    ///< one past the number of the last case
};

/// The spans of all problems with a wanted case, in their order.
[[nodiscard]] std::vector<CaseSpan> spans_of_problems(const std::vector<Case>& cases,
                                                      const std::vector<bool>& is_wanted);

/// The numbers of the cases that are solved in turn: of one problem, tableau, number of stages and of intervals.
[[nodiscard]] std::vector<std::vector<std::size_t>> turns_of(const std::vector<Case>& cases);

/// The properties that a case shares with the others of its curve, in words.
[[nodiscard]] std::string label_of_curve(const Case& the_case);

}  // namespace dmocbench
