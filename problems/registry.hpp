#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "methods/mechanics/problem.hpp"

namespace dmocbench {

/// Names of all problems, in the order in which they are listed.
[[nodiscard]] std::vector<std::string> problem_names();

/// Names of the two problems of the paper's section 4.
[[nodiscard]] std::vector<std::string> paper_problem_names();

/// The problem named `name` with its default parameters. Throws `Error` that lists the names if it is unknown, or as
/// `check_problem`.
[[nodiscard]] std::unique_ptr<Problem> make_problem(std::string_view name);
/// The same before `check_problem`, for callers that set parameters and then check it themselves.
[[nodiscard]] std::unique_ptr<Problem> make_unchecked_problem(std::string_view name);

}  // namespace dmocbench
