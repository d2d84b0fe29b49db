#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/run/experiment.hpp"

namespace dmocbench {

/// One of several parts that the cases of a run are dealt out to, so that as many processes, on whatever machines, do
/// its work.
struct Part {
  std::size_t number = 1;  ///< from 1, as the tasks of an array job and the lines of a list are counted
  std::size_t of = 1;      ///< how many parts there are

  /// "3/16", as the option takes it.
  [[nodiscard]] std::string in_words() const;
  /// "03-of-16": the name of the part's files in the folder of all parts of a run.
  [[nodiscard]] std::string name() const;
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

/// The folder of the stores of all parts of a run, NAME.parts next to its table NAME.csv.
[[nodiscard]] std::filesystem::path folder_of_parts(const std::filesystem::path& folder, const std::string& name);

/// The cases of a run in the order of rows, how they depend on each other, and which of them this process works on.
class RunPlan {
 public:
  /// The plan of an experiment with the options of its command line. Throws `Error` on anything unknown or out of
  /// range.
  explicit RunPlan(Experiment& experiment);

  /// All cases, each once for every tolerance that is compared.
  [[nodiscard]] const std::vector<Case>& cases() const noexcept { return cases_; }
  /// The part of the cases that this run works on (--part); empty if it works on all of them.
  [[nodiscard]] const std::optional<Part>& part() const noexcept { return part_; }
  /// Folder and name of the files of the run: OUT/NAME, or of a part OUT/NAME.parts/3-of-16.
  [[nodiscard]] const std::filesystem::path& prefix() const noexcept { return prefix_; }
  /// For every case whether its row has to be made.
  [[nodiscard]] const std::vector<bool>& wanted() const noexcept { return wanted_; }
  /// How many rows have to be made.
  [[nodiscard]] std::size_t wanted_count() const;
  /// The row of a case is there.
  void settle(std::size_t number) { wanted_[number] = false; }
  /// Groups of cases (`groups_of`) whose rows are made of each other's answers.
  [[nodiscard]] std::vector<std::size_t> groups_of_rows() const;
  /// The same of cases that have to be found a common start, too.
  [[nodiscard]] std::vector<std::size_t> groups_of_starts() const;
  /// The properties that the rows of this run depend on (`identity_of`): also the parameters of the problems, the
  /// cases, the file that solves start from and the columns of the table.
  [[nodiscard]] nlohmann::ordered_json identity(const nlohmann::ordered_json& metadata,
                                                const std::map<std::string, std::string>& options,
                                                const std::vector<std::string>& columns) const;
  /// Writes to the metadata of the run how its cases are solved, and the cost scale and the units of their problems.
  void describe(nlohmann::ordered_json& metadata) const;

 private:
  [[nodiscard]] std::vector<SharedBy> respects_of_rows() const;

  const ExperimentCard& card_;
  std::vector<Case> cases_;
  std::optional<Part> part_;
  std::filesystem::path prefix_;
  std::vector<bool> wanted_;
};

}  // namespace dmocbench
