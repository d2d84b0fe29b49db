#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "methods/runtime/parsed.hpp"

namespace dmocbench {

/// Numbers of intervals from a list like "16,48,64" or "8:1024" (8, 16, ..., 1024: doubling while not above the end),
/// or a mixture; ascending, each once. Throws `Error` that names the option and quotes the entry if one is not a whole
/// number between 1 and Grid::most_intervals, or a range ends below its start.
[[nodiscard]] std::vector<long long> parse_intervals(std::string_view option, std::string_view text);

/// Relative node times, one per line, from a file. Throws `Error` that names the line if one is not a number.
[[nodiscard]] std::vector<double> parse_node_times(std::string_view text);

/// "name=value" apart. Throws `Error` with the option's name if there is no "=" or no name.
[[nodiscard]] std::pair<std::string_view, std::string_view> parse_assignment(std::string_view option,
                                                                             std::string_view text);

/// The whole text as a number. Throws `Error` that says what it was wanted for.
[[nodiscard]] double parse_number(std::string_view wanted_for, std::string_view text);

}  // namespace dmocbench
