#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/run/experiment.hpp"
#include "bench/run/part_file.hpp"

namespace dmocbench {

/// The cases of a run by number; a row for each that is solved.
using RowsOfCases = std::vector<std::optional<Row>>;

/// A run whose cases are distributed over parts: the cases of each part, its file, and the joined rows. An unfinished
/// run is kept as a part, too.
class PartsOfRun {
 public:
  /// `options`: names and values of the command line; `columns`: names of the table's columns. Throws `Error` if --part
  /// is not a part or --missing-parts is not a number of parts.
  PartsOfRun(Experiment& experiment, const std::vector<Case>& cases, const nlohmann::ordered_json& metadata,
             const std::map<std::string, std::string>& options, std::vector<std::string> columns);

  /// Whether this run is one part, requested by --part.
  [[nodiscard]] bool is_one() const noexcept { return part_.has_value(); }
  /// For every case whether this run works on it: all cases, or the cases of its part.
  [[nodiscard]] std::vector<bool> own_cases() const;
  /// For every case the first one that it shares something with (`groups_of`).
  [[nodiscard]] std::vector<std::size_t> groups() const;
  /// The file of this part.
  [[nodiscard]] std::filesystem::path file() const { return file_of(part_.value_or(Part())); }
  /// True if this part is there already, of this very run.
  [[nodiscard]] bool is_there() const { return is_there(part_.value_or(Part())); }
  /// Writes this part whole, or throws `Error`.
  void write(const RowsOfCases& rows, const nlohmann::ordered_json& metadata) const;

  /// The parts of n (--missing-parts) that are not there.
  [[nodiscard]] std::vector<std::size_t> missing() const;

  /// The rows of all cases from the parts in some folders; passes their findings to the experiment and describes their
  /// origin in the metadata. Throws `Error` that names the part if one is missing, damaged, present twice, of another
  /// run, or has values that no run writes.
  [[nodiscard]] RowsOfCases join(nlohmann::ordered_json& metadata) const;

  /// Writes the rows that an unfinished run has so far to a file, from which `resume` takes them. Throws `Error` if it
  /// cannot be written.
  void save(const std::filesystem::path& file, const RowsOfCases& rows, const nlohmann::ordered_json& metadata) const;
  /// The rows of an unfinished run of this very identity in a file. Cases that depend on a case without a row, or were
  /// interrupted, have no row. There are no rows at all if the file is missing, damaged or of another run.
  [[nodiscard]] RowsOfCases resume(const std::filesystem::path& file) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(const Part& part) const;
  [[nodiscard]] bool is_there(const Part& part) const;
  /// The number of the case, then the columns of the table.
  [[nodiscard]] std::vector<std::string> columns_of_part() const;
  void take_rows(const PartFile& file, RowsOfCases& rows) const;
  [[nodiscard]] PartFile file_with(const std::filesystem::path& path, const Part& part, const RowsOfCases& rows,
                                   const nlohmann::ordered_json& metadata) const;

  Experiment& experiment_;
  const std::vector<Case>& cases_;
  std::vector<std::string> columns_;
  std::optional<Part> part_;
  std::size_t asked_for_ = 0;  ///< parts, by --missing-parts
  nlohmann::ordered_json identity_;
};

}  // namespace dmocbench
