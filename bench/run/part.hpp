#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/run/solve_case.hpp"

namespace dmocbench {

/// One of several parts that the cases of a run are dealt out to, so that as many processes, on whatever machines, do
/// its work.
struct Part {
  std::size_t number = 1;  ///< from 1, as the tasks of an array job and the lines of a list are counted
  std::size_t of = 1;      ///< how many parts there are

  /// "3/16", as the option takes it.
  [[nodiscard]] std::string in_words() const;
  /// "03-of-16.part": the part's file in the folder of all parts of a run.
  [[nodiscard]] std::string file_name() const;
};

/// The largest number of parts.
inline constexpr std::size_t most_parts_of_a_run = 1000000;

/// Reads "i/n". Throws `Error` that names the option unless both are whole numbers, 1 <= i <= n <=
/// `most_parts_of_a_run`.
[[nodiscard]] Part parse_part(std::string_view option, std::string_view text);

/// Returns a text that identifies what a case shares with others; cases with equal texts depend on each other (by a
/// reference, a branch, a common start), and an empty text means that nothing is shared.
using SharedBy = std::function<std::string(const Case&)>;

/// For every case the number of the first one that it shares something with, in one respect or another, directly or
/// through others; its own number if it is the first.
[[nodiscard]] std::vector<std::size_t> groups_of(const std::vector<Case>& cases, const std::vector<SharedBy>& respects);

/// For every case the number, from 1, of the part that it is dealt to.
///
/// Groups (`groups_of`) stay together. They are put into the order of a checksum of their first case, which mixes
/// problems, methods and grids, and dealt out one by one: the numbers of groups of two parts differ by one at most, and
/// are the same on every machine.
[[nodiscard]] std::vector<std::size_t> dealt_out(const std::vector<Case>& cases, const std::vector<std::size_t>& groups,
                                                 std::size_t parts);

}  // namespace dmocbench
