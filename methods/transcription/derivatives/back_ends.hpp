#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "methods/transcription/derivatives/derivative_back_end.hpp"

namespace dmocbench {

/// Names of the available back ends, the default (`tape`) first: tape, adolc and adolc_whole (if ADOL-C was found when
/// this was built), finite_differences, forward_differences, dense_differences.
[[nodiscard]] std::vector<std::string> derivative_back_end_names();

/// One line. Throws `Error` as `make_derivative_back_end` does.
[[nodiscard]] std::string derivative_back_end_description(std::string_view name);

/// The back end `name` for the intervals of one grid; `functions` is read only by this call. Throws `Error` that lists
/// the names if it is unknown, or names the missing package if it was left out of this build.
[[nodiscard]] std::unique_ptr<DerivativeBackEnd> make_derivative_back_end(std::string_view name,
                                                                          const LocalFunctions& functions,
                                                                          const DerivativePlaces& places);

}  // namespace dmocbench
